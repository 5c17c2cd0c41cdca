// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/survey/surveyed_recording.hpp"

namespace waylode::survey {

struct Label {
  core::FloorId floor;
  core::Vector2 position_m = core::Vector2::Zero();  ///< Floor frame.
  double sigma_m = 0.0;                              ///< Per axis.
};

/// Where the surveyor was between the marks: the shape is dead reckoning's, turned and scaled so
/// that both ends of each stretch meet their marks. A stretch whose steps do not fit its marks is
/// walked in a straight line, by share of steps.
class LabelledPath {
 public:
  struct Options {
    double widest_scale = 2.0;       ///< PDR may be this much longer or shorter than the marks say.
    double shortest_shaped_m = 1.5;  ///< Marks closer than this do not tell a direction.
    double fastest_mps = 2.5;        ///< A stretch walked faster is mislabelled: no label within.
    double longest_gap_s = 120.0;    ///< A longer stretch between marks gives no label.
    double mark_sigma_m = 0.7;       ///< Per axis; see docs/accuracy.md.
    double drift_sigma_ratio = 0.08;  ///< Of the distance to the nearer mark.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// How well the steps of one stretch fit its marks.
  struct Stretch {
    core::FloorId floor;
    double marked_m = 0.0;    ///< Distance between the marks.
    double reckoned_m = 0.0;  ///< The same by dead reckoning.
    double turn_rad = 0.0;    ///< Heading of the marks less that of dead reckoning.
    bool shaped = false;      ///< Dead reckoning's shape was used.
    bool rejected = false;    ///< No labels from it.
  };

  LabelledPath(const Options& options, std::span<const PlacedWaypoint> waypoints,
               std::span<const observation::MotionDelta> steps);

  /// nullopt outside the marks and on rejected stretches.
  std::optional<Label> at(core::DeviceTime time) const;
  std::span<const Stretch> stretches() const { return stretches_; }

 private:
  struct PathPoint {
    core::DeviceTime time;
    core::Vector2 path_m;
    double walked_m = 0.0;
  };

  PathPoint reckoned_at(core::DeviceTime time) const;
  Stretch fit(const PlacedWaypoint& from, const PlacedWaypoint& to) const;

  Options options_;
  std::vector<PlacedWaypoint> waypoints_;
  std::vector<PathPoint> reckoned_;
  std::vector<Stretch> stretches_;  ///< Between waypoint i and i + 1.
};

}  // namespace waylode::survey
