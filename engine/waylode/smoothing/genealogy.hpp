// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "waylode/fusion/particle_filter.hpp"
#include "waylode/fusion/planar_estimate.hpp"

namespace waylode::smoothing {

/// For each node of a particle filter's history the place given what came after: the guesses of
/// then, weighed by their descendants [Kitagawa1996]. No node knows more than `horizon` of its
/// future, and none, the last ones and those before a gap apart, less than half of it: further
/// back, all guesses descend from one and nothing is left of the doubt. Where no descendant is left
/// (all were drawn anew), what the next nearer future says. `base_sigma_m` per axis is added.
/// O(particles * nodes).
std::vector<fusion::PlanarEstimate> trace_back(
    const std::deque<fusion::ParticleFilter::Node>& history, core::Duration horizon,
    double base_sigma_m, double sigma_scale);

}  // namespace waylode::smoothing
