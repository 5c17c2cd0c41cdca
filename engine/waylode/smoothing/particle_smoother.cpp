// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/particle_smoother.hpp"

#include <algorithm>
#include <iterator>

#include "waylode/smoothing/genealogy.hpp"

namespace waylode::smoothing {
namespace {

using fusion::PlanarEstimate;
using observation::MotionDelta;
using observation::RadioObservation;

core::DeviceTime time_of(const Event& event) {
  if (const auto* motion = std::get_if<MotionDelta>(&event)) return motion->end;
  if (const auto* climb = std::get_if<observation::VerticalMotion>(&event)) return climb->end;
  return std::get<RadioObservation>(event).delivered;
}

}  // namespace

core::Result<void> ParticleSmoother::Options::validate() const {
  if (particles < 50 || particles > 1000000 || !(horizon_s > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need 50 to 1000000 particles and a horizon above 0", "smoothing");
  }
  return tracker.validate();
}

ParticleSmoother::ParticleSmoother(std::shared_ptr<const site::Site> site, fusion::Terrain terrain,
                                   const Options& options, std::optional<core::FloorId> known_floor)
    : WholeTrackSmoother(std::move(site), options.tracker.floor, options.tracker.state,
                         known_floor),
      terrain_(std::move(terrain)),
      options_(options) {
  options_.tracker.particles.particles = options_.particles;
}

std::vector<PlanarEstimate> ParticleSmoother::smooth_path(
    const std::vector<Event>& events, const std::vector<FloorAt>& floors) const {
  fusion::ParticleTracker tracker(site(), terrain_, options_.tracker, floors.front().floor,
                                  /*keep_history=*/true);
  for (const Event& event : events) {
    const auto next = std::ranges::lower_bound(floors, time_of(event), {}, &FloorAt::time);
    tracker.tell_floor(next == floors.end() ? floors.back().floor : next->floor);
    std::visit([&tracker](const auto& value) { tracker.add(value); }, event);
  }
  return trace_back(tracker.particles().history(), core::from_seconds(options_.horizon_s),
                    options_.tracker.particles.base_sigma_m,
                    options_.tracker.particles.sigma_scale);
}

FixedLagParticles::FixedLagParticles(std::shared_ptr<const site::Site> site,
                                     fusion::Terrain terrain,
                                     const fusion::ParticleTracker::Options& options,
                                     std::optional<core::FloorId> known_floor, core::Duration lag)
    : site_(site),
      tracker_(std::move(site), std::move(terrain), options, known_floor,
               /*keep_history=*/true),
      options_(options),
      lag_(lag) {}

void FixedLagParticles::add(const Event& event) {
  std::visit([this](const auto& value) { tracker_.add(value); }, event);
  if (const auto* scan = std::get_if<RadioObservation>(&event)) {
    keep({scan->delivered, scan->known_share_ratio});
  }
  constexpr core::Duration kMargin = std::chrono::seconds(5);
  tracker_.forget_before(time_of(event) - lag_ - kMargin);
}

void FixedLagParticles::hear_unknown(core::DeviceTime delivered) { keep({delivered, 0.0}); }

void FixedLagParticles::keep(const fusion::HeardScan& scan) {
  const auto needed =
      std::ranges::lower_bound(scans_, scan.delivered - lag_, {}, &fusion::HeardScan::delivered);
  if (needed != scans_.begin()) scans_.erase(scans_.begin(), std::prev(needed));
  scans_.push_back(scan);
}

core::FixState FixedLagParticles::state_at(core::DeviceTime time,
                                           const core::Belief& belief) const {
  return fusion::state_of(belief, time, fusion::nearest_scan(scans_, time), options_.state);
}

std::optional<core::Belief> FixedLagParticles::belief_at(core::DeviceTime time) const {
  const auto& history = tracker_.particles().history();
  if (history.empty() || time >= history.back().time) return tracker_.belief_at(time);
  const auto nodes = trace_back(history, core::Duration::max(), options_.particles.base_sigma_m,
                                options_.particles.sigma_scale);
  return fusion::to_floor_frame(*site_, *tracker_.floor(), tracker_.floor_probability(),
                                interpolate(nodes, time));
}

}  // namespace waylode::smoothing
