// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/fused_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "waylode/core/angle.hpp"
#include "waylode/core/covariance.hpp"

namespace waylode::fusion {

core::Result<void> StateRules::validate() const {
  if (!(ok_radius_m > 0.0 && show_radius_m >= ok_radius_m && floor_probability >= 0.0 &&
        known_share_ratio >= 0.0 && stale_after_s > 0.0 && lost_after_s >= stale_after_s)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need 0 < ok_radius_m <= show_radius_m, 0 < stale_after_s <= lost_after_s",
                      "state_rules");
  }
  return {};
}

core::FixState state_of(const core::Belief& belief, core::DeviceTime time,
                        const std::optional<HeardScan>& scan, const StateRules& rules) {
  if (scan && scan->known_share_ratio < rules.known_share_ratio) return core::FixState::kOutside;
  const double age_s = scan ? std::abs(core::to_seconds(time - scan->delivered)) : 0.0;
  if (age_s > rules.lost_after_s) return core::FixState::kUnknown;
  const double radius_m = core::confidence_ellipse(belief.covariance_m2, 0.95).semi_major_m;
  if (radius_m > rules.show_radius_m) return core::FixState::kUnknown;
  if (radius_m > rules.ok_radius_m || belief.floor_probability < rules.floor_probability ||
      age_s > rules.stale_after_s) {
    return core::FixState::kLowConfidence;
  }
  return core::FixState::kOk;
}

std::optional<HeardScan> nearest_scan(std::span<const HeardScan> scans, core::DeviceTime time) {
  if (scans.empty()) return std::nullopt;
  const auto after = std::ranges::lower_bound(scans, time, {}, &HeardScan::delivered);
  if (after == scans.begin()) return *after;
  const auto before = std::prev(after);
  if (after == scans.end()) return *before;
  return after->delivered - time < time - before->delivered ? *after : *before;
}

PlanarMeasurement to_site_frame(const site::Site& site,
                                const observation::RadioObservation& observation,
                                const observation::FloorHypothesis& hypothesis) {
  return {observation.measured, observation.delivered,
          site.site_from_floor(hypothesis.floor, hypothesis.position_m),
          site.floor(hypothesis.floor).site_from_floor.map_covariance(hypothesis.covariance_m2)};
}

core::Belief to_floor_frame(const site::Site& site, core::FloorId floor, double probability,
                            const PlanarEstimate& estimate) {
  const core::Affine2 floor_from_site = site.floor(floor).site_from_floor.inverse();
  return {floor, probability, floor_from_site * estimate.position_m,
          floor_from_site.map_covariance(estimate.covariance_m2)};
}

core::Belief to_floor_frame(const site::Site& site, core::FloorId floor, double probability,
                            const PlanarState& state) {
  return to_floor_frame(
      site, floor, probability,
      PlanarEstimate{state.time, state.position_m(), state.position_covariance_m2()});
}

const observation::FloorHypothesis* find_hypothesis(
    const observation::RadioObservation& observation, core::FloorId floor) {
  const auto found =
      std::ranges::find(observation.floors, floor, &observation::FloorHypothesis::floor);
  return found == observation.floors.end() ? nullptr : &*found;
}

std::vector<int> levels_of(const site::Site& site) {
  std::vector<int> levels;
  for (const site::Floor& floor : site.floors()) levels.push_back(floor.level);
  return levels;
}

observation::MotionDelta on_site_frame(const observation::MotionDelta& motion,
                                       const site::Floor& floor) {
  observation::MotionDelta result = motion;
  result.heading_rad = core::wrap_angle(motion.heading_rad + floor.heading_offset_rad);
  return result;
}

core::Result<void> FusedTracker::Options::validate() const {
  for (const core::Result<void>& part : {planar.validate(), floor.validate(), state.validate()}) {
    if (!part) return part;
  }
  return {};
}

FusedTracker::FusedTracker(std::shared_ptr<const site::Site> site, const Options& options,
                           std::optional<core::FloorId> known_floor, bool keep_history)
    : site_(std::move(site)),
      options_(options),
      known_floor_(known_floor),
      floor_filter_(options.floor, levels_of(*site_)),
      planar_(options.planar, keep_history) {}

void FusedTracker::start(core::DeviceTime time, core::FloorId floor,
                         const core::Vector2& position_m, double sigma_m) {
  known_floor_ = floor;
  placed_at_ = time;
  planar_.start(time, site_->site_from_floor(floor, position_m), sigma_m);
}

void FusedTracker::add(const observation::MotionDelta& motion) {
  if (!planar_.started() || !floor()) return;
  if (placed_at_ && motion.end <= *placed_at_) return;
  planar_.add(on_site_frame(motion, site_->floor(*floor())));
}

void FusedTracker::add(const observation::RadioObservation& observation) {
  floor_filter_.add(observation);
  newest_scan_ = HeardScan{observation.delivered, observation.known_share_ratio};
  const observation::FloorHypothesis* hypothesis = find_hypothesis(observation, *floor());
  if (hypothesis != nullptr) planar_.add(to_site_frame(*site_, observation, *hypothesis));
}

std::optional<core::Belief> FusedTracker::belief_at(core::DeviceTime time) const {
  if (!planar_.started() || !floor()) return std::nullopt;
  return to_floor_frame(*site_, *floor(), floor_probability(), planar_.at(time));
}

core::FixState FusedTracker::state_at(core::DeviceTime time, const core::Belief& belief) const {
  return state_of(belief, time, newest_scan_, options_.state);
}

std::optional<core::FloorId> FusedTracker::floor() const {
  return known_floor_ ? known_floor_ : floor_filter_.most_likely();
}

double FusedTracker::floor_probability() const {
  if (known_floor_) return 1.0;
  return *std::ranges::max_element(floor_filter_.probabilities());
}

}  // namespace waylode::fusion
