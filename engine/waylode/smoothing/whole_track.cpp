// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/whole_track.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace waylode::smoothing {

using fusion::PlanarEstimate;

PlanarEstimate interpolate(const std::vector<PlanarEstimate>& nodes, core::DeviceTime time) {
  const auto after = std::ranges::lower_bound(nodes, time, {}, &PlanarEstimate::time);
  if (after == nodes.end()) return nodes.back();
  if (after == nodes.begin()) return nodes.front();
  const auto before = std::prev(after);
  const double span_s = core::to_seconds(after->time - before->time);
  const double share = span_s > 0.0 ? core::to_seconds(time - before->time) / span_s : 1.0;
  PlanarEstimate result = share < 0.5 ? *before : *after;
  result.time = time;
  result.position_m = (1.0 - share) * before->position_m + share * after->position_m;
  return result;
}

WholeTrackSmoother::WholeTrackSmoother(std::shared_ptr<const site::Site> site,
                                       const fusion::FloorFilter::Options& floor,
                                       const fusion::StateRules& state,
                                       std::optional<core::FloorId> known_floor)
    : site_(std::move(site)), floor_(floor), state_(state), known_floor_(known_floor) {}

void WholeTrackSmoother::add(Event event) {
  if (const auto* scan = std::get_if<observation::RadioObservation>(&event)) {
    scans_.push_back({scan->delivered, scan->known_share_ratio});
  }
  events_.push_back(std::move(event));
  solution_.reset();
}

void WholeTrackSmoother::hear_unknown(core::DeviceTime delivered) {
  scans_.push_back({delivered, 0.0});
}

std::optional<core::Belief> WholeTrackSmoother::belief_at(core::DeviceTime time) const {
  const Solution& track = solution();
  if (track.nodes.empty()) return std::nullopt;
  const auto after = std::ranges::lower_bound(track.floors, time, {}, &FloorAt::time);
  const FloorAt& floor = after == track.floors.end() ? track.floors.back() : *after;
  return fusion::to_floor_frame(*site_, floor.floor, floor.probability,
                                interpolate(track.nodes, time));
}

core::FixState WholeTrackSmoother::state_at(core::DeviceTime time,
                                            const core::Belief& belief) const {
  return fusion::state_of(belief, time, fusion::nearest_scan(scans_, time), state_);
}

const WholeTrackSmoother::Solution& WholeTrackSmoother::solution() const {
  if (!solution_) {
    solution_.emplace();
    solution_->floors = smooth_floors(events_, known_floor_, fusion::levels_of(*site_), floor_);
    if (!solution_->floors.empty()) {
      solution_->nodes = smooth_path(events_, solution_->floors);
    }
  }
  return *solution_;
}

}  // namespace waylode::smoothing
