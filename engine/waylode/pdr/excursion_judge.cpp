// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/excursion_judge.hpp"

#include <cmath>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/pdr/step_validity.hpp"

namespace waylode::pdr {
namespace {

constexpr double kHalfStep_s = 0.3;  // Averages the sway of a step away.
constexpr double kLook_s = 0.1;      // Between two looks along the way.

}  // namespace

core::Result<void> ExcursionJudge::Options::validate() const {
  const bool sound = return_rad > 0.0 && leave_rad > return_rad && leave_rad <= core::kPi &&
                     settle_s > 0.0 && settled_rad > 0.0 && longest_s >= settle_s &&
                     longest_s <= 60.0;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need 0 < return_rad < leave_rad <= pi, 0 < settle_s <= longest_s <= 60 and "
                      "settled_rad > 0",
                      "excursion_judge");
  }
  return {};
}

void ExcursionJudge::add(core::DeviceTime time, double heading_rad) {
  if (!std::isfinite(heading_rad)) return;
  directions_.push_back({time, heading_rad});
  // As far back as a step may wait, and the look before it.
  const core::DeviceTime oldest = time - core::from_seconds(options_.longest_s + 5.0);
  while (directions_.front().time < oldest) directions_.pop_front();
}

std::optional<double> ExcursionJudge::mean_rad(core::DeviceTime from, core::DeviceTime to) const {
  std::vector<double> headings_rad;
  for (const Direction& direction : directions_) {
    if (direction.time >= from && direction.time <= to) {
      headings_rad.push_back(direction.heading_rad);
    }
  }
  const auto mean = core::circular_mean(headings_rad);
  if (!mean) return std::nullopt;
  return mean->mean_rad;
}

std::optional<double> ExcursionJudge::off_course_rad(core::DeviceTime time) const {
  const core::Duration half = core::from_seconds(kHalfStep_s);
  const auto here_rad = mean_rad(time - half, time + half);
  if (!here_rad) return std::nullopt;
  return core::wrap_angle(*here_rad - *course_rad_);
}

ExcursionJudge::Verdict ExcursionJudge::turn_to(core::DeviceTime time, double course_rad) {
  turning_until_ = time;
  course_rad_ = course_rad;
  return Verdict::kTurning;
}

std::optional<ExcursionJudge::Verdict> ExcursionJudge::judge(core::DeviceTime time, bool is_last) {
  if (directions_.empty()) return Verdict::kOnCourse;
  if (time <= aside_until_) return Verdict::kAside;
  if (time <= turning_until_) return Verdict::kTurning;
  const core::DeviceTime now = directions_.back().time;
  const core::Duration half = core::from_seconds(kHalfStep_s);
  if (now < time + half && !is_last) return std::nullopt;
  const auto here_rad = mean_rad(time - half, time + half);
  if (!here_rad) return Verdict::kOnCourse;
  if (!course_rad_) course_rad_ = *here_rad;
  const double off_rad = core::wrap_angle(*here_rad - *course_rad_);
  if (std::abs(off_rad) <= options_.return_rad) {
    constexpr double kFollow = 0.3;  // A course bends slowly.
    course_rad_ = core::wrap_angle(*course_rad_ + kFollow * off_rad);
    return Verdict::kOnCourse;
  }
  // Off the course: look along what came after, until it is back, settled elsewhere, or too long.
  bool left = std::abs(off_rad) > options_.leave_rad;
  for (core::DeviceTime look = time; look + half <= now; look += core::from_seconds(kLook_s)) {
    const double off_there_rad = off_course_rad(look).value_or(off_rad);
    left = left || std::abs(off_there_rad) > options_.leave_rad;
    if (std::abs(off_there_rad) <= options_.return_rad) {
      if (!left) return Verdict::kOnCourse;
      aside_until_ = look;
      return Verdict::kAside;
    }
    const core::DeviceTime settled = look + core::from_seconds(options_.settle_s);
    if (settled > now) continue;
    std::vector<double> since_rad;
    for (const Direction& direction : directions_) {
      if (direction.time >= look && direction.time <= settled) {
        since_rad.push_back(direction.heading_rad);
      }
    }
    if (direction_scatter_rad(since_rad) <= options_.settled_rad) {
      return turn_to(look, mean_rad(look, settled).value_or(*here_rad));
    }
  }
  const bool too_long = now >= time + core::from_seconds(options_.longest_s);
  if (!too_long && !is_last) return std::nullopt;
  return turn_to(time, *here_rad);
}

}  // namespace waylode::pdr
