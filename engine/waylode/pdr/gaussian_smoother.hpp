// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/time.hpp"
#include "waylode/pdr/timed_value.hpp"

namespace waylode::pdr {

/// Gaussian smoothing over a window of time: each value is the mean of those around it, and is told
/// when the later half of its window has come in. Any rate, also an unsteady one.
class GaussianSmoother {
 public:
  /// The window is six standard deviations wide. `window_s` > 0.
  explicit GaussianSmoother(double window_s) : window_s_(window_s) {}

  /// The smoothed value half a window before `time`; nullopt until a window is full. Times must
  /// not decrease, values must be finite.
  std::optional<TimedValue> add(core::DeviceTime time, double value);
  void clear() { window_.clear(); }

 private:
  double window_s_;
  std::deque<TimedValue> window_;  ///< Of the last window_s_, and the newest before it.
};

}  // namespace waylode::pdr
