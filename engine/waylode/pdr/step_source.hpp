// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/time.hpp"

namespace waylode::pdr {

/// One footfall.
struct Step {
  core::DeviceTime time;       ///< Of the acceleration's peak.
  double swing_mps2 = 0.0;     ///< Largest less smallest vertical acceleration within the step.
  double mean_abs_mps2 = 0.0;  ///< Mean |linear vertical acceleration| within the step.
  double interval_s = 0.0;     ///< Since the previous step, capped at the longest interval.
  double mean_mps2 = 0.0;      ///< Mean linear vertical acceleration within the step, signed.
  double lowest_mps2 = 0.0;    ///< Smallest linear vertical acceleration within the step.
};

/// The acceleration of one instant as step detectors see it, gravity taken off.
struct StepInput {
  core::DeviceTime time;
  double vertical_mps2 = 0.0;  ///< Along up, less gravity.
  double norm_mps2 = 0.0;      ///< Length of the specific force, less gravity; needs no attitude.
};

/// Finds footfalls in a stream, with no look ahead: a step is told when it is confirmed, a fraction
/// of a second after its peak. Times must not decrease.
class StepSource {
 public:
  virtual ~StepSource() = default;
  virtual std::optional<Step> add(const StepInput& input) = 0;
};

}  // namespace waylode::pdr
