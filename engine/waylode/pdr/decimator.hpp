// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/pdr/timed_value.hpp"

namespace waylode::pdr {

/// Thins a stream out to a lower rate, by time rather than by counting, so that 100 Hz, 50 Hz and
/// unsteady rates come out alike. A slower stream passes at its own rate.
class Decimator {
 public:
  struct Options {
    double interval_s = 0.04;  ///< Between two values, in (0, 10]; [Zhong2017] 25 Hz.
    /// Average over three intervals (Hann weights) before thinning, which takes away what the low
    /// rate cannot tell from a walk. Off: one sample in so many, as [Zhong2017] prints it.
    bool anti_alias = true;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit Decimator(const Options& options) : options_(options) {}

  /// One value at most per sample; the averaged one is 1.5 intervals old. Times must not decrease,
  /// values must be finite.
  std::optional<TimedValue> add(core::DeviceTime time, double value);
  /// After a hole in the data.
  void clear();

 private:
  std::optional<TimedValue> average(core::DeviceTime now);

  Options options_;
  std::optional<core::DeviceTime> due_;
  std::deque<TimedValue> samples_;  ///< As far back as the average looks.
};

}  // namespace waylode::pdr
