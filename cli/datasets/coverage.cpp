// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/coverage.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::cli {

std::vector<core::Vector2> sample_path(const MarkedPath& path) {
  constexpr double kSpacing_m = 0.5;
  if (path.empty()) return {};
  std::vector<core::Vector2> samples = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const core::Vector2 along = path[i] - path[i - 1];
    const auto pieces = std::max(1L, std::lround(std::ceil(along.norm() / kSpacing_m)));
    for (long piece = 1; piece <= pieces; ++piece) {
      samples.push_back(path[i - 1] +
                        static_cast<double>(piece) / static_cast<double>(pieces) * along);
    }
  }
  return samples;
}

bool is_covered(const MarkedPath& path, const std::vector<MarkedPath>& surveyed) {
  constexpr double kReach_m = 3.0;
  constexpr double kShare = 0.9;
  std::vector<core::Vector2> training;
  for (const MarkedPath& other : surveyed) {
    const auto samples = sample_path(other);
    training.insert(training.end(), samples.begin(), samples.end());
  }
  const std::vector<core::Vector2> samples = sample_path(path);
  const auto near = std::ranges::count_if(samples, [&](const core::Vector2& point) {
    return std::ranges::any_of(training, [&](const core::Vector2& other) {
      return (other - point).squaredNorm() <= kReach_m * kReach_m;
    });
  });
  return !samples.empty() &&
         static_cast<double>(near) >= kShare * static_cast<double>(samples.size());
}

}  // namespace waylode::cli
