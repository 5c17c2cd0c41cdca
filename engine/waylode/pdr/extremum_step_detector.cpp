// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/extremum_step_detector.hpp"

#include <cmath>

namespace waylode::pdr {

core::Result<void> ExtremumStepDetector::Options::validate() const {
  if (const auto sound = decimator.validate(); !sound) return sound;
  if (!(std::isfinite(peak_threshold_mps2) && std::isfinite(trough_threshold_mps2) &&
        trough_threshold_mps2 < peak_threshold_mps2 && longest_interval_s > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need trough_threshold_mps2 < peak_threshold_mps2 and a positive "
                      "longest_interval_s",
                      "extremum_step_detector");
  }
  return {};
}

std::optional<TimedValue> ExtremumStepDetector::Filter::add(core::DeviceTime time, double value) {
  const std::optional<TimedValue> thinned = decimator_.add(time, value);
  if (!thinned) return std::nullopt;
  constexpr std::size_t kTaps = 4;
  last_.push_back(*thinned);
  if (last_.size() < kTaps) return std::nullopt;
  // [Zhong2017] eq. (1). Told for the middle of the four, which takes out the filter's delay.
  TimedValue mean{last_.front().time + (last_.back().time - last_.front().time) / 2, 0.0};
  for (const TimedValue& each : last_) mean.value += each.value / static_cast<double>(kTaps);
  last_.pop_front();
  return mean;
}

void ExtremumStepDetector::Filter::clear() {
  decimator_.clear();
  last_.clear();
}

std::optional<Step> ExtremumStepDetector::add(const StepInput& input) {
  if (!std::isfinite(input.vertical_mps2)) return std::nullopt;
  if (last_sample_ && core::to_seconds(input.time - *last_sample_) > options_.longest_interval_s) {
    filter_.clear();
    window_.clear();
    highest_.reset();
    finder_ = {};
    last_extremum_.reset();
  }
  last_sample_ = input.time;
  const std::optional<TimedValue> value = filter_.add(input.time, input.vertical_mps2);
  if (!value) return std::nullopt;
  window_.add(value->time, value->value);
  const std::optional<core::DeviceTime> peak =
      options_.hysteresis ? by_level(*value) : by_extremes(*value);
  if (!peak) return std::nullopt;
  return window_.take(*peak);
}

std::optional<core::DeviceTime> ExtremumStepDetector::by_level(const TimedValue& value) {
  const double bar_mps2 = highest_ ? highest_->value : options_.peak_threshold_mps2;
  if (value.value > bar_mps2) highest_ = value;
  if (!highest_ || value.value >= options_.trough_threshold_mps2) return std::nullopt;
  const core::DeviceTime peak = highest_->time;
  highest_.reset();
  return peak;
}

std::optional<core::DeviceTime> ExtremumStepDetector::by_extremes(const TimedValue& value) {
  const std::optional<Extremum> extremum = finder_.add(value.time, value.value);
  if (!extremum) return std::nullopt;
  const std::optional<Extremum> before = last_extremum_;
  last_extremum_ = extremum;
  // [Zhong2017] 2.4: J(n-1) > p and J(n) < q.
  const bool is_step = before && before->value > options_.peak_threshold_mps2 &&
                       extremum->value < options_.trough_threshold_mps2;
  return is_step ? std::optional(before->time) : std::nullopt;
}

}  // namespace waylode::pdr
