// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "waylode/eval/evaluated_track.hpp"

namespace waylode::eval::detail {

/// Every method once, in the order of first appearance.
std::vector<std::string> methods_in_order(std::span<const EvaluatedTrack> tracks);

}  // namespace waylode::eval::detail
