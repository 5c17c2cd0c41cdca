// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "waylode/site/radio_map.hpp"

namespace waylode::site::detail {

/// What breaks a radio map's promises (order, every index within its array, finite positions,
/// floors below `floor_count`), naming the array and the entry; empty when it keeps them all.
std::string defect_of(const RadioMap& map, std::size_t floor_count);

}  // namespace waylode::site::detail
