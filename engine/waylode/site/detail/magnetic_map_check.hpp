// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "waylode/site/magnetic_map.hpp"

namespace waylode::site::detail {

/// What breaks a magnetic map's promises (order, finite places and fields, floors below
/// `floor_count`), naming the entry; empty when it keeps them all.
std::string defect_of(const MagneticMap& map, std::size_t floor_count);

}  // namespace waylode::site::detail
