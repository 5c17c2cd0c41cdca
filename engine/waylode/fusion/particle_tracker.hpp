// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/fusion/floor_filter.hpp"
#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/fusion/particle_filter.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/site/site.hpp"

namespace waylode::fusion {

/// What the particles of a site walk on, floor by floor; null where it is not known.
struct Terrain {
  std::shared_ptr<const std::vector<site::Walkability>> walkability;
  std::shared_ptr<const std::vector<magnetic::FieldLikelihood>> fields;
};

/// The causal tracker: floor by the floor filter, place by particles. One phone, one tracker.
class ParticleTracker {
 public:
  struct Options {
    ParticleFilter::Options particles;
    FloorFilter::Options floor;
    StateRules state;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  ParticleTracker(std::shared_ptr<const site::Site> site, Terrain terrain, const Options& options,
                  std::optional<core::FloorId> known_floor, bool keep_history = false);

  /// Starts from a place instead of the first scan; scans may overrule it, the floor as well. Steps
  /// that ended by then are passed over.
  void start(core::DeviceTime time, core::FloorId floor, const core::Vector2& position_m,
             double sigma_m);
  void add(const observation::MotionDelta& motion);
  /// Hypotheses without a raster are passed over.
  void add(const observation::RadioObservation& observation);
  void add(const observation::VerticalMotion& motion) { floor_filter_.add(motion); }
  /// A scan that the map knows nothing of: no news of the place, but `outside` until it is known
  /// again.
  void hear_unknown(core::DeviceTime delivered) { newest_scan_ = HeardScan{delivered, 0.0}; }

  /// nullopt before anything is known. `time` is not before the last event.
  std::optional<core::Belief> belief_at(core::DeviceTime time) const;
  /// For a belief of belief_at(time), by the newest scan.
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const;

  /// From outside; then never doubted.
  void tell_floor(core::FloorId floor) { known_floor_ = floor; }
  void forget_before(core::DeviceTime time) { particles_.forget_before(time); }

  const ParticleFilter& particles() const { return particles_; }
  std::optional<core::FloorId> floor() const;
  double floor_probability() const;

 private:
  Ground ground(core::FloorId floor) const;

  std::shared_ptr<const site::Site> site_;
  Terrain terrain_;
  Options options_;
  std::optional<core::FloorId> known_floor_;
  FloorFilter floor_filter_;
  ParticleFilter particles_;
  std::optional<core::DeviceTime> placed_at_;  ///< By start().
  std::optional<HeardScan> newest_scan_;
};

}  // namespace waylode::fusion
