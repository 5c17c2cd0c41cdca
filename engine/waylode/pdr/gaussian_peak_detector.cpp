// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/gaussian_peak_detector.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pdr {

core::Result<void> GaussianPeakDetector::Options::validate() const {
  const bool sound = window_s > 0.0 && window_s <= 5.0 && min_peak_mps2 > 0.0 &&
                     sample_interval_s >= 0.0 && sample_interval_s <= 5.0 &&
                     shortest_interval_s >= 0.0 && longest_interval_s > shortest_interval_s;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need window_s and sample_interval_s at most 5, a positive min_peak_mps2 and "
                      "longest > shortest interval",
                      "gaussian_peak_detector");
  }
  return {};
}

GaussianPeakDetector::Options GaussianPeakDetector::as_printed() {
  return {.window_s = 2.0, .sample_interval_s = 0.2, .shortest_interval_s = 0.0};
}

std::optional<Step> GaussianPeakDetector::add(const StepInput& input) {
  if (!std::isfinite(input.vertical_mps2) || !is_taken(input.time)) return std::nullopt;
  const std::optional<TimedValue> smooth = smoother_.add(input.time, input.vertical_mps2);
  if (!smooth) return std::nullopt;
  window_.add(smooth->time, smooth->value);
  const std::optional<Extremum> extremum = extremes_.add(smooth->time, smooth->value);
  if (!extremum || !extremum->is_peak || extremum->value <= options_.min_peak_mps2) {
    return std::nullopt;
  }
  const bool late_enough =
      !window_.last_step() ||
      core::to_seconds(extremum->time - *window_.last_step()) >= options_.shortest_interval_s;
  if (!late_enough) return std::nullopt;
  return window_.take(extremum->time);
}

bool GaussianPeakDetector::is_taken(core::DeviceTime time) {
  const double since_s = last_sample_ ? core::to_seconds(time - *last_sample_) : 0.0;
  // A millisecond of grace, lest rounded times make every sixth sample of the fifth.
  constexpr double kGrace_s = 0.001;
  if (last_sample_ && since_s < options_.sample_interval_s - kGrace_s) return false;
  if (since_s > std::max(options_.longest_interval_s, 2.0 * options_.sample_interval_s)) {
    smoother_.clear();
    window_.clear();
    extremes_ = {};
  }
  last_sample_ = time;
  return true;
}

}  // namespace waylode::pdr
