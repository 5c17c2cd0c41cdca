// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pdr/dead_reckoning.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::experiment {

/// Options of dead reckoning as [Zhong2017] sets them for one person and phone, from a walk of
/// known length whose steps were counted: thresholds in the middle of what counts right, and the
/// factor that makes the detected steps as long as the walk. `calibration_ok` tells whether a
/// threshold counted right; the nearest is used otherwise.
struct PersonalSetting {
  pdr::DeadReckoning::Options options;
  bool calibration_ok = false;
};
/// kLogLacksRecords when the walk has no steps to calibrate by.
core::Result<PersonalSetting> calibrate_person(std::span<const sample::Sample> walk,
                                               std::size_t step_count, double length_m,
                                               double height_m);

/// The steps that moved, as told by dead reckoning with these options.
std::vector<observation::MotionDelta> walked_steps(std::span<const sample::Sample> walk,
                                                   const pdr::DeadReckoning::Options& options);

/// Sum of the steps.
double walked_m(std::span<const observation::MotionDelta> steps);

/// What integrating the forward acceleration twice gives, the baseline of the paper's second table:
/// the length of the way from the speed along the phone's heading, its mean over the walk taken
/// off.
double integrated_m(std::span<const sample::Sample> walk);

}  // namespace waylode::experiment
