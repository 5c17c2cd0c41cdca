// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "waylode/core/assert.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::experiment {
namespace {

constexpr std::size_t kDraws = 1000;
constexpr std::uint64_t kSeed = 95;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// All values of the chosen units of each method, one after the other.
std::vector<std::vector<double>> gather(std::span<const std::vector<Unit>> methods,
                                        std::span<const std::size_t> chosen) {
  std::vector<std::vector<double>> values(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m) {
    for (const std::size_t unit : chosen) {
      values[m].insert(values[m].end(), methods[m][unit].begin(), methods[m][unit].end());
    }
  }
  return values;
}

}  // namespace

Interval bootstrap(std::span<const std::vector<Unit>> methods, const JointStatistic& statistic) {
  WAYLODE_ASSERT(!methods.empty());
  const std::size_t count = methods.front().size();
  for (const std::vector<Unit>& units : methods) WAYLODE_ASSERT(units.size() == count);
  if (count == 0) return {kNaN, kNaN, kNaN, 0};
  std::vector<std::size_t> chosen(count);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  const double value = statistic(gather(methods, chosen));
  core::Rng rng(kSeed);
  std::vector<double> draws;
  draws.reserve(kDraws);
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    for (std::size_t& unit : chosen) unit = static_cast<std::size_t>(rng.below(count));
    const double drawn = statistic(gather(methods, chosen));
    if (std::isfinite(drawn)) draws.push_back(drawn);
  }
  return {value, quantile_of(draws, 0.025), quantile_of(draws, 0.975), count};
}

Interval bootstrap(std::span<const Unit> units, const Statistic& statistic) {
  const std::vector<std::vector<Unit>> methods = {{units.begin(), units.end()}};
  return bootstrap(methods, [&](std::span<const std::vector<double>> values) {
    return statistic(values.front());
  });
}

double mean_of(std::span<const double> values) {
  if (values.empty()) return kNaN;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile_of(std::span<const double> values, double q) {
  if (values.empty()) return kNaN;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double rank = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(rank));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double percent_within(std::span<const double> values, double limit) {
  if (values.empty()) return kNaN;
  const auto within =
      std::count_if(values.begin(), values.end(), [limit](double value) { return value <= limit; });
  return 100.0 * static_cast<double>(within) / static_cast<double>(values.size());
}

}  // namespace waylode::experiment
