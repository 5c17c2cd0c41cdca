// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/wknn.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {
namespace {

using observation::FloorHypothesis;

core::Vector2 place_of(const site::FingerprintRecord& record) {
  return {static_cast<double>(record.x_m), static_cast<double>(record.y_m)};
}

/// (d_nearest / d)^exponent; distances below a thousandth of the typical scale count as equal.
std::vector<double> weights_of(std::span<const Neighbour> neighbours, double exponent) {
  constexpr double kTinyDistance = 1e-3;
  std::vector<double> weights;
  weights.reserve(neighbours.size());
  const double nearest = std::max(kTinyDistance, static_cast<double>(neighbours.front().distance));
  for (const Neighbour& neighbour : neighbours) {
    const double distance = std::max(kTinyDistance, static_cast<double>(neighbour.distance));
    weights.push_back(std::pow(nearest / distance, exponent));
  }
  return weights;
}

FloorHypothesis locate_on_floor(const FloorMatch& match, const site::RadioMap& map,
                                const WknnEstimator::Options& options) {
  const std::vector<double> weights = weights_of(match.neighbours, options.weight_exponent);
  std::vector<observation::RadioCandidate> candidates;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    candidates.push_back({place_of(map.fingerprints[match.neighbours[i].fingerprint]), weights[i]});
  }
  return detail::locate(match.floor, std::move(candidates),
                        {options.base_sigma_m, options.spread_gain});
}

/// Weighted vote of the nearest fingerprints over all floors, as log shares.
std::map<core::FloorId, double> vote_for_floors(const MatchResult& match,
                                                const WknnEstimator::Options& options) {
  std::vector<std::pair<Neighbour, core::FloorId>> all;
  for (const FloorMatch& floor : match.floors) {
    for (const Neighbour& neighbour : floor.neighbours) all.emplace_back(neighbour, floor.floor);
  }
  std::ranges::sort(all, [](const auto& a, const auto& b) {
    return a.first.distance != b.first.distance ? a.first.distance < b.first.distance
                                                : a.first.fingerprint < b.first.fingerprint;
  });
  all.resize(std::min(all.size(), options.floor_neighbours));
  std::vector<Neighbour> voters;
  for (const auto& [neighbour, floor] : all) voters.push_back(neighbour);
  const std::vector<double> weights = weights_of(voters, options.weight_exponent);

  std::vector<core::FloorId> floors;
  for (const FloorMatch& floor : match.floors) floors.push_back(floor.floor);
  std::vector<detail::Vote> votes;
  for (std::size_t i = 0; i < all.size(); ++i) votes.push_back({all[i].second, weights[i]});
  return detail::log_shares(floors, votes);
}

}  // namespace

core::Result<void> WknnEstimator::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "wknn");
  };
  if (neighbours < 1 || neighbours > 200) return refuse("neighbours must be in [1, 200]");
  if (floor_neighbours < 1 || floor_neighbours > neighbours) {
    return refuse("floor_neighbours must be in [1, neighbours]");
  }
  if (!(weight_exponent >= 0.0 && weight_exponent <= 20.0)) {
    return refuse("weight_exponent must be in [0, 20]");
  }
  if (!(base_sigma_m > 0.0 && spread_gain >= 0.0 && few_readings >= 0.0 &&
        floor_few_readings >= 0.0)) {
    return refuse("base_sigma_m must be positive, spread_gain and few_readings not negative");
  }
  if (!(walking_speed_mps >= 0.0 && fresh_for_s >= 0.0)) {
    return refuse("walking_speed_mps and fresh_for_s must not be negative");
  }
  return {};
}

std::optional<Positioning> WknnEstimator::position(const Query& query,
                                                   std::optional<core::FloorId> known_floor) const {
  if (query.readings.size() < options_.min_readings) return std::nullopt;
  const MatchResult match = matcher_->match(query.readings, options_.neighbours, known_floor);
  if (match.floors.empty()) return std::nullopt;
  const std::map<core::FloorId, double> votes = vote_for_floors(match, options_);

  const auto count = static_cast<double>(query.readings.size());
  const double trust = count / (count + options_.few_readings);
  const double floor_trust = count / (count + options_.floor_few_readings);
  Positioning result;
  result.comparisons = match.compared;
  result.observation.measured = query.measured;
  result.observation.delivered = query.delivered;
  result.observation.known_share_ratio = static_cast<double>(match.known_share_ratio);
  std::vector<FloorHypothesis>& floors = result.observation.floors;
  for (const FloorMatch& floor : match.floors) {
    floors.push_back(locate_on_floor(floor, matcher_->map(), options_));
    floors.back().covariance_m2 /= trust;
    floors.back().log_likelihood = floor_trust * votes.at(floor.floor);
  }
  std::ranges::stable_sort(floors, std::ranges::greater{}, &FloorHypothesis::log_likelihood);
  return result;
}

std::optional<observation::RadioObservation> WknnEstimator::estimate(
    const Query& query, std::optional<core::FloorId> known_floor) const {
  std::optional<Positioning> positioning = position(query, known_floor);
  if (!positioning) return std::nullopt;
  return std::move(positioning->observation);
}

bool WknnEstimator::is_foreign(const Query& query) const {
  std::size_t fixed = 0;
  for (const QueryReading& reading : query.readings) {
    if (!matcher_->map().postings_of(reading.transmitter).empty()) return false;
    if (reading.transmitter.kind() != core::TransmitterId::Kind::kBluetooth) ++fixed;
  }
  return fixed > 0 && fixed >= options_.min_readings;
}

core::Matrix2 WknnEstimator::aged(const core::Matrix2& covariance_m2, double age_s) const {
  const double walked_m = options_.walking_speed_mps * std::max(0.0, age_s - options_.fresh_for_s);
  return covariance_m2 + walked_m * walked_m * core::Matrix2::Identity();
}

}  // namespace waylode::radio
