// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/smoothed_tracker.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include "waylode/smoothing/rts_smoother.hpp"

namespace waylode::smoothing {
namespace {

using observation::MotionDelta;
using observation::RadioObservation;

core::DeviceTime time_of(const Event& event) {
  if (const auto* motion = std::get_if<MotionDelta>(&event)) return motion->begin;
  return std::get<RadioObservation>(event).delivered;
}

/// Forward-backward over the chain of floors: the posterior of each scan given all of them.
std::vector<std::vector<double>> smooth_chain(
    const std::vector<std::vector<double>>& log_likelihoods, double change_probability) {
  const std::size_t count = log_likelihoods.front().size();
  const std::vector<double> uniform(count, 1.0 / static_cast<double>(count));
  std::vector<std::vector<double>> posterior;
  for (const auto& scan : log_likelihoods) {
    posterior.push_back(fusion::advance_floor_chain(posterior.empty() ? uniform : posterior.back(),
                                                    scan, change_probability));
  }
  std::vector<double> future = uniform;  // Likelihood of the scans still to come, per floor.
  for (std::size_t i = log_likelihoods.size(); i-- > 0;) {
    double total = 0.0;
    for (std::size_t floor = 0; floor < count; ++floor) {
      posterior[i][floor] *= future[floor];
      total += posterior[i][floor];
    }
    for (double& value : posterior[i]) value /= total;
    const std::vector<double> with_scan =
        fusion::advance_floor_chain(future, log_likelihoods[i], 0.0);
    // The chain is symmetric, so the step back is the step forward without a vote.
    future =
        fusion::advance_floor_chain(with_scan, std::vector<double>(count, 0.0), change_probability);
  }
  return posterior;
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
    : site_(std::move(site)), options_(options), known_floor_(known_floor) {}

void TrackSmoother::add(Event event) {
  if (const auto* scan = std::get_if<RadioObservation>(&event)) {
    scans_.push_back({scan->delivered, scan->known_share_ratio});
  }
  events_.push_back(std::move(event));
  solution_.reset();
}

void TrackSmoother::hear_unknown(core::DeviceTime delivered) { scans_.push_back({delivered, 0.0}); }

std::optional<core::Belief> TrackSmoother::belief_at(core::DeviceTime time) const {
  const Solution& track = solution();
  if (track.nodes.empty()) return std::nullopt;
  const auto after = std::ranges::lower_bound(track.floors, time, {}, &FloorAt::time);
  const FloorAt& floor = after == track.floors.end() ? track.floors.back() : *after;
  return fusion::to_floor_frame(*site_, floor.floor, floor.probability,
                                interpolate(track.nodes, time));
}

core::FixState TrackSmoother::state_at(core::DeviceTime time, const core::Belief& belief) const {
  return fusion::state_of(belief, time, fusion::nearest_scan(scans_, time), options_.fused.state);
}

const TrackSmoother::Solution& TrackSmoother::solution() const {
  if (!solution_) {
    solution_.emplace();
    solution_->floors = smooth_floors();
    if (!solution_->floors.empty()) solution_->nodes = smooth_path(solution_->floors);
  }
  return *solution_;
}

std::vector<TrackSmoother::FloorAt> TrackSmoother::smooth_floors() const {
  std::vector<FloorAt> floors;
  std::vector<std::vector<double>> log_likelihoods;
  for (const Event& event : events_) {
    const auto* scan = std::get_if<RadioObservation>(&event);
    if (scan == nullptr) continue;
    floors.push_back({scan->delivered, known_floor_.value_or(core::FloorId{}), 1.0});
    log_likelihoods.push_back(fusion::FloorFilter::weighted_log_likelihoods(
        *scan, site_->floors().size(), options_.fused.floor));
  }
  if (known_floor_ || floors.empty()) return floors;
  const auto posterior = smooth_chain(log_likelihoods, options_.fused.floor.change_probability);
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const auto best = std::ranges::max_element(posterior[i]);
    floors[i].floor = {static_cast<std::uint16_t>(best - posterior[i].begin())};
    floors[i].probability = *best;
  }
  return floors;
}

std::vector<fusion::PlanarState> TrackSmoother::smooth_path(
    const std::vector<FloorAt>& floors) const {
  std::vector<core::FloorId> floor_ids;
  for (const FloorAt& floor : floors) floor_ids.push_back(floor.floor);
  const std::optional<core::Vector2> start_m = first_position(*site_, events_, floor_ids);
  if (!start_m) return {};
  std::vector<std::optional<double>> weights(floors.size());
  std::vector<fusion::PlanarState> nodes;
  for (int round = 0; round < options_.rounds; ++round) {
    fusion::PlanarTracker tracker(options_.fused.planar, /*keep_history=*/true);
    tracker.start(time_of(events_.front()), *start_m, options_.fused.planar.start_sigma_m);
    std::vector<std::size_t> recorded;  // Which scan each of the tracker's records is.
    std::size_t scan_index = 0;
    for (const Event& event : events_) {
      const site::Floor& floor =
          site_->floor(floors[std::min(scan_index, floors.size() - 1)].floor);
      if (const auto* motion = std::get_if<MotionDelta>(&event)) {
        tracker.add(fusion::on_site_frame(*motion, floor));
        continue;
      }
      const auto& scan = std::get<RadioObservation>(event);
      const auto* hypothesis = fusion::find_hypothesis(scan, floors[scan_index].floor);
      if (hypothesis != nullptr) {
        tracker.add(fusion::to_site_frame(*site_, scan, *hypothesis), weights[scan_index]);
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
  return nodes;
}

FixedLagTracker::FixedLagTracker(std::shared_ptr<const site::Site> site,
                                 const fusion::FusedTracker::Options& options,
                                 std::optional<core::FloorId> known_floor, core::Duration lag)
    : site_(site),
      tracker_(std::move(site), options, known_floor, /*keep_history=*/true),
      lag_(lag),
      rules_(options.state) {}

void FixedLagTracker::add(const Event& event) {
  std::visit([this](const auto& value) { tracker_.add(value); }, event);
  if (const auto* scan = std::get_if<RadioObservation>(&event)) {
    keep({scan->delivered, scan->known_share_ratio});
  }
  constexpr core::Duration kMargin = std::chrono::seconds(5);
  tracker_.planar().forget_before(tracker_.planar().state().time - lag_ - kMargin);
}

void FixedLagTracker::hear_unknown(core::DeviceTime delivered) { keep({delivered, 0.0}); }

void FixedLagTracker::keep(const fusion::HeardScan& scan) {
  const auto needed =
      std::ranges::lower_bound(scans_, scan.delivered - lag_, {}, &fusion::HeardScan::delivered);
  if (needed != scans_.begin()) scans_.erase(scans_.begin(), std::prev(needed));
  scans_.push_back(scan);
}

core::FixState FixedLagTracker::state_at(core::DeviceTime time, const core::Belief& belief) const {
  return fusion::state_of(belief, time, fusion::nearest_scan(scans_, time), rules_);
}

std::optional<core::Belief> FixedLagTracker::belief_at(core::DeviceTime time) const {
  const fusion::PlanarTracker& planar = tracker_.planar();
  if (!planar.started() || time >= planar.state().time) return tracker_.belief_at(time);
  const auto nodes = smooth_backward(planar.history(), planar.state());
  return fusion::to_floor_frame(*site_, *tracker_.floor(), tracker_.floor_probability(),
                                interpolate(nodes, time));
}

}  // namespace waylode::smoothing
