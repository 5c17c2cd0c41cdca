// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/path_memory.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {

core::Vector2 displacement_m(const observation::MotionDelta& motion) {
  return motion.length_m *
         core::Vector2(std::cos(motion.heading_rad), std::sin(motion.heading_rad));
}

void PathMemory::add(const observation::MotionDelta& motion) {
  WAYLODE_ASSERT(detail::is_sound(motion) && is_in_order(motion.end));
  if (points_.empty()) points_.push_back({motion.begin, core::Vector2::Zero()});
  if (points_.back().time < motion.begin) points_.push_back({motion.begin, points_.back().path_m});
  points_.push_back({motion.end, points_.back().path_m + displacement_m(motion)});
  constexpr double kMemory_s = 30.0;
  while (points_.size() > 2 && points_[1].time < motion.end - core::from_seconds(kMemory_s)) {
    points_.pop_front();
  }
  last_ = motion;
}

core::Vector2 PathMemory::offset_m(core::DeviceTime time) const {
  if (!last_) return core::Vector2::Zero();
  return time < last_->end ? back_m(time) : beyond_m(time);
}

core::Vector2 PathMemory::back_m(core::DeviceTime time) const {
  const core::Vector2& newest_m = points_.back().path_m;
  const auto after = std::ranges::lower_bound(points_, time, {}, &Point::time);
  if (after == points_.begin()) return after->path_m - newest_m;
  const auto before = std::prev(after);
  const double span_s = core::to_seconds(after->time - before->time);
  const double share = span_s > 0.0 ? core::to_seconds(time - before->time) / span_s : 1.0;
  return before->path_m + share * (after->path_m - before->path_m) - newest_m;
}

core::Vector2 PathMemory::beyond_m(core::DeviceTime time) const {
  const double step_s = core::to_seconds(last_->end - last_->begin);
  const double since_s = core::to_seconds(time - last_->end);
  if (since_s <= 0.0 || since_s > 2.0 * step_s) return core::Vector2::Zero();
  return std::min(1.0, since_s / step_s) * displacement_m(*last_);
}

std::optional<core::DeviceTime> PathMemory::oldest() const {
  return points_.empty() ? std::nullopt : std::optional(points_.front().time);
}

void PathMemory::clear() {
  points_.clear();
  last_.reset();
}

}  // namespace waylode::fusion
