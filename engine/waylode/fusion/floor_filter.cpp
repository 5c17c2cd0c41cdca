// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/floor_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace waylode::fusion {
namespace {

std::vector<int> ranks(std::size_t count) {
  std::vector<int> result(count);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

}  // namespace

core::Result<void> FloorFilter::Options::validate() const {
  if (!(change_probability > 0.0 && change_probability < 1.0 && vote_weight > 0.0 &&
        storey_m > 0.0 && storey_sigma_m > 0.0 && false_climb_ratio > 0.0 &&
        false_climb_ratio <= 1.0)) {
    return core::fail(
        core::ErrorCode::kInvalidOptions,
        "change_probability must be in (0, 1), false_climb_ratio in (0, 1], vote_weight, "
        "storey_m, storey_sigma_m positive",
        "floor_filter");
  }
  return {};
}

FloorFilter::FloorFilter(const Options& options, std::size_t floor_count)
    : FloorFilter(options, ranks(floor_count)) {}

FloorFilter::FloorFilter(const Options& options, std::vector<int> levels)
    : options_(options),
      levels_(std::move(levels)),
      probabilities_(levels_.size(), 1.0 / static_cast<double>(levels_.size())) {}

void FloorFilter::start(core::FloorId floor) {
  constexpr double kBelieved = 0.9;
  const auto count = static_cast<double>(probabilities_.size());
  std::ranges::fill(probabilities_, (1.0 - kBelieved) / count);
  probabilities_[floor.index] += kBelieved;
  voted_ = true;
}

void FloorFilter::add(const observation::RadioObservation& observation) {
  probabilities_ = advance_floor_chain(
      probabilities_, weighted_log_likelihoods(observation, probabilities_.size(), options_),
      voted_ ? options_.change_probability : 0.0);
  voted_ = true;
}

void FloorFilter::add(const observation::VerticalMotion& motion) {
  if (!voted_ || !std::isfinite(motion.climb_m) || !(motion.sigma_m > 0.0) ||
      !std::isfinite(motion.sigma_m)) {
    return;
  }
  if (climb_begin_ != motion.begin) {
    climb_begin_ = motion.begin;
    before_climb_ = probabilities_;
  }
  // Scans heard since the first report told where the person was, not where the climb has led.
  probabilities_ = climb_floor_chain(before_climb_, climb_fits(levels_, motion, options_));
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

std::vector<std::vector<double>> climb_fits(const std::vector<int>& levels,
                                            const observation::VerticalMotion& motion,
                                            const FloorFilter::Options& options) {
  const auto fit = [&](double storeys) {
    const double variance_m2 = motion.sigma_m * motion.sigma_m +
                               std::abs(storeys) * options.storey_sigma_m * options.storey_sigma_m;
    const double miss_m = motion.climb_m - storeys * options.storey_m;
    return std::exp(-0.5 * miss_m * miss_m / variance_m2) / std::sqrt(variance_m2);
  };
  // Relative to the level difference that fits best on any building, so that a climb off the
  // floors surveyed leaves but the false climb.
  const double nearest = std::round(motion.climb_m / options.storey_m);
  const double best = std::max(fit(nearest), std::numeric_limits<double>::min());
  std::vector<std::vector<double>> fits(levels.size(), std::vector<double>(levels.size()));
  for (std::size_t from = 0; from < levels.size(); ++from) {
    for (std::size_t to = 0; to < levels.size(); ++to) {
      const double stays = to == from ? options.false_climb_ratio : 0.0;
      fits[from][to] =
          stays + (1.0 - options.false_climb_ratio) * fit(levels[to] - levels[from]) / best;
    }
  }
  return fits;
}

std::vector<double> climb_floor_chain(const std::vector<double>& probabilities,
                                      const std::vector<std::vector<double>>& fits) {
  std::vector<double> result(probabilities.size(), 0.0);
  double total = 0.0;
  for (std::size_t to = 0; to < result.size(); ++to) {
    for (std::size_t from = 0; from < result.size(); ++from) {
      result[to] += probabilities[from] * fits[from][to];
    }
    total += result[to];
  }
  for (double& value : result) value /= total;
  return result;
}

}  // namespace waylode::fusion
