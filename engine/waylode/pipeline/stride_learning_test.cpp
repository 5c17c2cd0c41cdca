// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/stride_learning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using testing::at_s;

/// Walkers whose steps are 0.7 m: K1 0.2 and K2 0.3 of these features give it.
observation::MotionDelta step_at(int number, double heading_rad) {
  observation::MotionDelta step;
  step.begin = at_s(0.5 * number);
  step.end = at_s(0.5 * (number + 1));
  step.length_m = 0.5;
  step.heading_rad = heading_rad;
  step.stride = {.swing_root = 1.8, .mean_abs_time_mps = 0.8};
  return step;
}

observation::RadioObservation place_at(double time_s, const core::Vector2& place_m,
                                       double sigma_m) {
  observation::RadioObservation scan;
  scan.measured = scan.delivered = at_s(time_s);
  scan.floors.resize(1);
  scan.floors[0].floor = core::FloorId{0};
  scan.floors[0].position_m = place_m;
  scan.floors[0].covariance_m2 = sigma_m * sigma_m * core::Matrix2::Identity();
  return scan;
}

double length_m(const pdr::StrideGains& gains) {
  return gains.mean_gain * 0.8 + gains.swing_gain * 1.8;
}

/// 40 steps east with a scan every second step, then a corner.
std::optional<pdr::StrideGains> learn(StrideLearning& learning, double step_m, double sigma_m) {
  std::optional<pdr::StrideGains> learnt;
  for (int i = 0; i < 40; ++i) {
    if (const auto gains = learning.add(step_at(i, 0.0))) learnt = gains;
    if (i % 2 == 1) learning.add(place_at(0.5 * (i + 1), {step_m * (i + 1), 3.0}, sigma_m));
  }
  if (const auto gains = learning.add(step_at(40, 0.5 * core::kPi))) learnt = gains;
  return learnt;
}

TEST(StrideLearning, FindsTheLengthThatGoodScansTell) {
  const auto site = testing::tiny_site();
  StrideLearning learning(*site, {});
  const auto gains = learn(learning, 0.7, 0.05);
  ASSERT_TRUE(gains);
  EXPECT_NEAR(length_m(*gains), 0.7, 0.01);
}

TEST(StrideLearning, KeepsToThePriorWhereScansAreVague) {
  const auto site = testing::tiny_site();
  StrideLearning learning(*site, {});
  const double prior_m = length_m(learning.gains());
  const auto gains = learn(learning, 0.7, 60.0);
  ASSERT_TRUE(gains);
  EXPECT_NEAR(length_m(*gains), prior_m, 0.01);
}

TEST(StrideLearning, LearnsNothingWithoutScansOrOverAFewSteps) {
  const auto site = testing::tiny_site();
  StrideLearning silent(*site, {});
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(silent.add(step_at(i, 0.0)));
  EXPECT_FALSE(silent.add(step_at(40, 1.5)));

  StrideLearning brief(*site, {});
  for (int i = 0; i < 6; ++i) {
    EXPECT_FALSE(brief.add(step_at(i, 0.0)));
    brief.add(place_at(0.5 * (i + 1), {0.7 * (i + 1), 3.0}, 0.05));
  }
  EXPECT_FALSE(brief.add(step_at(6, 1.5)));
}

TEST(StrideLearning, TakesNoNewsFromScansThatWentBackwards) {
  const auto site = testing::tiny_site();
  StrideLearning learning(*site, {});
  EXPECT_FALSE(learn(learning, -0.7, 0.05));
}

}  // namespace
}  // namespace waylode::pipeline
