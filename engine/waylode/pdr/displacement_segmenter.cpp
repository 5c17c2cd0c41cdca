// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/displacement_segmenter.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

core::Vector2 direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

}  // namespace

core::Result<void> DisplacementSegmenter::Options::validate() const {
  if (!(tolerance_rad > 0.0 && tolerance_rad <= core::kPi / 2.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "tolerance_rad must be in (0, pi/2]",
                      "displacement_segmenter");
  }
  return {};
}

std::optional<Displacement> DisplacementSegmenter::add(const observation::MotionDelta& motion) {
  if (!(motion.length_m > 0.0) || !std::isfinite(motion.length_m) ||
      !std::isfinite(motion.heading_rad)) {
    return std::nullopt;
  }
  std::optional<Displacement> done;
  const bool departs =
      open_ && std::abs(core::wrap_angle(motion.heading_rad - open_->direction_rad)) >
                   options_.tolerance_rad;
  if (departs) done = finish();
  take(motion);
  return done;
}

void DisplacementSegmenter::take(const observation::MotionDelta& motion) {
  if (!open_) {
    open_.emplace();
    open_->begin = motion.begin;
    direction_sum_.setZero();
  }
  open_->end = motion.end;
  open_->length_m += motion.length_m;
  ++open_->step_count;
  // Within tolerance of their mean, directions never cancel.
  direction_sum_ += direction(motion.heading_rad);
  open_->direction_rad = std::atan2(direction_sum_.y(), direction_sum_.x());
}

std::optional<Displacement> DisplacementSegmenter::finish() {
  const std::optional<Displacement> done = open_;
  open_.reset();
  return done;
}

std::vector<double> corner_angles_rad(std::span<const Displacement> displacements) {
  std::vector<double> angles_rad;
  for (std::size_t i = 1; i < displacements.size(); ++i) {
    angles_rad.push_back(
        core::wrap_angle(displacements[i].direction_rad - displacements[i - 1].direction_rad));
  }
  return angles_rad;
}

std::vector<core::Vector2> polyline_m(const core::Vector2& start_m,
                                      std::span<const Displacement> displacements) {
  std::vector<core::Vector2> corners_m{start_m};
  for (const Displacement& each : displacements) {
    corners_m.push_back(corners_m.back() + each.length_m * direction(each.direction_rad));
  }
  return corners_m;
}

}  // namespace waylode::pdr
