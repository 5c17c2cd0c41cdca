// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/quantile.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace waylode::eval::detail {
namespace {

/// Linear search for the two order statistics around the rank, and a straight line between them.
double slow_quantile(const std::vector<double>& sorted, double probability) {
  const double rank = probability * static_cast<double>(sorted.size() - 1);
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    const auto position = static_cast<double>(i);
    if (rank <= position + 1.0) {
      return sorted[i] * (position + 1.0 - rank) + sorted[i + 1] * (rank - position);
    }
  }
  return sorted.back();
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  const std::vector<double> sorted = {1.0, 2.0, 4.0, 8.0};
  EXPECT_DOUBLE_EQ(quantile(sorted, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(sorted, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(quantile(sorted, 0.75), 5.0);
  EXPECT_DOUBLE_EQ(quantile(sorted, 1.0), 8.0);
}

TEST(Quantile, OfOneValueIsThatValue) {
  EXPECT_DOUBLE_EQ(quantile(std::vector<double>{3.5}, 0.9), 3.5);
}

TEST(Quantile, OfNothingIsNotANumber) { EXPECT_TRUE(std::isnan(quantile({}, 0.5))); }

RC_GTEST_PROP(Quantile, AgreesWithASlowReference, (const std::vector<std::int16_t>& raw)) {
  RC_PRE(!raw.empty());
  std::vector<double> sorted;
  for (const std::int16_t value : raw) sorted.push_back(0.01 * value);
  std::sort(sorted.begin(), sorted.end());
  const double probability = *rc::gen::inRange(0, 1001) / 1000.0;
  RC_ASSERT(std::abs(quantile(sorted, probability) - slow_quantile(sorted, probability)) < 1e-9);
}

TEST(Mean, IsTheSumOverTheCount) {
  EXPECT_DOUBLE_EQ(mean(std::vector<double>{1.0, 2.5, 7.0}), 3.5);
  EXPECT_TRUE(std::isnan(mean({})));
}

}  // namespace
}  // namespace waylode::eval::detail
