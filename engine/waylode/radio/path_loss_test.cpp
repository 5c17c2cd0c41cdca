// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/path_loss.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/rng.hpp"

namespace waylode::radio {
namespace {

using core::Vector2;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The simulation of [Zhao2019]: -35 dBm at 2 m, exponent 3.5.
constexpr PathLoss kZhao{.reference_distance_m = 2.0, .reference_dbm = -35.0, .exponent = 3.5};

TEST(PathLoss, FallsTenTimesTheExponentPerDecade) {
  EXPECT_NEAR(kZhao.mean_dbm(2.0), -35.0, 1e-12);
  EXPECT_NEAR(kZhao.mean_dbm(20.0), -70.0, 1e-12);
  EXPECT_NEAR(kZhao.mean_dbm(4.0), -35.0 - 35.0 * std::log10(2.0), 1e-12);
  EXPECT_TRUE(std::isfinite(kZhao.mean_dbm(0.0)));
}

TEST(PathLoss, TellsTheDistanceOfAStrength) {
  ASSERT_TRUE(kZhao.distance_m(-70.0));
  EXPECT_NEAR(*kZhao.distance_m(-70.0), 20.0, 1e-9);
  EXPECT_NEAR(*kZhao.distance_m(kZhao.mean_dbm(7.3)), 7.3, 1e-9);
  EXPECT_FALSE((PathLoss{1.0, -40.0, 0.0}.distance_m(-50.0)));
  EXPECT_FALSE((PathLoss{1.0, -40.0, -2.0}.distance_m(-50.0)));
  EXPECT_FALSE(kZhao.distance_m(kNan));
  EXPECT_FALSE((PathLoss{1.0, -40.0, 1e-3}.distance_m(-90.0)));  // 10^5000 m.
}

TEST(FitPathLoss, RecoversTheLawOfExactReadings) {
  std::vector<DistanceReading> readings;
  for (const double distance_m : {1.5, 2.5, 6.0, 11.0, 30.0}) {
    readings.push_back({distance_m, kZhao.mean_dbm(distance_m)});
  }
  const auto fit = fit_path_loss(readings, 2.0);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->law.reference_dbm, -35.0, 1e-9);
  EXPECT_NEAR(fit->law.exponent, 3.5, 1e-9);
  EXPECT_NEAR(fit->sigma_db, 0.0, 1e-9);
  EXPECT_EQ(fit->readings, 5U);
}

TEST(FitPathLoss, IsTheStraightLineWorkedOutByHand) {
  // Decades 0, 1, 2 with -40, -58, -82: slope -21, level -39, residuals -1, 2, -1.
  const auto fit =
      fit_path_loss(std::vector<DistanceReading>{{1.0, -40.0}, {10.0, -58.0}, {100.0, -82.0}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->law.exponent, 2.1, 1e-12);
  EXPECT_NEAR(fit->law.reference_dbm, -39.0, 1e-12);
  EXPECT_NEAR(fit->sigma_db, std::sqrt(6.0), 1e-12);
}

TEST(FitPathLoss, TellsTheNoiseOfItsReadings) {
  core::Rng rng(20190101);
  std::vector<DistanceReading> readings;
  for (int i = 0; i < 2000; ++i) {
    const double distance_m = rng.uniform(1.0, 40.0);
    readings.push_back({distance_m, kZhao.mean_dbm(distance_m) + 2.0 * rng.normal()});
  }
  const auto fit = fit_path_loss(readings, 2.0);
  ASSERT_TRUE(fit);
  // Four standard errors: sigma / sqrt(2 n) = 0.032; of the slope, 2 / (sqrt(n) * 10 * 0.37).
  EXPECT_NEAR(fit->sigma_db, 2.0, 0.13);
  EXPECT_NEAR(fit->law.exponent, 3.5, 0.05);
}

TEST(FitPathLoss, NeedsTwoDistances) {
  EXPECT_FALSE(fit_path_loss({}));
  EXPECT_FALSE(fit_path_loss(std::vector<DistanceReading>{{3.0, -50.0}}));
  EXPECT_FALSE(fit_path_loss(std::vector<DistanceReading>{{3.0, -50.0}, {3.0, -60.0}}));
  EXPECT_FALSE(fit_path_loss(
      std::vector<DistanceReading>{{3.0, -50.0}, {kNan, -60.0}, {9.0, kNan}, {-1.0, -50.0}}));
  const auto two = fit_path_loss(std::vector<DistanceReading>{{1.0, -40.0}, {10.0, -65.0}});
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->law.exponent, 2.5, 1e-12);
  EXPECT_EQ(two->sigma_db, 0.0);
}

/// Readings on a grid of 10 x 5 places, 3 m apart, of a transmitter 1.5 m above `at_m`.
std::vector<PlacedReading> heard_around(const Vector2& at_m) {
  const PathLoss law{.reference_distance_m = 1.0, .reference_dbm = -38.0, .exponent = 2.7};
  std::vector<PlacedReading> readings;
  for (int i = 0; i < 50; ++i) {
    const Vector2 place_m(3.0 * (i % 10), 3.0 * (i / 10));
    const double distance_m = std::sqrt((place_m - at_m).squaredNorm() + 1.5 * 1.5);
    readings.push_back({place_m, law.mean_dbm(distance_m)});
  }
  return readings;
}

RC_GTEST_PROP(TransmitterLocator, FindsWhereATransmitterStands, ()) {
  const Vector2 at_m(0.1 * *rc::gen::inRange(-50, 320), 0.1 * *rc::gen::inRange(-50, 170));
  const auto fit = TransmitterLocator({}).fit(heard_around(at_m));
  RC_ASSERT(fit.has_value());
  RC_ASSERT((fit->position_m - at_m).norm() < 0.1);
  RC_ASSERT(std::abs(fit->law.exponent - 2.7) < 0.05);
  RC_ASSERT(fit->sigma_db < 0.1);
}

TEST(TransmitterLocator, LeavesALargeResidualForOneThatMoved) {
  // Half of the places heard it at one end, half at the other, each time as loud as beside it.
  std::vector<PlacedReading> readings;
  for (int i = 0; i < 40; ++i) {
    const bool near_it = i % 2 == 0;  // Carried along on one visit, far away on the next.
    readings.push_back({Vector2(2.0 * i, (i * 7) % 5), near_it ? -40.0 : -85.0});
  }
  const auto fit = TransmitterLocator({}).fit(readings);
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->sigma_db, 12.0);
}

