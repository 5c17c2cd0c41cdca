// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/step_detector.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pdr {

core::Result<void> StepDetector::Options::validate() const {
  const bool sound = low_pass_hz > 0.0 && min_peak_mps2 > 0.0 && relative_peak_ratio >= 0.0 &&
                     relative_peak_ratio < 1.0 && shortest_interval_s > 0.0 &&
                     longest_interval_s > shortest_interval_s;
  if (!sound) {
    return core::fail(
        core::ErrorCode::kInvalidOptions,
        "need positive values, relative_peak_ratio < 1 and longest > shortest interval",
        "step_detector");
  }
  return {};
}

std::optional<Step> StepDetector::add(const StepInput& input) {
  if (!std::isfinite(input.vertical_mps2)) return std::nullopt;
  const double value_mps2 = smooth(input.time, input.vertical_mps2);
  lowest_mps2_ = std::min(lowest_mps2_, value_mps2);
  sum_mps2_ += value_mps2;
  abs_sum_mps2_ += std::abs(value_mps2);
  ++count_;
  if (value_mps2 > peak_mps2_) {
    peak_mps2_ = value_mps2;
    peak_time_ = input.time;
  }
  if (value_mps2 > 0.0) return std::nullopt;

  const bool high_enough = peak_mps2_ >= threshold_mps2();
  const bool late_enough =
      !last_step_ || core::to_seconds(peak_time_ - *last_step_) >= options_.shortest_interval_s;
  if (high_enough && late_enough) return take_step();
  peak_mps2_ = 0.0;
  return std::nullopt;
}

double StepDetector::smooth(core::DeviceTime time, double vertical_mps2) {
  const double dt_s = last_sample_ ? core::to_seconds(time - *last_sample_) : 0.0;
  const bool gap = !last_sample_ || dt_s > options_.longest_interval_s;
  last_sample_ = time;
  if (gap) {
    low_pass_.restart(vertical_mps2);
    forget_extremes();
    return vertical_mps2;
  }
  return low_pass_.add(vertical_mps2, dt_s);
}

bool StepDetector::continues_walk() const {
  return last_step_ && core::to_seconds(peak_time_ - *last_step_) <= options_.longest_interval_s;
}

double StepDetector::threshold_mps2() const {
  // The peaks of an earlier walk say nothing about this one, which may be gentler.
  if (!continues_walk()) return options_.min_peak_mps2;
  return std::max(options_.min_peak_mps2, options_.relative_peak_ratio * recent_peak_mps2_);
}

void StepDetector::forget_extremes() {
  lowest_mps2_ = 0.0;
  peak_mps2_ = 0.0;
  sum_mps2_ = 0.0;
  abs_sum_mps2_ = 0.0;
  count_ = 0;
}

Step StepDetector::take_step() {
  const bool walking = continues_walk();
  Step step;
  step.time = peak_time_;
  step.swing_mps2 = peak_mps2_ - lowest_mps2_;
  step.lowest_mps2 = lowest_mps2_;
  step.mean_mps2 = sum_mps2_ / static_cast<double>(count_);
  step.mean_abs_mps2 = abs_sum_mps2_ / static_cast<double>(count_);
  step.interval_s =
      walking ? core::to_seconds(peak_time_ - *last_step_) : options_.longest_interval_s;
  constexpr double kForget = 0.25;  // Share of the newest peak in the running mean.
  recent_peak_mps2_ =
      walking ? recent_peak_mps2_ + kForget * (peak_mps2_ - recent_peak_mps2_) : peak_mps2_;
  last_step_ = peak_time_;
  forget_extremes();
  return step;
}

}  // namespace waylode::pdr
