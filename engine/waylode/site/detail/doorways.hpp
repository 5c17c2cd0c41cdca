// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "waylode/site/floor.hpp"

namespace waylode::site::detail {

/// What is left of the walls when the doors' circles are taken out, in the walls' order. A rest
/// shorter than a millimetre goes too. Doors that are not finite or not wide are passed over.
std::vector<Wall> without_doorways(std::span<const Wall> walls, std::span<const Door> doors);

}  // namespace waylode::site::detail
