// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::cli {

using MarkedPath = std::vector<core::Vector2>;  ///< Marks in order, floor frame.

/// Straight lines between the marks, sampled every 0.5 m, ends included.
std::vector<core::Vector2> sample_path(const MarkedPath& path);

/// Whether at least 90 % of `path` runs within 3 m of one of `surveyed`, both sampled as above.
bool is_covered(const MarkedPath& path, const std::vector<MarkedPath>& surveyed);

}  // namespace waylode::cli
