// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/labelled_path.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::survey {
namespace {

double heading_of(const core::Vector2& vector) { return std::atan2(vector.y(), vector.x()); }

}  // namespace

core::Result<void> LabelledPath::Options::validate() const {
  if (!(widest_scale > 1.0 && shortest_shaped_m > 0.0 && fastest_mps > 0.0 && longest_gap_s > 0.0 &&
        mark_sigma_m > 0.0 && drift_sigma_ratio >= 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "values must be positive and widest_scale above 1", "labelled_path");
  }
  return {};
}

LabelledPath::LabelledPath(const Options& options, std::span<const PlacedWaypoint> waypoints,
                           std::span<const observation::MotionDelta> steps)
    : options_(options), waypoints_(waypoints.begin(), waypoints.end()) {
  core::Vector2 path_m = core::Vector2::Zero();
  double walked_m = 0.0;
  for (const observation::MotionDelta& step : steps) {
    if (reckoned_.empty() || reckoned_.back().time < step.begin) {
      reckoned_.push_back({step.begin, path_m, walked_m});
    }
    path_m += step.length_m * core::Vector2(std::cos(step.heading_rad), std::sin(step.heading_rad));
    walked_m += step.length_m;
    reckoned_.push_back({step.end, path_m, walked_m});
  }
  for (std::size_t i = 1; i < waypoints_.size(); ++i) {
    stretches_.push_back(fit(waypoints_[i - 1], waypoints_[i]));
  }
}

LabelledPath::PathPoint LabelledPath::reckoned_at(core::DeviceTime time) const {
  if (reckoned_.empty()) return {time, core::Vector2::Zero(), 0.0};
  const auto after = std::ranges::lower_bound(reckoned_, time, {}, &PathPoint::time);
  if (after == reckoned_.begin()) return reckoned_.front();
  if (after == reckoned_.end()) return reckoned_.back();
  const auto before = std::prev(after);
  const double share =
      core::to_seconds(time - before->time) / core::to_seconds(after->time - before->time);
  return {time, before->path_m + share * (after->path_m - before->path_m),
          before->walked_m + share * (after->walked_m - before->walked_m)};
}

LabelledPath::Stretch LabelledPath::fit(const PlacedWaypoint& from,
                                        const PlacedWaypoint& to) const {
  Stretch stretch;
  stretch.floor = from.floor;
  const double dt_s = core::to_seconds(to.time - from.time);
  const core::Vector2 marked_m = to.position_m - from.position_m;
  stretch.marked_m = marked_m.norm();
  stretch.rejected = from.floor != to.floor || dt_s <= 0.0 || dt_s > options_.longest_gap_s ||
                     stretch.marked_m > options_.fastest_mps * dt_s;
  const core::Vector2 reckoned_m = reckoned_at(to.time).path_m - reckoned_at(from.time).path_m;
  stretch.reckoned_m = reckoned_m.norm();
  stretch.turn_rad = core::wrap_angle(heading_of(marked_m) - heading_of(reckoned_m));
  const double scale = stretch.reckoned_m > 0.0 ? stretch.marked_m / stretch.reckoned_m : 0.0;
  stretch.shaped = stretch.marked_m >= options_.shortest_shaped_m &&
                   scale <= options_.widest_scale && scale >= 1.0 / options_.widest_scale;
  return stretch;
}

std::optional<Label> LabelledPath::at(core::DeviceTime time) const {
  if (waypoints_.size() < 2 || time < waypoints_.front().time || time > waypoints_.back().time) {
    return std::nullopt;
  }
  const auto next = std::ranges::upper_bound(waypoints_, time, {}, &PlacedWaypoint::time);
  const auto index = std::min<std::size_t>(static_cast<std::size_t>(next - waypoints_.begin()) - 1,
                                           stretches_.size() - 1);
  const Stretch& stretch = stretches_[index];
  if (stretch.rejected) return std::nullopt;

  const PlacedWaypoint& from = waypoints_[index];
  const PlacedWaypoint& to = waypoints_[index + 1];
  const PathPoint begin = reckoned_at(from.time);
  const PathPoint here = reckoned_at(time);
  const PathPoint end = reckoned_at(to.time);
  Label label{from.floor, from.position_m, options_.mark_sigma_m};
  if (stretch.shaped) {
    const Eigen::Rotation2Dd turn(stretch.turn_rad);
    label.position_m +=
        stretch.marked_m / stretch.reckoned_m * (turn * (here.path_m - begin.path_m));
  } else {
    const double walked_m = end.walked_m - begin.walked_m;
    const double share =
        walked_m > options_.shortest_shaped_m
            ? (here.walked_m - begin.walked_m) / walked_m
            : core::to_seconds(time - from.time) / core::to_seconds(to.time - from.time);
    label.position_m += share * (to.position_m - from.position_m);
  }
  const double to_mark_m = std::min(here.walked_m - begin.walked_m, end.walked_m - here.walked_m);
  label.sigma_m = std::hypot(options_.mark_sigma_m, options_.drift_sigma_ratio * to_mark_m);
  return label;
}

}  // namespace waylode::survey
