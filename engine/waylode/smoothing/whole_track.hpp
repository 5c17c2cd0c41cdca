// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/smoothing/floor_chain.hpp"

namespace waylode::smoothing {

/// The estimate at `time`, linear between the nodes around it; the nearest node's outside their
/// span. `nodes` is not empty and in order of time.
fusion::PlanarEstimate interpolate(const std::vector<fusion::PlanarEstimate>& nodes,
                                   core::DeviceTime time);

/// A whole track, each instant knowing the future as well. This part keeps the events, the floors
/// and the states; what derives from it finds the way.
class WholeTrackSmoother {
 public:
  virtual ~WholeTrackSmoother() = default;

  void add(Event event);
  /// A scan that the map knows nothing of: around its time, the state is `outside`.
  void hear_unknown(core::DeviceTime delivered);
  /// Uses everything added so far. nullopt when no scan has told of a place.
  std::optional<core::Belief> belief_at(core::DeviceTime time) const;
  /// For a belief of belief_at(time), by the scan nearest in time.
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const;

 protected:
  WholeTrackSmoother(std::shared_ptr<const site::Site> site,
                     const fusion::FloorFilter::Options& floor, const fusion::StateRules& state,
                     std::optional<core::FloorId> known_floor);
  WholeTrackSmoother(const WholeTrackSmoother&) = default;
  WholeTrackSmoother& operator=(const WholeTrackSmoother&) = default;

  const std::shared_ptr<const site::Site>& site() const { return site_; }

 private:
  struct Solution {
    std::vector<fusion::PlanarEstimate> nodes;
    std::vector<FloorAt> floors;  ///< Per scan.
  };

  /// By time, site frame; empty when no scan knows its floor. `floors` per scan, not empty.
  virtual std::vector<fusion::PlanarEstimate> smooth_path(
      const std::vector<Event>& events, const std::vector<FloorAt>& floors) const = 0;
  const Solution& solution() const;

  std::shared_ptr<const site::Site> site_;
  fusion::FloorFilter::Options floor_;
  fusion::StateRules state_;
  std::optional<core::FloorId> known_floor_;
  std::vector<Event> events_;
  std::vector<fusion::HeardScan> scans_;
  mutable std::optional<Solution> solution_;  ///< Cache; emptied by add().
};

}  // namespace waylode::smoothing
