// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/place_likelihood.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace waylode::radio {

core::Result<void> PlaceLikelihood::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "place_likelihood");
  };
  if (candidates < 1 || candidates > 500) return refuse("candidates must be in [1, 500]");
  if (!(distance_scale > 0.0 && candidate_sigma_m > 0.0)) {
    return refuse("distance_scale and candidate_sigma_m must be positive");
  }
  if (!(elsewhere_share > 0.0 && elsewhere_share < 1.0)) {
    return refuse("elsewhere_share must be in (0, 1)");
  }
  if (!(candidates_weight >= 0.0 && signal_weight >= 0.0 &&
        candidates_weight + signal_weight > 0.0 && floor_window >= 0.0)) {
    return refuse("the weights must not be negative and not both 0");
  }
  return signal.validate();
}

core::Result<PlaceLikelihood> PlaceLikelihood::create(const Matcher& matcher,
                                                      const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  auto field = SignalField::create(matcher.map(), options.signal);
  if (!field) return tl::unexpected(field.error());
  return PlaceLikelihood(matcher, options, *std::move(field));
}

void PlaceLikelihood::add_rasters(const Query& query,
                                  observation::RadioObservation& observation) const {
  if (observation.floors.empty()) return;
  const double least = observation.floors.front().log_likelihood - options_.floor_window;
  for (observation::FloorHypothesis& hypothesis : observation.floors) {
    if (hypothesis.log_likelihood >= least) hypothesis.raster = raster(query, hypothesis.floor);
  }
}

std::vector<ResponseResidual> PlaceLikelihood::residuals(const Query& query, core::FloorId floor,
                                                         const core::Vector2& position_m) const {
  constexpr float kFresh_s = 3.0F;
  constexpr double kMostlyHeard = 0.5;  // The rarely heard are heard when they happen to be loud.
  constexpr double kPlaceSigma_db = 3.0;
  std::vector<ResponseResidual> residuals;
  for (const QueryReading& reading : query.readings) {
    if (!(reading.age_s < kFresh_s)) continue;
    const auto expected = field_.expected(reading.transmitter, floor, position_m);
    if (!expected || expected->heard_ratio < kMostlyHeard) continue;
    residuals.push_back({static_cast<double>(reading.rssi_dbm), expected->mean_dbm,
                         std::hypot(expected->sigma_db, kPlaceSigma_db)});
  }
  return residuals;
}

std::shared_ptr<const observation::LikelihoodRaster> PlaceLikelihood::raster(
    const Query& query, core::FloorId floor) const {
  const auto geometry = field_.geometry(floor);
  if (!geometry) return nullptr;
  const observation::LikelihoodRaster of_matches = matched(query, floor, *geometry);
  const observation::LikelihoodRaster of_signals = options_.signal_weight > 0.0
                                                       ? field_.likelihood(query, floor)
                                                       : observation::LikelihoodRaster{};
  auto both = std::make_shared<observation::LikelihoodRaster>(
      combine(of_matches, options_.candidates_weight, of_signals, options_.signal_weight));
  return both->empty() ? nullptr : both;
}

observation::LikelihoodRaster PlaceLikelihood::matched(const Query& query, core::FloorId floor,
                                                       const RasterGeometry& geometry) const {
  const MatchResult match = matcher_->match(query.readings, options_.candidates, floor);
  if (match.floors.empty()) return {};
  const std::vector<Neighbour>& neighbours = match.floors.front().neighbours;
  std::vector<observation::RadioCandidate> candidates;
  double total = 0.0;
  for (const Neighbour& neighbour : neighbours) {
    const site::FingerprintRecord& record = matcher_->map().fingerprints[neighbour.fingerprint];
    const double behind =
        static_cast<double>(neighbour.distance) - static_cast<double>(neighbours[0].distance);
    candidates.push_back({{static_cast<double>(record.x_m), static_cast<double>(record.y_m)},
                          std::exp(-behind / options_.distance_scale)});
    total += candidates.back().weight;
  }
  // A Gaussian kernel of height 1 covers 2 pi sigma^2.
  const double kernel_nodes = 2.0 * std::numbers::pi * std::pow(options_.candidate_sigma_m, 2) /
                              std::pow(geometry.node_m, 2);
  const double share = options_.elsewhere_share / (1.0 - options_.elsewhere_share);
  const double elsewhere = share * total * kernel_nodes / static_cast<double>(geometry.nodes());
  return rasterise(candidates, {options_.candidate_sigma_m, elsewhere}, geometry);
}

}  // namespace waylode::radio
