// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/capture_clock.hpp"

#include <algorithm>
#include <chrono>

namespace waylode::log::detail {
namespace {

/// Longer than phones batch sensor events when the screen is on.
constexpr core::Duration kMaxDelay = std::chrono::seconds(10);

}  // namespace

core::DeviceTime CaptureClock::map(core::DeviceTime arrival, core::Duration capture) {
  const core::Duration lag = arrival.time_since_epoch() - capture;
  const bool is_continuous = offset_ && capture >= last_capture_ && lag - *offset_ <= kMaxDelay;
  const core::DeviceTime earliest = offset_ ? last_mapped_ : core::DeviceTime::min();
  offset_ = is_continuous ? std::min(*offset_, lag) : lag;
  last_capture_ = capture;
  last_mapped_ = std::min(arrival, std::max(earliest, core::DeviceTime(capture + *offset_)));
  return last_mapped_;
}

std::optional<core::DeviceTime> CaptureClock::look_up(core::Duration capture) const {
  if (!offset_) return std::nullopt;
  return core::DeviceTime(capture + *offset_);
}

}  // namespace waylode::log::detail
