// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"

namespace waylode::cli {

struct CsvRow {
  std::size_t line = 0;  ///< Where the row begins, from 1.
  std::vector<std::string> cells;
};

/// Rows of a table as RFC 4180 has them: cells in quotes may hold commas, line ends and doubled
/// quotes. A byte order mark and rows without any character are passed over. A quote inside a bare
/// cell, text after a closing quote and a quote that is never closed are kTableInvalid with
/// "place:line".
core::Result<std::vector<CsvRow>> parse_csv(std::string_view text, std::string_view place);

}  // namespace waylode::cli
