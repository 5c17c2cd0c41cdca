// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::smoothing {

using Event = std::variant<observation::MotionDelta, observation::RadioObservation,
                           observation::VerticalMotion>;

/// The floor around a scan.
struct FloorAt {
  core::DeviceTime time;
  core::FloorId floor;
  double probability = 1.0;
};

/// The floor at each scan given all of them and the climbs, or the known one. `levels` as in
/// fusion::FloorFilter.
std::vector<FloorAt> smooth_floors(const std::vector<Event>& events,
                                   std::optional<core::FloorId> known_floor,
                                   const std::vector<int>& levels,
                                   const fusion::FloorFilter::Options& options);

/// The fused tracker run over a whole track, forwards and back, so that each instant knows the
/// future as well. Scans are weighed again each round, by what the smoothed track makes of them.
class TrackSmoother {
 public:
  struct Options {
    fusion::FusedTracker::Options fused;
    int rounds = 8;  ///< Passes over the track; the first weighs scans causally.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  TrackSmoother(std::shared_ptr<const site::Site> site, const Options& options,
                std::optional<core::FloorId> known_floor);

  void add(Event event);
  /// A scan that the map knows nothing of: around its time, the state is `outside`.
  void hear_unknown(core::DeviceTime delivered);
  /// Uses everything added so far. nullopt when no scan has told of a place.
  std::optional<core::Belief> belief_at(core::DeviceTime time) const;
  /// For a belief of belief_at(time), by the scan nearest in time.
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const;

 private:
  struct Solution {
    std::vector<fusion::PlanarState> nodes;
    std::vector<FloorAt> floors;  ///< Per scan.
  };

  const Solution& solution() const;
  std::vector<fusion::PlanarState> smooth_path(const std::vector<FloorAt>& floors) const;

  std::shared_ptr<const site::Site> site_;
  Options options_;
  std::optional<core::FloorId> known_floor_;
  std::vector<Event> events_;
  std::vector<fusion::HeardScan> scans_;
  mutable std::optional<Solution> solution_;  ///< Cache; emptied by add().
};

}  // namespace waylode::smoothing
