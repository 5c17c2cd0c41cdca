// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/fusion/particle_tracker.hpp"
#include "waylode/smoothing/smoothed_tracker.hpp"

namespace waylode::smoothing {

/// A whole track by particles, each instant knowing the future as well.
class ParticleSmoother {
 public:
  struct Options {
    fusion::ParticleTracker::Options tracker;
    std::size_t particles = 4000;  ///< More than live use needs: most leave no descendants.
    double horizon_s = 60.0;       ///< How much of its future an instant knows, at most.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  ParticleSmoother(std::shared_ptr<const site::Site> site,
                   std::shared_ptr<const std::vector<site::Walkability>> walkability,
                   const Options& options, std::optional<core::FloorId> known_floor);

  void add(Event event);
  /// A scan that the map knows nothing of: around its time, the state is `outside`.
  void hear_unknown(core::DeviceTime delivered);
  /// Uses everything added so far. nullopt when no scan has told of a place.
  std::optional<core::Belief> belief_at(core::DeviceTime time) const;
  /// For a belief of belief_at(time), by the scan nearest in time.
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const;

 private:
  struct Solution {
    std::vector<fusion::PlanarEstimate> nodes;
    std::vector<FloorAt> floors;  ///< Per scan.
  };
  const Solution& solution() const;
  std::vector<fusion::PlanarEstimate> smooth_path(const std::vector<FloorAt>& floors) const;

  std::shared_ptr<const site::Site> site_;
  std::shared_ptr<const std::vector<site::Walkability>> walkability_;
  Options options_;
  std::optional<core::FloorId> known_floor_;
  std::vector<Event> events_;
  std::vector<fusion::HeardScan> scans_;
  mutable std::optional<Solution> solution_;  ///< Cache; emptied by add().
};

/// The same idea for live use: answers `lag` late, from the history of the causal tracker.
class FixedLagParticles {
 public:
  FixedLagParticles(std::shared_ptr<const site::Site> site,
                    std::shared_ptr<const std::vector<site::Walkability>> walkability,
                    const fusion::ParticleTracker::Options& options,
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
  fusion::ParticleTracker tracker_;
  fusion::ParticleTracker::Options options_;
  core::Duration lag_;
  std::vector<fusion::HeardScan> scans_;  ///< As far back as the lag reaches, and one before.
};

}  // namespace waylode::smoothing
