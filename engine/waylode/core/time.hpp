// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace waylode::core {

/// Spans of time, exact to the nanosecond.
using Duration = std::chrono::nanoseconds;

/// The phone's own clock: monotonic while one log lasts; its zero means nothing outside the log.
/// A log that has a single clock (ILC) uses that clock as device time.
struct DeviceClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<DeviceClock>;
  static constexpr bool is_steady = true;
};
using DeviceTime = DeviceClock::time_point;

/// Coordinated universal time since 1970-01-01, leap seconds not counted.
struct UtcClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<UtcClock>;
  static constexpr bool is_steady = false;
};
using UtcTime = UtcClock::time_point;

/// For formulas only; everything that is stored or compared stays a Duration.
constexpr double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Rounds to the nearest nanosecond. `seconds` must be finite and within +-292 years.
constexpr Duration from_seconds(double seconds) {
  const double nanoseconds = seconds * 1e9;
  return Duration(static_cast<std::int64_t>(nanoseconds + (nanoseconds < 0.0 ? -0.5 : 0.5)));
}

constexpr DeviceTime device_time_from_seconds(double seconds) {
  return DeviceTime(from_seconds(seconds));
}

constexpr DeviceTime device_time_from_ms(std::int64_t milliseconds) {
  return DeviceTime(std::chrono::milliseconds(milliseconds));
}

}  // namespace waylode::core
