// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "waylode/core/assert.hpp"

namespace waylode::eval::detail {

double quantile(std::span<const double> sorted, double probability) {
  WAYLODE_ASSERT(probability >= 0.0 && probability <= 1.0);
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = static_cast<double>(sorted.size() - 1) * probability;
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

double mean(std::span<const double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace waylode::eval::detail
