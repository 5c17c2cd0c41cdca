// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "waylode/fusion/planar_tracker.hpp"

namespace waylode::smoothing {

/// The Rauch-Tung-Striebel backward pass [Rauch1965] over a tracker's history: for each node
/// (before the first transition, then after each one and its measurement) the state given all data.
/// Returns history.size() + 1 states; `last` is the newest filtered state.
std::vector<fusion::PlanarState> smooth_backward(
    const std::deque<fusion::PlanarTransition>& history, const fusion::PlanarState& last);

}  // namespace waylode::smoothing
