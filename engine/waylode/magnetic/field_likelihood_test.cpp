// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/field_likelihood.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace waylode::magnetic {
namespace {

using core::Vector2;
using site::MagneticPoint;

FieldLikelihood::Options options() {
  return {.node_m = 0.5,
          .kernel_m = 1.0,
          .reach_m = 3.0,
          .trust_points = 0.5,
          .field_sigma_ut = 2.0,
          .bias_sigma_ut = 0.0,
          .cap_sigmas = 3.0,
          .correlation_m = 2.0,
          .weight_ratio = 1.0};
}

MagneticPoint point(float x_m, float y_m, float horizontal_ut, float vertical_ut,
                    float sigma_ut = 0.0F) {
  return {x_m, y_m, horizontal_ut, vertical_ut, sigma_ut, 0, 3};
}

/// Far enough apart to know nothing of each other. Mean (25, -42), variances (25, 9).
std::vector<MagneticPoint> two_places() {
  return {point(0.0F, 0.0F, 20.0F, -45.0F), point(20.0F, 0.0F, 30.0F, -39.0F)};
}

TEST(FieldLikelihood, MixesASurveyedPointWithTheFloorAtLarge) {
  const FieldLikelihood field(two_places(), options());
  const FieldExpectation here = field.expected_at(Vector2(0.0, 0.0));
  // Weight 1 against 0.5: 2/3 known. Floor variances 25 + 4 and 9 + 4; offsets -5 and -3.
  EXPECT_NEAR(here.mean_ut.x(), 25.0 - 10.0 / 3.0, 1e-4);
  EXPECT_NEAR(here.mean_ut.y(), -42.0 - 2.0, 1e-4);
  EXPECT_NEAR(here.variance_ut2.x(), 2.0 / 3.0 * 4.0 + 29.0 / 3.0 + 2.0 / 9.0 * 25.0, 1e-4);
  EXPECT_NEAR(here.variance_ut2.y(), 2.0 / 3.0 * 4.0 + 13.0 / 3.0 + 2.0 / 9.0 * 9.0, 1e-4);
}

TEST(FieldLikelihood, KnowsLessFartherFromSurveyedGround) {
  const FieldLikelihood field(two_places(), options());
  double last_ut = 20.0;
  for (const double y_m : {0.0, 1.0, 2.0, 3.0}) {
    const double mean_ut = field.expected_at(Vector2(0.0, y_m)).mean_ut.x();
    EXPECT_GT(mean_ut, last_ut);
    last_ut = mean_ut;
  }
  EXPECT_LT(last_ut, 25.0);
}

TEST(FieldLikelihood, GivesTheScatterOfReadingsThatDisagree) {
  // Two points half a metre either side of a node: local variance 6^2 and, from sigma 5, 25.
  const std::vector<MagneticPoint> points = {point(0.0F, 0.0F, 20.0F, -40.0F, 5.0F),
                                             point(1.0F, 0.0F, 32.0F, -40.0F, 5.0F)};
  FieldLikelihood::Options sure = options();
  sure.trust_points = 1e-9;
  const FieldExpectation here = FieldLikelihood(points, sure).expected_at(Vector2(0.5, 0.0));
  EXPECT_NEAR(here.mean_ut.x(), 26.0, 1e-4);
  EXPECT_NEAR(here.variance_ut2.x(), 36.0 + 25.0, 1e-3);
  EXPECT_NEAR(here.variance_ut2.y(), 25.0, 1e-3);
}

TEST(FieldLikelihood, NeitherRewardsNorPunishesUnknownGround) {
  const FieldLikelihood field(two_places(), options());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector2& place :
       {Vector2(10.0, 0.0), Vector2(0.0, 4.3), Vector2(-900.0, 7.0), Vector2(nan, 0.0),
        Vector2(0.0, std::numeric_limits<double>::infinity())}) {
    for (const double horizontal_ut : {20.0, 25.0, 70.0}) {
      EXPECT_EQ(field.log_likelihood({horizontal_ut, -41.0}, place), 0.0);
    }
  }
}

TEST(FieldLikelihood, RewardsThePlaceWhoseFieldIsMeasured) {
  const FieldLikelihood field(two_places(), options());
  const LevelField left{20.0, -45.0};
  EXPECT_GT(field.log_likelihood(left, Vector2(0.0, 0.0)), 0.3);
  EXPECT_LT(field.log_likelihood(left, Vector2(20.0, 0.0)), -0.3);
}

TEST(FieldLikelihood, IsTheRatioOfTwoNormalDensities) {
  const FieldLikelihood field(two_places(), options());
  const auto normal = [](double residual, double variance) {
    return -0.5 * (residual * residual / variance + std::log(variance));
  };
  // The first test's moments; one node, so nothing is interpolated.
  const double vx = 2.0 / 3.0 * 4.0 + 29.0 / 3.0 + 2.0 / 9.0 * 25.0;
  const double vy = 2.0 / 3.0 * 4.0 + 13.0 / 3.0 + 2.0 / 9.0 * 9.0;
  EXPECT_NEAR(
      field.log_likelihood({23.0, -43.0}, Vector2(0.0, 0.0)),
      normal(23.0 - 65.0 / 3.0, vx) - normal(-2.0, 29.0) + normal(1.0, vy) - normal(-1.0, 13.0),
      1e-4);
}

