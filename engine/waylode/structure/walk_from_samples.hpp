// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "waylode/core/result.hpp"
#include "waylode/pdr/dead_reckoning.hpp"
#include "waylode/structure/walk.hpp"
#include "waylode/structure/walk_from_motion.hpp"

namespace waylode::structure {

/// A recording's samples, in order of time, through dead reckoning to a walk. Errors of
/// walk_from_motion.
core::Result<Walk> walk_from_samples(std::span<const sample::Sample> samples,
                                     std::span<const LandmarkMark> marks,
                                     const pdr::DeadReckoning::Options& pdr_options,
                                     const SegmentationOptions& options);

}  // namespace waylode::structure
