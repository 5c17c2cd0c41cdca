// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/floor_filter.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::fusion {

core::Result<void> FloorFilter::Options::validate() const {
  if (!(change_probability > 0.0 && change_probability < 1.0 && vote_weight > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "change_probability must be in (0, 1), vote_weight positive", "floor_filter");
  }
  return {};
}

FloorFilter::FloorFilter(const Options& options, std::size_t floor_count)
    : options_(options), probabilities_(floor_count, 1.0 / static_cast<double>(floor_count)) {}

void FloorFilter::add(const observation::RadioObservation& observation) {
  probabilities_ = advance_floor_chain(
      probabilities_, weighted_log_likelihoods(observation, probabilities_.size(), options_),
      voted_ ? options_.change_probability : 0.0);
  voted_ = true;
}

std::optional<core::FloorId> FloorFilter::most_likely() const {
  if (!voted_) return std::nullopt;
  const auto best = std::ranges::max_element(probabilities_);
  return core::FloorId{static_cast<std::uint16_t>(best - probabilities_.begin())};
}

std::vector<double> FloorFilter::weighted_log_likelihoods(
    const observation::RadioObservation& observation, std::size_t floor_count,
    const Options& options) {
  // A floor on which nothing heard is known is no likelier than the worst that is, nor than a tenth
  // of the best: else a scan that knows one floor alone would not tell it from the others.
  const double unknown = std::min(observation.floors.back().log_likelihood,
                                  observation.floors.front().log_likelihood - std::log(10.0));
  std::vector<double> result(floor_count, options.vote_weight * unknown);
  for (const observation::FloorHypothesis& hypothesis : observation.floors) {
    result[hypothesis.floor.index] = options.vote_weight * hypothesis.log_likelihood;
  }
  return result;
}

std::vector<double> advance_floor_chain(const std::vector<double>& probabilities,
                                        const std::vector<double>& log_likelihoods,
                                        double change_probability) {
  const auto count = static_cast<double>(probabilities.size());
  const double best = *std::ranges::max_element(log_likelihoods);
  std::vector<double> result(probabilities.size());
  double total = 0.0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double prior = (1.0 - change_probability) * probabilities[i] + change_probability / count;
    result[i] = prior * std::exp(log_likelihoods[i] - best);
    total += result[i];
  }
  for (double& value : result) value /= total;
  return result;
}

}  // namespace waylode::fusion
