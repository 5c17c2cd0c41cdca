// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/wknn.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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
  FloorHypothesis hypothesis;
  hypothesis.floor = match.floor;
  const std::vector<double> weights = weights_of(match.neighbours, options.weight_exponent);
  double total = 0.0;
  for (const double weight : weights) total += weight;
  hypothesis.position_m.setZero();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const core::Vector2 place = place_of(map.fingerprints[match.neighbours[i].fingerprint]);
    hypothesis.candidates.push_back({place, weights[i] / total});
    hypothesis.position_m += weights[i] / total * place;
  }
  core::Matrix2 scatter_m2 = core::Matrix2::Zero();
  for (const observation::RadioCandidate& candidate : hypothesis.candidates) {
    const core::Vector2 deviation = candidate.position_m - hypothesis.position_m;
    scatter_m2 += candidate.weight * deviation * deviation.transpose();
  }
  hypothesis.covariance_m2 =
      options.base_sigma_m * options.base_sigma_m * core::Matrix2::Identity() +
      options.spread_gain * scatter_m2;
  return hypothesis;
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

  std::map<core::FloorId, double> share;
  double total = 0.0;
  for (const double weight : weights) total += weight;
  for (const FloorMatch& floor : match.floors) share[floor.floor] = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) share[all[i].second] += weights[i] / total;
  // A vote of nobody is not proof: neighbours come in runs of the same walk.
  constexpr double kDoubt = 0.1;
  const double doubt_each = kDoubt / static_cast<double>(share.size());
  for (auto& [floor, value] : share) value = std::log((1.0 - kDoubt) * value + doubt_each);
  return share;
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

std::optional<observation::RadioObservation> WknnEstimator::estimate(
    const Query& query, std::optional<core::FloorId> known_floor) const {
  if (query.readings.size() < options_.min_readings) return std::nullopt;
  const MatchResult match = matcher_->match(query.readings, options_.neighbours, known_floor);
  if (match.floors.empty()) return std::nullopt;
  const std::map<core::FloorId, double> votes = vote_for_floors(match, options_);

  const auto count = static_cast<double>(query.readings.size());
  const double trust = count / (count + options_.few_readings);
  const double floor_trust = count / (count + options_.floor_few_readings);
  observation::RadioObservation result;
  result.measured = query.measured;
  result.delivered = query.delivered;
  result.known_share_ratio = static_cast<double>(match.known_share_ratio);
  for (const FloorMatch& floor : match.floors) {
    result.floors.push_back(locate_on_floor(floor, matcher_->map(), options_));
    result.floors.back().covariance_m2 /= trust;
    result.floors.back().log_likelihood = floor_trust * votes.at(floor.floor);
  }
  std::ranges::stable_sort(result.floors, std::ranges::greater{}, &FloorHypothesis::log_likelihood);
  return result;
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
