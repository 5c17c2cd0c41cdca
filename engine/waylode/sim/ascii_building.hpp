// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/sim/building.hpp"

namespace waylode::sim {

struct AsciiBuildingOptions {
  double cell_m = 1.0;  ///< Side of one character, 0.2 to 10. People need gaps of 0.7 m.
  int first_line = 1;   ///< Number of the text's first line, for messages.
};

/// A building drawn in characters. Every floor is a header line and its rows, the first row the
/// northernmost:
///
///     floor F1 level 0 elevation_m 0
///     #########
///     #1..A..2#
///     ####+####
///
/// `#` wall, `.` and space free, `+` door (free), `^` stairs (free; joined to `^` at the same place
/// on the next floor up), `A`-`Z` access point, `a`-`z` Bluetooth beacon, `0`-`9` named point.
/// Letters and digits occur once a floor and stand on free ground, in the middle of their cell.
/// Rows may be shorter than the longest: what is missing is wall. Blank lines between floors are
/// skipped. The floor frame has its origin in the south-west corner of the drawing, x to the right.
///
/// kScenarioInvalid with "place:line" for anything else.
core::Result<Building> parse_ascii_building(std::string_view text, std::string_view place,
                                            const AsciiBuildingOptions& options = {});

}  // namespace waylode::sim
