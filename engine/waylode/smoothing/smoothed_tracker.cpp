// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/smoothed_tracker.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "waylode/smoothing/rts_smoother.hpp"

namespace waylode::smoothing {
namespace {

using observation::MotionDelta;
using observation::RadioObservation;
using observation::VerticalMotion;

core::DeviceTime time_of(const Event& event) {
  if (const auto* motion = std::get_if<MotionDelta>(&event)) return motion->begin;
  if (const auto* climb = std::get_if<VerticalMotion>(&event)) return climb->end;
  return std::get<RadioObservation>(event).delivered;
}

/// Where the first scan that knows its floor puts the phone, site frame.
std::optional<core::Vector2> first_position(const site::Site& site,
                                            const std::vector<Event>& events,
                                            std::span<const core::FloorId> floors) {
  std::size_t scan_index = 0;
  for (const Event& event : events) {
    const auto* scan = std::get_if<RadioObservation>(&event);
    if (scan == nullptr) continue;
    const auto* hypothesis = fusion::find_hypothesis(*scan, floors[scan_index++]);
    if (hypothesis != nullptr) {
      return site.site_from_floor(hypothesis->floor, hypothesis->position_m);
    }
  }
  return std::nullopt;
}

}  // namespace

core::Result<void> TrackSmoother::Options::validate() const {
  if (rounds < 1 || rounds > 50) {
    return core::fail(core::ErrorCode::kInvalidOptions, "rounds must be in [1, 50]", "smoothing");
  }
  return fused.validate();
}

TrackSmoother::TrackSmoother(std::shared_ptr<const site::Site> site, const Options& options,
                             std::optional<core::FloorId> known_floor)
    : WholeTrackSmoother(std::move(site), options.fused.floor, options.fused.state, known_floor),
      options_(options) {}

std::vector<fusion::PlanarEstimate> TrackSmoother::smooth_path(
    const std::vector<Event>& events, const std::vector<FloorAt>& floors) const {
  std::vector<core::FloorId> floor_ids;
  for (const FloorAt& floor : floors) floor_ids.push_back(floor.floor);
  const std::optional<core::Vector2> start_m = first_position(*site(), events, floor_ids);
  if (!start_m) return {};
  std::vector<std::optional<double>> weights(floors.size());
  std::vector<fusion::PlanarState> nodes;
  for (int round = 0; round < options_.rounds; ++round) {
    fusion::PlanarTracker tracker(options_.fused.planar, /*keep_history=*/true);
    tracker.start(time_of(events.front()), *start_m, options_.fused.planar.start_sigma_m);
    std::vector<std::size_t> recorded;  // Which scan each of the tracker's records is.
    std::size_t scan_index = 0;
    for (const Event& event : events) {
      const site::Floor& floor =
          site()->floor(floors[std::min(scan_index, floors.size() - 1)].floor);
      if (const auto* motion = std::get_if<MotionDelta>(&event)) {
        tracker.add(fusion::on_site_frame(*motion, floor));
        continue;
      }
      if (std::holds_alternative<VerticalMotion>(event)) continue;
      const auto& scan = std::get<RadioObservation>(event);
      const auto* hypothesis = fusion::find_hypothesis(scan, floors[scan_index].floor);
      if (hypothesis != nullptr) {
        tracker.add(fusion::to_site_frame(*site(), scan, *hypothesis), weights[scan_index]);
        recorded.push_back(scan_index);
      }
      ++scan_index;
    }
    nodes = smooth_backward(tracker.history(), tracker.state());
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      const fusion::PlanarRecord& record = tracker.records()[i];
      const fusion::PlanarState& node = nodes[record.node];
      weights[recorded[i]] = fusion::measurement_weight(
          record, node.mean, node.covariance, options_.fused.planar.radio_sigma_scale,
          options_.fused.planar.radio_degrees_of_freedom);
    }
  }
  std::vector<fusion::PlanarEstimate> path;
  path.reserve(nodes.size());
  for (const fusion::PlanarState& node : nodes) {
    path.push_back({node.time, node.position_m(), node.position_covariance_m2()});
  }
  return path;
}

}  // namespace waylode::smoothing
