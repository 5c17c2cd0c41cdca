// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/fusion/particle_tracker.hpp"
#include "waylode/smoothing/whole_track.hpp"

namespace waylode::smoothing {

/// A whole track by particles: their descent from the end.
class ParticleSmoother final : public WholeTrackSmoother {
 public:
  struct Options {
    fusion::ParticleTracker::Options tracker;
    std::size_t particles = 4000;  ///< More than live use needs: most leave no descendants.
    double horizon_s = 60.0;       ///< How much of its future an instant knows, at most.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  ParticleSmoother(std::shared_ptr<const site::Site> site, fusion::Terrain terrain,
                   const Options& options, std::optional<core::FloorId> known_floor);

 private:
  std::vector<fusion::PlanarEstimate> smooth_path(
      const std::vector<Event>& events, const std::vector<FloorAt>& floors) const override;

  fusion::Terrain terrain_;
  Options options_;
};

/// The same idea for live use: answers `lag` late, from the history of the causal tracker.
class FixedLagParticles {
 public:
  FixedLagParticles(std::shared_ptr<const site::Site> site, fusion::Terrain terrain,
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
