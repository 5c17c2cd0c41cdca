// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/fusion/floor_filter.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/site/site.hpp"

namespace waylode::fusion {

/// When a belief is good enough to show.
struct StateRules {
  double ok_radius_m = 15.0;        ///< 95 % region's semi-major axis up to which the state is ok.
  double show_radius_m = 40.0;      ///< Beyond this the position is unknown.
  double floor_probability = 0.7;   ///< Less, and the state is low_confidence at best.
  double known_share_ratio = 0.35;  ///< Less of the signal known: off the surveyed area.
  /// Phones scan every few seconds, or twice a minute where the system holds them back: a scan
  /// older than that is missing, and the state is low_confidence at best.
  double stale_after_s = 30.0;
  double lost_after_s = 120.0;  ///< Without a scan this long: unknown, whatever the covariance.

  core::Result<void> validate() const;
  bool operator==(const StateRules&) const = default;
};

/// A scan as far as the state depends on it.
struct HeardScan {
  core::DeviceTime delivered;
  double known_share_ratio = 1.0;  ///< 0 for a scan that the map knows nothing of.
};

/// The state that a belief for `time` deserves, given the scan nearest to it. Without any scan (a
/// method that does not listen) the covariance alone speaks. Off the surveyed area is `outside`
/// however old the scan.
core::FixState state_of(const core::Belief& belief, core::DeviceTime time,
                        const std::optional<HeardScan>& scan, const StateRules& rules);

/// The scan delivered nearest to `time`, the earlier of two; nullopt when there is none. `scans`
/// by time.
std::optional<HeardScan> nearest_scan(std::span<const HeardScan> scans, core::DeviceTime time);

/// A radio position on one floor, carried to the site frame.
PlanarMeasurement to_site_frame(const site::Site& site,
                                const observation::RadioObservation& observation,
                                const observation::FloorHypothesis& hypothesis);
/// A site-frame state as a belief on a floor.
core::Belief to_floor_frame(const site::Site& site, core::FloorId floor, double probability,
                            const PlanarState& state);
core::Belief to_floor_frame(const site::Site& site, core::FloorId floor, double probability,
                            const PlanarEstimate& estimate);
/// The hypothesis of a floor, or null.
const observation::FloorHypothesis* find_hypothesis(
    const observation::RadioObservation& observation, core::FloorId floor);
/// The levels of the site's floors.
std::vector<int> levels_of(const site::Site& site);
/// A step with its heading on the site frame, as far as the survey learnt it.
observation::MotionDelta on_site_frame(const observation::MotionDelta& motion,
                                       const site::Floor& floor);

/// The causal tracker: floor by vote, place by the robust filter. One phone, one tracker.
class FusedTracker {
 public:
  struct Options {
    PlanarTracker::Options planar;
    FloorFilter::Options floor;
    StateRules state;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  FusedTracker(std::shared_ptr<const site::Site> site, const Options& options,
               std::optional<core::FloorId> known_floor, bool keep_history = false);

  /// Starts from a place instead of the first scan. Steps that ended by then are passed over.
  void start(core::DeviceTime time, core::FloorId floor, const core::Vector2& position_m,
             double sigma_m);
  void add(const observation::MotionDelta& motion);
  void add(const observation::RadioObservation& observation);
  void add(const observation::VerticalMotion& motion) { floor_filter_.add(motion); }
  /// A scan that the map knows nothing of: no news of the place, but `outside` until it is known
  /// again.
  void hear_unknown(core::DeviceTime delivered) { newest_scan_ = HeardScan{delivered, 0.0}; }

  /// nullopt before anything is known. `time` is not before the last event.
  std::optional<core::Belief> belief_at(core::DeviceTime time) const;
  /// For a belief of belief_at(time), by the newest scan.
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const;

  const PlanarTracker& planar() const { return planar_; }
  PlanarTracker& planar() { return planar_; }
  std::optional<core::FloorId> floor() const;
  double floor_probability() const;

 private:
  std::shared_ptr<const site::Site> site_;
  Options options_;
  std::optional<core::FloorId> known_floor_;
  FloorFilter floor_filter_;
  PlanarTracker planar_;
  std::optional<core::DeviceTime> placed_at_;  ///< By start().
  std::optional<HeardScan> newest_scan_;
};

}  // namespace waylode::fusion
