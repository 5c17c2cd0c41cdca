// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/particle_tracker.hpp"

#include <algorithm>

namespace waylode::fusion {

core::Result<void> ParticleTracker::Options::validate() const {
  for (const core::Result<void>& part :
       {particles.validate(), floor.validate(), state.validate()}) {
    if (!part) return part;
  }
  return {};
}

ParticleTracker::ParticleTracker(std::shared_ptr<const site::Site> site, Terrain terrain,
                                 const Options& options, std::optional<core::FloorId> known_floor,
                                 bool keep_history)
    : site_(std::move(site)),
      terrain_(std::move(terrain)),
      options_(options),
      known_floor_(known_floor),
      floor_filter_(options.floor, levels_of(*site_)),
      particles_(options.particles, /*seed=*/1, keep_history) {}

void ParticleTracker::start(core::DeviceTime time, core::FloorId floor,
                            const core::Vector2& position_m, double sigma_m) {
  placed_at_ = time;
  floor_filter_.start(floor);
  particles_.start(time, site_->site_from_floor(floor, position_m), sigma_m);
}

void ParticleTracker::add(const observation::MotionDelta& motion) {
  const core::FloorId on = floor().value_or(core::FloorId{});
  if (placed_at_ && motion.end <= *placed_at_) return;
  particles_.add(on_site_frame(motion, site_->floor(on)), ground(on));
}

void ParticleTracker::add(const observation::RadioObservation& observation) {
  floor_filter_.add(observation);
  newest_scan_ = HeardScan{observation.delivered, observation.known_share_ratio};
  const observation::FloorHypothesis* hypothesis = find_hypothesis(observation, *floor());
  if (hypothesis == nullptr || hypothesis->raster == nullptr || hypothesis->raster->empty()) return;
  particles_.add(ScanLikelihood{observation.measured, observation.delivered, hypothesis->raster},
                 ground(*floor()));
}

std::optional<core::Belief> ParticleTracker::belief_at(core::DeviceTime time) const {
  if (!particles_.started() || !floor()) return std::nullopt;
  return to_floor_frame(*site_, *floor(), floor_probability(), particles_.at(time));
}

core::FixState ParticleTracker::state_at(core::DeviceTime time, const core::Belief& belief) const {
  return state_of(belief, time, newest_scan_, options_.state);
}

std::optional<core::FloorId> ParticleTracker::floor() const {
  return known_floor_ ? known_floor_ : floor_filter_.most_likely();
}

double ParticleTracker::floor_probability() const {
  if (known_floor_) return 1.0;
  return *std::ranges::max_element(floor_filter_.probabilities());
}

Ground ParticleTracker::ground(core::FloorId floor) const {
  const core::Affine2& site_from_floor = site_->floor(floor).site_from_floor;
  return {site_from_floor.inverse(), site_from_floor,
          terrain_.walkability ? &(*terrain_.walkability)[floor.index] : nullptr,
          terrain_.fields ? &(*terrain_.fields)[floor.index] : nullptr};
}

}  // namespace waylode::fusion
