// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/time.hpp"

namespace waylode::log::detail {

/// Puts one sensor's capture times on the clock of the arrivals.
///
/// Every arrival is late by an unknown delay >= 0, so the smallest (arrival - capture) so far is
/// the best causal estimate of the offset between the clocks; capture + offset then has the
/// sensor's own intervals and lies at or before the arrival. The offset starts afresh when the
/// capture clock steps back, or when it falls kMaxDelay behind (a frozen or foreign clock).
class CaptureClock {
 public:
  /// Capture on the arrival clock: never later than `arrival`, never before the previous answer
  /// unless the arrivals themselves step back.
  core::DeviceTime map(core::DeviceTime arrival, core::Duration capture);

  /// Of an instant of the same capture clock; nullopt before the first map().
  std::optional<core::DeviceTime> look_up(core::Duration capture) const;

 private:
  std::optional<core::Duration> offset_;
  core::Duration last_capture_{};
  core::DeviceTime last_mapped_{};
};

}  // namespace waylode::log::detail
