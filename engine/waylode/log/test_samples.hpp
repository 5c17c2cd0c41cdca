// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "waylode/core/rng.hpp"
#include "waylode/sample/sample.hpp"

/// Samples for tests of the log formats.
namespace waylode::log::test {

/// What contract/samples/one_of_each.mcap holds.
sample::RecordingInfo sample_recording_info();
/// One hand-made sample of every kind, a second waypoint in WGS-84 last.
std::vector<sample::Sample> one_of_each();

/// Any sample of the kind (its place in sample::Sample) that a log may hold, extremes included.
sample::Sample random_sample(core::Rng& rng, std::size_t kind);
std::vector<sample::Sample> random_samples(core::Rng& rng, std::size_t count);

}  // namespace waylode::log::test