TEST(TransmitterLocator, NeedsFiveReadingsAndTwoPlaces) {
  const TransmitterLocator locator({});
  const std::vector<PlacedReading> readings = heard_around(Vector2(4.0, 5.0));
  EXPECT_FALSE(locator.fit({}));
  EXPECT_FALSE(locator.fit(std::span(readings).first(4)));
  EXPECT_TRUE(locator.fit(std::span(readings).first(5)));
  EXPECT_FALSE(locator.fit(std::vector<PlacedReading>(9, readings[0])));
  std::vector<PlacedReading> broken(readings.begin(), readings.begin() + 5);
  broken[2].rssi_dbm = kNan;
  EXPECT_FALSE(locator.fit(broken));
  broken[2] = {Vector2(kNan, 0.0), -50.0};
  EXPECT_FALSE(locator.fit(broken));
}

TEST(TransmitterLocator, RefusesOptionsOutOfRange) {
  using Options = TransmitterLocator::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.min_exponent = -0.1}.validate());
  EXPECT_FALSE((Options{.min_exponent = 4.0, .max_exponent = 3.0}.validate()));
  EXPECT_FALSE(Options{.margin_m = kNan}.validate());
  EXPECT_FALSE(Options{.height_m = 0.0}.validate());
  EXPECT_FALSE(Options{.grid = 1}.validate());
  EXPECT_FALSE(Options{.iterations = 1001}.validate());
}

}  // namespace
}  // namespace waylode::radio
