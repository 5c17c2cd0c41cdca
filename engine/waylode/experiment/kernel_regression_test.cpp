// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/kernel_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::experiment {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> pooled(const std::vector<Unit>& units) {
  std::vector<double> values;
  for (const Unit& unit : units) values.insert(values.end(), unit.begin(), unit.end());
  return values;
}

TEST(KernelRegression, DrawsSamplesOfTheLawWithTheNoiseAskedFor) {
  KernelRegression::Options options;
  options.samples = 2000;
  const auto draw = draw_path_loss(options, 4);
  ASSERT_EQ(draw.distance_m.size(), 2000);
  EXPECT_GE(draw.distance_m.minCoeff(), 1.0);
  EXPECT_LT(draw.distance_m.maxCoeff(), 40.0);
  EXPECT_NEAR(draw.distance_m.mean(), 20.5, 3.0 * 39.0 / std::sqrt(12.0 * 2000.0));
  for (int i = 0; i < 2000; i += 97) {
    // -35 dBm at 2 m, and 35 dB less for ten times the distance.
    EXPECT_NEAR(draw.truth_dbm(i), -35.0 - 35.0 * std::log10(draw.distance_m(i) / 2.0), 1e-12);
  }
  const double variance_db2 = (draw.measured_dbm - draw.truth_dbm).squaredNorm() / 2000.0;
  EXPECT_NEAR(variance_db2, 4.0, 3.0 * 4.0 * std::sqrt(2.0 / 2000.0));
}

TEST(KernelRegression, DrawsBySeed) {
  EXPECT_EQ(draw_path_loss({}, 5).measured_dbm, draw_path_loss({}, 5).measured_dbm);
  EXPECT_NE(draw_path_loss({}, 5).measured_dbm, draw_path_loss({}, 6).measured_dbm);
}

TEST(KernelRegression, ReachesThePapersErrorsWithTheCompositeKernel) {
  KernelRegression::Options options;
  options.draws = 10;
  const auto outcome = kernel_regression_outcome(options);
  ASSERT_TRUE(outcome) << outcome.error().message;
  std::size_t judged = 0;
  for (const Figure& figure : outcome->figures) {
    if (!figure.bar) continue;
    ++judged;
    EXPECT_TRUE(*figure.reached()) << figure.what << ' ' << figure.ours.value;
    EXPECT_EQ(figure.ours.n, 10U);
    EXPECT_LE(figure.ours.low, figure.ours.value);
    EXPECT_GE(figure.ours.high, figure.ours.value);
  }
  EXPECT_EQ(judged, 4U);
}

TEST(KernelRegression, KeepsEveryErrorOfEveryDraw) {
  KernelRegression::Options options;
  options.samples = 30;
  options.draws = 3;
  const auto study = compare_kernels(options);
  ASSERT_TRUE(study);
  ASSERT_EQ(study->methods.size(), 6U);
  for (const auto& method : study->methods) {
    EXPECT_EQ(pooled(method.measured_errors_db).size(), 90U);
    EXPECT_EQ(pooled(method.true_errors_db).size(), 90U);
    ASSERT_EQ(method.largest_errors_db.size(), 3U);
    EXPECT_EQ(method.vectors.size(), 3U);
    const Unit& first = method.measured_errors_db.front();
    EXPECT_DOUBLE_EQ(*std::ranges::max_element(first), method.largest_errors_db.front().front());
    EXPECT_NEAR(std::abs(method.first_curve_dbm(7) - study->first_draw.measured_dbm(7)), first[7],
                1e-12);
  }
}

TEST(KernelRegression, DrawsTheCurvesFromNearToFar) {
  KernelRegression::Options options;
  options.samples = 30;
  options.draws = 1;
  const auto outcome = kernel_regression_outcome(options);
  ASSERT_TRUE(outcome);
  ASSERT_EQ(outcome->charts.size(), 1U);
  ASSERT_EQ(outcome->charts.front().series.size(), 8U);
  for (const auto& series : outcome->charts.front().series) {
    ASSERT_EQ(series.points.size(), 30U);
    for (std::size_t i = 1; i < 30; ++i) {
      EXPECT_LE(series.points[i - 1].x(), series.points[i].x());
    }
  }
}

TEST(KernelRegression, RefusesOptionsOutOfRange) {
  using Options = KernelRegression::Options;
  for (const Options& options :
       {Options{.samples = 1}, Options{.nearest_m = 0.0}, Options{.farthest_m = 1.0},
        Options{.reference_m = kNan}, Options{.exponent = 0.0}, Options{.noise_sigma_db = -1.0},
        Options{.draws = 0}}) {
    const auto refused = kernel_regression_outcome(options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::experiment
