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

using Event = std::variant<observation::MotionDelta, observation::RadioObservation>;

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
  struct FloorAt {
    core::DeviceTime time;
    core::FloorId floor;
    double probability = 1.0;
  };
  struct Solution {
    std::vector<fusion::PlanarState> nodes;
    std::vector<FloorAt> floors;  ///< Per scan.
  };

  const Solution& solution() const;
  std::vector<FloorAt> smooth_floors() const;
  std::vector<fusion::PlanarState> smooth_path(const std::vector<FloorAt>& floors) const;

  std::shared_ptr<const site::Site> site_;
  Options options_;
  std::optional<core::FloorId> known_floor_;
  std::vector<Event> events_;
  std::vector<fusion::HeardScan> scans_;
  mutable std::optional<Solution> solution_;  ///< Cache; emptied by add().
};

/// The same idea for live use: answers `lag` late, from the history of the causal tracker.
class FixedLagTracker {
 public:
  FixedLagTracker(std::shared_ptr<const site::Site> site,
                  const fusion::FusedTracker::Options& options,
                  std::optional<core::FloorId> known_floor, core::Duration lag);

  void add(const Event& event);
  /// As of the whole track.
  void hear_unknown(core::DeviceTime delivered);
  /// `time` not before the newest event less the lag.
  std::optional<core::Belief> belief_at(core::DeviceTime time) const;
  /// For a belief of belief_at(time), by the scan nearest in time.
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const;

 private:
  void keep(const fusion::HeardScan& scan);

  std::shared_ptr<const site::Site> site_;
  fusion::FusedTracker tracker_;
  core::Duration lag_;
  fusion::StateRules rules_;
  std::vector<fusion::HeardScan> scans_;  ///< As far back as the lag reaches, and one before.
};

}  // namespace waylode::smoothing
