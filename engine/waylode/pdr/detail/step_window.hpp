// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr::detail {

/// The acceleration since the last step, as far back as a step may last, so that a pause before a
/// step is not taken for part of it.
class StepWindow {
 public:
  explicit StepWindow(double longest_interval_s) : longest_interval_s_(longest_interval_s) {}

  void add(core::DeviceTime time, double value_mps2);
  /// The step whose peak was at `peak_time`, with what was added since the last one.
  Step take(core::DeviceTime peak_time);
  /// Forgets the acceleration, as after a hole in the data; the last step's time remains.
  void clear() { samples_.clear(); }
  const std::optional<core::DeviceTime>& last_step() const { return last_step_; }

 private:
  struct Sample {
    core::DeviceTime time;
    double value_mps2 = 0.0;
  };
  double longest_interval_s_;
  std::deque<Sample> samples_;
  std::optional<core::DeviceTime> last_step_;
};

}  // namespace waylode::pdr::detail
