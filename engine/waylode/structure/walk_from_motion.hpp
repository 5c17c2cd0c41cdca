// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/structure/walk.hpp"

namespace waylode::structure {

/// That a landmark was passed.
struct LandmarkMark {
  core::DeviceTime time;
  std::string name;

  bool operator==(const LandmarkMark&) const = default;
};

struct SegmentationOptions {
  double largest_deviation_rad = 0.349;  ///< Of a step from its segment: 20 degrees; 0.05 to 1.
  std::size_t least_steps = 4;           ///< Shorter pieces belong to the turn around them; >= 1.
  double mark_reach_m = 2.0;             ///< A mark this near a turn is the turn's; 0 to 20.
  double length_sigma_ratio = 0.02;      ///< Of a segment beside its steps' own; 0.001 to 0.5.
  double direction_sigma_rad = 0.032;    ///< The same: 1.8 degrees; 0.001 to 1.

  core::Result<void> validate() const;
  bool operator==(const SegmentationOptions&) const = default;
};

/// Steps in order of time to straight segments, [Zhong2017] 2.7: a new one where directions leave
/// the mean of the last by more than 20 degrees, and at each mark. Steps of the turn itself count
/// by what they advance along the segments beside it. Standing is passed over; a mark before the
/// first or after the last step names the walk's end. No step, no segment. kInvalidOptions;
/// kInvalidArgument for numbers that are not finite, lengths below zero and times out of order.
core::Result<Walk> walk_from_motion(std::span<const observation::MotionDelta> motion,
                                    std::span<const LandmarkMark> marks,
                                    const SegmentationOptions& options);

}  // namespace waylode::structure
