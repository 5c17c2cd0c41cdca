// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/detail/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "waylode/core/assert.hpp"

namespace waylode::radio::detail {
namespace {

struct Nearby {
  double distance_db = 0.0;
  std::uint32_t point = 0;

  auto operator<=>(const Nearby&) const = default;
};

std::vector<Nearby> nearest_of(const ReferenceMap& map, const ReferenceQuery& heard,
                               std::span<const std::uint32_t> points,
                               const NearestOptions& options) {
  std::vector<Nearby> nearby;
  nearby.reserve(points.size());
  for (const std::uint32_t point : points) {
    const double distance_db = map.distance_db(heard, point, options.compared);
    if (std::isfinite(distance_db)) nearby.push_back({distance_db, point});
  }
  const auto kept =
      nearby.begin() + static_cast<std::ptrdiff_t>(std::min(nearby.size(), options.neighbours));
  std::ranges::partial_sort(nearby, kept);
  nearby.erase(kept, nearby.end());
  return nearby;
}

/// [Wu2019] eq. (3), [Zhao2019] eq. (17). Points at no distance leave nothing to the others.
std::vector<double> weights_of(std::span<const Nearby> nearby, bool weighted) {
  constexpr double kTiny_db = 1e-9;
  std::vector<double> weights(nearby.size(), 1.0);
  if (!weighted) return weights;
  const bool exact =
      std::ranges::any_of(nearby, [](const Nearby& n) { return n.distance_db <= kTiny_db; });
  for (std::size_t i = 0; i < nearby.size(); ++i) {
    const double distance_db = nearby[i].distance_db;
    if (exact) {
      weights[i] = distance_db <= kTiny_db ? 1.0 : 0.0;
    } else {
      weights[i] = 1.0 / distance_db;
    }
  }
  return weights;
}

std::vector<Vote> votes_of(const ReferenceMap& map, std::vector<Nearby> nearby,
                           const NearestOptions& options) {
  std::ranges::sort(nearby);
  nearby.resize(std::min(nearby.size(), options.neighbours));
  const std::vector<double> weights = weights_of(nearby, options.weighted);
  std::vector<Vote> votes;
  for (std::size_t i = 0; i < nearby.size(); ++i) {
    votes.push_back({map.points()[nearby[i].point].floor, weights[i]});
  }
  return votes;
}

}  // namespace

observation::FloorHypothesis locate(core::FloorId floor,
                                    std::vector<observation::RadioCandidate> candidates,
                                    const Spread& spread) {
  double total = 0.0;
  for (const observation::RadioCandidate& candidate : candidates) total += candidate.weight;
  WAYLODE_ASSERT(total > 0.0);
  observation::FloorHypothesis hypothesis;
  hypothesis.floor = floor;
  hypothesis.position_m.setZero();
  for (observation::RadioCandidate& candidate : candidates) {
    candidate.weight /= total;
    hypothesis.position_m += candidate.weight * candidate.position_m;  // [Wu2019] eq. (4)
  }
  core::Matrix2 scatter_m2 = core::Matrix2::Zero();
  for (const observation::RadioCandidate& candidate : candidates) {
    const core::Vector2 deviation = candidate.position_m - hypothesis.position_m;
    scatter_m2 += candidate.weight * deviation * deviation.transpose();
  }
  hypothesis.covariance_m2 = spread.base_sigma_m * spread.base_sigma_m * core::Matrix2::Identity() +
                             spread.gain * scatter_m2;
  hypothesis.candidates = std::move(candidates);
  return hypothesis;
}

std::map<core::FloorId, double> log_shares(std::span<const core::FloorId> floors,
                                           std::span<const Vote> votes) {
  std::map<core::FloorId, double> share;
  double total = 0.0;
  for (const Vote& vote : votes) total += vote.weight;
  for (const core::FloorId floor : floors) share[floor] = 0.0;
  for (const Vote& vote : votes) share[vote.floor] += vote.weight / total;
  // A vote of nobody is not proof: neighbours come in runs of the same walk.
  constexpr double kDoubt = 0.1;
  const double doubt_each = kDoubt / static_cast<double>(share.size());
  for (auto& [floor, value] : share) value = std::log((1.0 - kDoubt) * value + doubt_each);
  return share;
}

std::optional<Positioning> position_by_nearest(const ReferenceMap& map, const Query& query,
                                               const ReferenceQuery& heard,
                                               std::span<const FloorCandidates> candidates,
                                               const NearestOptions& options) {
  Positioning result;
  result.observation.measured = query.measured;
  result.observation.delivered = query.delivered;
  result.observation.known_share_ratio = heard.known_share_ratio;
  std::vector<Nearby> all;
  std::vector<core::FloorId> floors;
  for (const FloorCandidates& floor : candidates) {
    result.comparisons += floor.points.size();
    const std::vector<Nearby> nearby = nearest_of(map, heard, floor.points, options);
    if (nearby.empty()) continue;
    const std::vector<double> weights = weights_of(nearby, options.weighted);
    std::vector<observation::RadioCandidate> places;
    for (std::size_t i = 0; i < nearby.size(); ++i) {
      places.push_back({map.points()[nearby[i].point].position_m, weights[i]});
    }
    result.observation.floors.push_back(locate(floor.floor, std::move(places), options.spread));
    floors.push_back(floor.floor);
    all.insert(all.end(), nearby.begin(), nearby.end());
  }
  if (floors.empty()) return std::nullopt;

  const std::map<core::FloorId, double> shares =
      log_shares(floors, votes_of(map, std::move(all), options));
  for (observation::FloorHypothesis& floor : result.observation.floors) {
    floor.log_likelihood = shares.at(floor.floor);
  }
  std::ranges::stable_sort(result.observation.floors, std::ranges::greater{},
                           &observation::FloorHypothesis::log_likelihood);
  return result;
}

std::vector<FloorCandidates> all_points(const ReferenceMap& map,
                                        std::optional<core::FloorId> only_floor) {
  std::vector<FloorCandidates> candidates;
  for (const ReferenceMap::FloorRange& range : map.floors()) {
    if (only_floor && range.floor != *only_floor) continue;
    FloorCandidates floor{range.floor, {}};
    for (std::uint32_t point = range.first; point < range.last; ++point) {
      floor.points.push_back(point);
    }
    candidates.push_back(std::move(floor));
  }
  return candidates;
}

std::vector<ReferenceQuery::Heard> by_strength(const ReferenceMap& map,
                                               const ReferenceQuery& heard) {
  std::vector<ReferenceQuery::Heard> ranked = heard.heard;
  const auto is_bluetooth = [&](const ReferenceQuery::Heard& h) {
    return map.transmitters()[h.transmitter].kind() == core::TransmitterId::Kind::kBluetooth;
  };
  std::ranges::stable_sort(ranked, {}, [&](const ReferenceQuery::Heard& h) {
    return std::pair(is_bluetooth(h), -h.excess_db);
  });
  return ranked;
}

core::Result<void> validate_nearest(std::size_t neighbours, double base_sigma_m, double spread_gain,
                                    const char* place) {
  constexpr double kHuge_m = 1e3;
  if (neighbours < 1 || neighbours > 1000) {
    return core::fail(core::ErrorCode::kInvalidOptions, "neighbours must be in [1, 1000]", place);
  }
  if (!(base_sigma_m > 0.0 && base_sigma_m <= kHuge_m && spread_gain >= 0.0 &&
        spread_gain <= kHuge_m)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "base_sigma_m must be in (0, 1000] and spread_gain in [0, 1000]", place);
  }
  return {};
}

}  // namespace waylode::radio::detail
