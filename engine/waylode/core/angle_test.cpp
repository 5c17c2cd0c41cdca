// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/angle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace waylode::core {
namespace {

constexpr double kTolerance_rad = 1e-12;

double any_angle_rad() { return *rc::gen::inRange(-100'000, 100'000) * 1e-3; }

TEST(WrapAngle, LeavesAnglesInRangeExactlyAsTheyAre) {
  for (const double angle_rad : {0.0, -0.0, 1.25, -3.1, kPi}) {
    EXPECT_EQ(wrap_angle(angle_rad), angle_rad);
  }
}

TEST(WrapAngle, TakesMinusPiToPi) {
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_EQ(wrap_angle(-3.0 * kPi), kPi);
}

TEST(WrapAngle, RemovesWholeTurns) {
  EXPECT_NEAR(wrap_angle(5.0), 5.0 - 2.0 * kPi, kTolerance_rad);
  EXPECT_NEAR(wrap_angle(-4.0), 2.0 * kPi - 4.0, kTolerance_rad);
  EXPECT_NEAR(wrap_angle(0.5 + 2000.0 * kPi), 0.5, 1e-9);
}

TEST(WrapAngle, StaysInRangeJustOutsideTheBorders) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double above = wrap_angle(std::nextafter(kPi, kInfinity));
  const double below = wrap_angle(std::nextafter(-kPi, -kInfinity));
  EXPECT_GT(above, -kPi);
  EXPECT_LE(above, kPi);
  EXPECT_GT(below, -kPi);
  EXPECT_LE(below, kPi);
}

RC_GTEST_PROP(WrapAngle, KeepsTheDirectionAndTheRange, ()) {
  const double angle_rad = any_angle_rad();
  const double wrapped_rad = wrap_angle(angle_rad);
  RC_ASSERT(wrapped_rad > -kPi && wrapped_rad <= kPi);
  RC_ASSERT(std::abs(std::sin(wrapped_rad) - std::sin(angle_rad)) < kTolerance_rad);
  RC_ASSERT(std::abs(std::cos(wrapped_rad) - std::cos(angle_rad)) < kTolerance_rad);
  RC_ASSERT(wrap_angle(wrapped_rad) == wrapped_rad);
}

TEST(Heading, IsCounterClockwiseFromEastWhereAzimuthIsClockwiseFromNorth) {
  EXPECT_NEAR(heading_from_azimuth(0.0), kPi / 2.0, kTolerance_rad);                   // north
  EXPECT_NEAR(heading_from_azimuth(radians_from_degrees(90.0)), 0.0, kTolerance_rad);  // east
  EXPECT_NEAR(heading_from_azimuth(radians_from_degrees(210.0)), radians_from_degrees(-120.0),
              kTolerance_rad);
}

TEST(Heading, GivesAzimuthsBelowAFullTurn) {
  EXPECT_NEAR(azimuth_from_heading(kPi), 1.5 * kPi, kTolerance_rad);  // west
  const double just_left_of_north_rad = std::nextafter(kPi / 2.0, 4.0);
  EXPECT_LT(azimuth_from_heading(just_left_of_north_rad), 2.0 * kPi);
}

RC_GTEST_PROP(Heading, TurnsBackIntoTheSameAzimuth, ()) {
  const double heading_rad = wrap_angle(any_angle_rad());
  const double azimuth_rad = azimuth_from_heading(heading_rad);
  RC_ASSERT(azimuth_rad >= 0.0 && azimuth_rad < 2.0 * kPi);
  RC_ASSERT(std::abs(wrap_angle(heading_from_azimuth(azimuth_rad) - heading_rad)) < kTolerance_rad);
}

TEST(Degrees, AreAFullTurnAt360) {
  EXPECT_DOUBLE_EQ(radians_from_degrees(360.0), 2.0 * kPi);
  EXPECT_DOUBLE_EQ(degrees_from_radians(-kPi / 4.0), -45.0);
}

TEST(CircularMean, AveragesAcrossTheBorder) {
  const std::vector angles_rad = {radians_from_degrees(170.0), radians_from_degrees(-160.0)};
  const auto mean = circular_mean(angles_rad);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->mean_rad, radians_from_degrees(-175.0), kTolerance_rad);
  EXPECT_NEAR(mean->resultant_ratio, std::cos(radians_from_degrees(15.0)), kTolerance_rad);
}

TEST(CircularMean, WeighsDirections) {
  const std::vector angles_rad = {0.0, kPi / 2.0};
  const std::vector weights = {1.0, std::sqrt(3.0)};
  const auto mean = circular_mean(angles_rad, weights);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->mean_rad, kPi / 3.0, kTolerance_rad);  // tan 60 deg = sqrt 3
  EXPECT_NEAR(mean->resultant_ratio, 2.0 / (1.0 + std::sqrt(3.0)), kTolerance_rad);
}

TEST(CircularMean, StaysInRangeAtTheBorder) {
  const auto mean = circular_mean(std::vector{-kPi});
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->mean_rad, kPi);
}

TEST(CircularMean, HasNoValueWhereThereIsNoDirection) {
  EXPECT_FALSE(circular_mean({}));
  EXPECT_FALSE(circular_mean(std::vector{0.3, 0.3 - kPi}));
  EXPECT_FALSE(circular_mean(std::vector{0.3}, std::vector{0.0}));
}

}  // namespace
}  // namespace waylode::core
