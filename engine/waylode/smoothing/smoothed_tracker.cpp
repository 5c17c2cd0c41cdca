// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/smoothed_tracker.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
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

using Fits = std::vector<std::vector<double>>;

/// A scan's votes, and the climbs between the scan before and it, by floor from and floor to.
struct ChainLink {
  std::vector<double> log_likelihoods;
  std::vector<Fits> climbs;
};

Fits transposed(const Fits& fits) {
  Fits result = fits;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    for (std::size_t j = 0; j < fits.size(); ++j) result[i][j] = fits[j][i];
  }
  return result;
}

/// Forward-backward over the chain of floors: the posterior of each scan given all of them.
std::vector<std::vector<double>> smooth_chain(const std::vector<ChainLink>& links,
                                              double change_probability) {
  const std::size_t count = links.front().log_likelihoods.size();
  const std::vector<double> uniform(count, 1.0 / static_cast<double>(count));
  std::vector<std::vector<double>> posterior;
  for (const ChainLink& link : links) {
    std::vector<double> before = posterior.empty() ? uniform : posterior.back();
    for (const Fits& fits : link.climbs) before = fusion::climb_floor_chain(before, fits);
    posterior.push_back(
        fusion::advance_floor_chain(before, link.log_likelihoods, change_probability));
  }
  std::vector<double> future = uniform;  // Likelihood of what is still to come, per floor.
  for (std::size_t i = links.size(); i-- > 0;) {
    double total = 0.0;
    for (std::size_t floor = 0; floor < count; ++floor) {
      posterior[i][floor] *= future[floor];
      total += posterior[i][floor];
    }
    for (double& value : posterior[i]) value /= total;
    const std::vector<double> with_scan =
        fusion::advance_floor_chain(future, links[i].log_likelihoods, 0.0);
    // The chain is symmetric, so the step back is the step forward without a vote.
    future =
        fusion::advance_floor_chain(with_scan, std::vector<double>(count, 0.0), change_probability);
    for (const Fits& fits : std::views::reverse(links[i].climbs)) {
      future = fusion::climb_floor_chain(future, transposed(fits));
    }
  }
  return posterior;
}

/// The newest report of each climb, where its first one came.
std::vector<std::pair<std::size_t, VerticalMotion>> climbs_of(const std::vector<Event>& events) {
  std::vector<std::pair<std::size_t, VerticalMotion>> climbs;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto* climb = std::get_if<VerticalMotion>(&events[i]);
    if (climb == nullptr) continue;
    if (climbs.empty() || climbs.back().second.begin != climb->begin) {
      climbs.emplace_back(i, *climb);
    } else {
      climbs.back().second = *climb;
    }
  }
  return climbs;
}

std::vector<ChainLink> links_of(const std::vector<Event>& events, const std::vector<int>& levels,
                                const fusion::FloorFilter::Options& options) {
  const auto climbs = climbs_of(events);
  auto next = climbs.begin();
  std::vector<ChainLink> links;
  ChainLink link;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (next != climbs.end() && next->first == i) {
      // Before the first scan a climb tells nothing: all floors are alike.
      if (!links.empty()) link.climbs.push_back(fusion::climb_fits(levels, next->second, options));
      ++next;
    }
    const auto* scan = std::get_if<RadioObservation>(&events[i]);
    if (scan == nullptr) continue;
    link.log_likelihoods =
        fusion::FloorFilter::weighted_log_likelihoods(*scan, levels.size(), options);
    links.push_back(std::exchange(link, {}));
  }
  return links;
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

std::vector<FloorAt> smooth_floors(const std::vector<Event>& events,
                                   std::optional<core::FloorId> known_floor,
                                   const std::vector<int>& levels,
                                   const fusion::FloorFilter::Options& options) {
  std::vector<FloorAt> floors;
  for (const Event& event : events) {
    const auto* scan = std::get_if<RadioObservation>(&event);
    if (scan == nullptr) continue;
    floors.push_back({scan->delivered, known_floor.value_or(core::FloorId{}), 1.0});
  }
  if (known_floor || floors.empty()) return floors;
  const auto posterior =
      smooth_chain(links_of(events, levels, options), options.change_probability);
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const auto best = std::ranges::max_element(posterior[i]);
    floors[i].floor = {static_cast<std::uint16_t>(best - posterior[i].begin())};
    floors[i].probability = *best;
  }
  return floors;
}

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
    solution_->floors =
        smooth_floors(events_, known_floor_, fusion::levels_of(*site_), options_.fused.floor);
    if (!solution_->floors.empty()) solution_->nodes = smooth_path(solution_->floors);
  }
  return *solution_;
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
      if (std::holds_alternative<VerticalMotion>(event)) continue;
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

}  // namespace waylode::smoothing
