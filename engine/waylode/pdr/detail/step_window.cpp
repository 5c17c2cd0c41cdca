// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/detail/step_window.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pdr::detail {

void StepWindow::add(core::DeviceTime time, double value_mps2) {
  samples_.push_back({time, value_mps2});
  const core::Duration longest = core::from_seconds(longest_interval_s_);
  while (samples_.front().time < time - longest) samples_.pop_front();
}

Step StepWindow::take(core::DeviceTime peak_time) {
  Step step;
  step.time = peak_time;
  step.interval_s = longest_interval_s_;
  if (last_step_) {
    step.interval_s = std::min(step.interval_s, core::to_seconds(peak_time - *last_step_));
  }
  last_step_ = peak_time;
  if (samples_.empty()) return step;

  step.lowest_mps2 = samples_.front().value_mps2;
  double highest_mps2 = step.lowest_mps2;
  for (const Sample& sample : samples_) {
    step.lowest_mps2 = std::min(step.lowest_mps2, sample.value_mps2);
    highest_mps2 = std::max(highest_mps2, sample.value_mps2);
    step.mean_mps2 += sample.value_mps2;
    step.mean_abs_mps2 += std::abs(sample.value_mps2);
  }
  step.swing_mps2 = highest_mps2 - step.lowest_mps2;
  step.mean_mps2 /= static_cast<double>(samples_.size());
  step.mean_abs_mps2 /= static_cast<double>(samples_.size());
  samples_.clear();
  return step;
}

}  // namespace waylode::pdr::detail