TEST(FieldLikelihood, WeighsReadingsByTheWayBetweenThem) {
  const FieldLikelihood field(two_places(), options());
  const LevelField measured{21.0, -44.0};
  const Vector2 here(0.0, 0.0);
  BiasedFieldState bias = field.start();
  const double whole = field.update(bias, measured, here, 2.0);
  EXPECT_NEAR(field.update(bias, measured, here, 0.5), 0.25 * whole, 1e-12);
  EXPECT_NEAR(field.update(bias, measured, here, 7.0), whole, 1e-12);
  EXPECT_EQ(field.update(bias, measured, here, 0.0), 0.0);
  EXPECT_EQ(field.update(bias, measured, here, -1.0), 0.0);
  EXPECT_EQ(field.update(bias, measured, here, std::numeric_limits<double>::quiet_NaN()), 0.0);
  EXPECT_NEAR(field.log_likelihood(measured, here), whole, 1e-12);
}

TEST(FieldLikelihood, LearnsTheBiasOfTheRightPath) {
  FieldLikelihood::Options biased = options();
  biased.bias_sigma_ut = 6.0;
  biased.trust_points = 0.01;
  std::vector<MagneticPoint> points;
  for (int i = 0; i < 60; ++i) {
    const auto x_m = 0.5F * static_cast<float>(i);
    points.push_back(point(x_m, 0.0F, 25.0F + 6.0F * std::sin(0.5F * x_m),
                           -40.0F + 5.0F * std::cos(0.7F * x_m)));
  }
  const FieldLikelihood field(points, biased);
  BiasedFieldState right = field.start();
  BiasedFieldState wrong = field.start();
  double sum_right = 0.0;
  double sum_wrong = 0.0;
  for (double x_m = 2.0; x_m < 22.0; x_m += 0.5) {
    const LevelField measured{25.0 + 6.0 * std::sin(0.5 * x_m) + 4.0,
                              -40.0 + 5.0 * std::cos(0.7 * x_m) - 3.0};
    sum_right += field.update(right, measured, Vector2(x_m, 0.0), 0.5);
    sum_wrong += field.update(wrong, measured, Vector2(x_m + 5.0, 0.0), 0.5);
  }
  EXPECT_NEAR(right.mean_ut.x(), 4.0, 1.0);
  EXPECT_NEAR(right.mean_ut.y(), -3.0, 1.0);
  EXPECT_GT(sum_right, sum_wrong + 5.0);
}

TEST(FieldLikelihood, SaysNothingOfAFloorWithoutASurvey) {
  for (const FieldLikelihood& field : {FieldLikelihood(), FieldLikelihood({}, options())}) {
    EXPECT_TRUE(field.empty());
    EXPECT_EQ(field.log_likelihood({25.0, -40.0}, Vector2(3.0, 4.0)), 0.0);
  }
}

TEST(FieldLikelihood, SaysNothingWhereAllPlacesAreAlike) {
  std::vector<MagneticPoint> points;
  for (int i = 0; i < 20; ++i) points.push_back(point(static_cast<float>(i), 0.0F, 25.0F, -40.0F));
  const FieldLikelihood field(points, options());
  EXPECT_NEAR(field.log_likelihood({22.0, -43.0}, Vector2(5.3, 0.2)), 0.0, 1e-5);
}

TEST(FieldLikelihood, PassesOverAFieldThatIsNotFinite) {
  const FieldLikelihood field(two_places(), options());
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(field.log_likelihood({inf, -40.0}, Vector2(0.0, 0.0)), 0.0);
  EXPECT_EQ(field.log_likelihood({25.0, std::nan("")}, Vector2(0.0, 0.0)), 0.0);
}

RC_GTEST_PROP(FieldLikelihood, IsBoundedHoweverWildTheReading, ()) {
  const FieldLikelihood field(two_places(), options());
  const Vector2 place(0.1 * *rc::gen::inRange(-50, 250), 0.1 * *rc::gen::inRange(-50, 50));
  const LevelField measured{0.1 * *rc::gen::inRange(0, 100000),
                            0.1 * *rc::gen::inRange(-100000, 100000)};
  // Two parts, each at most half the cap squared and half the logarithm of the variances' ratio,
  // which lies between the floor's 29 and the field's 4.
  RC_ASSERT(std::abs(field.log_likelihood(measured, place)) <=
            2.0 * (4.5 + 0.5 * std::log(29.0 / 4.0)));
}

TEST(FieldLikelihood, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(FieldLikelihood::Options().validate());
  const auto refused = [](auto member, double value) {
    FieldLikelihood::Options bad;
    bad.*member = value;
    return !bad.validate();
  };
  using Options = FieldLikelihood::Options;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto member : {&Options::node_m, &Options::kernel_m, &Options::reach_m,
                            &Options::trust_points, &Options::field_sigma_ut, &Options::cap_sigmas,
                            &Options::correlation_m, &Options::weight_ratio}) {
    EXPECT_TRUE(refused(member, 0.0));
    EXPECT_TRUE(refused(member, nan));
  }
  EXPECT_TRUE(refused(&Options::bias_sigma_ut, -1.0));
  EXPECT_TRUE(refused(&Options::bias_sigma_ut, nan));
  EXPECT_TRUE(refused(&Options::weight_ratio, 1.1));
}

}  // namespace
}  // namespace waylode::magnetic
