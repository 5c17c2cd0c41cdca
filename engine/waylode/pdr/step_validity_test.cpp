// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/step_validity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using core::kPi;
using core::radians_from_degrees;
using Verdict = StepValidity::Verdict;

TEST(DirectionScatter, IsTheDeviationOfEquationEight) {
  // Mean 12 deg, deviations -4, -2, 6: sqrt((16 + 4 + 36) / 3) deg. So small an arc hardly bends.
  const double headings[] = {radians_from_degrees(8), radians_from_degrees(10),
                             radians_from_degrees(18)};
  EXPECT_NEAR(core::degrees_from_radians(direction_scatter_rad(headings)), std::sqrt(56.0 / 3.0),
              0.01);
}

TEST(DirectionScatter, KnowsThatTheCircleIsClosed) {
  const double headings[] = {radians_from_degrees(176), radians_from_degrees(-178)};
  EXPECT_NEAR(core::degrees_from_radians(direction_scatter_rad(headings)), 3.0, 1e-9);
}

TEST(DirectionScatter, HasAnAnswerForNothingAndForOpposites) {
  EXPECT_EQ(direction_scatter_rad({}), 0.0);
  EXPECT_EQ(direction_scatter_rad(std::vector<double>{2.0}), 0.0);
  EXPECT_EQ(direction_scatter_rad(std::vector<double>(7, -3.0)), 0.0);
  EXPECT_EQ(direction_scatter_rad(std::vector<double>{0.0, kPi}), kPi);
}

RC_GTEST_PROP(DirectionScatter, DoesNotDependOnTheZeroOfTheCompass, ()) {
  const auto degrees =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-60, 60)));
  const double turn_rad = radians_from_degrees(*rc::gen::inRange(-360, 360));
  std::vector<double> here;
  std::vector<double> there;
  for (const int degree : degrees) {
    here.push_back(radians_from_degrees(degree));
    there.push_back(core::wrap_angle(radians_from_degrees(degree) + turn_rad));
  }
  RC_ASSERT(std::abs(direction_scatter_rad(here) - direction_scatter_rad(there)) < 1e-9);
}

/// Walks for `duration_s` with a step each half second; headings at 50 Hz.
std::vector<StepValidity::Judged> judge(const StepValidity::Options& options, double duration_s,
                                        const std::function<double(double)>& heading_rad,
                                        const std::function<double(double)>& swing_mps2) {
  StepValidity validity(options);
  std::vector<StepValidity::Judged> judged;
  for (int i = 0; i < static_cast<int>(50.0 * duration_s); ++i) {
    const double time_s = 0.02 * i;
    const auto now = device_time_from_seconds(time_s);
    validity.add_heading(now, heading_rad(time_s));
    if (i % 25 == 0) {
      Step step;
      step.time = now;
      step.swing_mps2 = swing_mps2(time_s);
      validity.add_step(step);
    }
    while (const auto next = validity.take(now)) {
      EXPECT_GE(now - next->step.time, core::from_seconds(options.half_window_s));
      EXPECT_LT(now - next->step.time, core::from_seconds(options.half_window_s + 0.03));
      judged.push_back(*next);
    }
  }
  while (const auto next = validity.take_rest()) judged.push_back(*next);
  return judged;
}

int count(const std::vector<StepValidity::Judged>& judged, Verdict verdict) {
  int count = 0;
  for (const auto& each : judged) count += each.verdict == verdict ? 1 : 0;
  return count;
}

/// A quarter turn within 0.8 s from 20 s on.
double corner(double time_s) { return kPi / 2.0 * std::clamp((time_s - 20.0) / 0.8, 0.0, 1.0); }
/// Looks 110 degrees aside and back from 20 s to 24 s.
double photograph(double time_s) {
  if (time_s < 20.0 || time_s > 24.0) return 3.0;
  return core::wrap_angle(3.0 + radians_from_degrees(110.0) *
                                    std::pow(std::sin(kPi * (time_s - 20.0) / 4.0), 2));
}
double strong(double /*time_s*/) { return 8.0; }
double weak_at_the_photograph(double time_s) {
  return time_s >= 20.0 && time_s <= 24.0 ? 4.0 : 8.0;
}

TEST(StepValidity, PassesAStraightWalkWithSway) {
  const auto sway = [](double time_s) {
    return core::wrap_angle(kPi + radians_from_degrees(5.0) * std::sin(2.0 * kPi * 0.9 * time_s));
  };
  for (const auto rule : {StepValidity::Rule::kLiteral, StepValidity::Rule::kThreeWay}) {
    const auto judged = judge({.rule = rule}, 40.0, sway, strong);
    EXPECT_EQ(judged.size(), 80U);
    EXPECT_EQ(count(judged, Verdict::kWalk), 80);
  }
}

TEST(StepValidity, DeletesTheStepsOfACornerOnlyAsPrinted) {
  const auto literal = judge({.rule = StepValidity::Rule::kLiteral}, 40.0, corner, strong);
  const auto three_way = judge({}, 40.0, corner, strong);
  EXPECT_GE(count(literal, Verdict::kInPlace), 2);
  EXPECT_EQ(count(three_way, Verdict::kInPlace), 0);
  EXPECT_EQ(count(three_way, Verdict::kTurn), count(literal, Verdict::kInPlace));
}

TEST(StepValidity, FindsWeakStepsWhileTheDirectionScatters) {
  const auto judged = judge({}, 40.0, photograph, weak_at_the_photograph);
  EXPECT_GE(count(judged, Verdict::kInPlace), 4);
  for (const auto& each : judged) {
    if (each.verdict != Verdict::kInPlace) continue;
    EXPECT_EQ(each.step.swing_mps2, 4.0);
    EXPECT_GT(each.scatter_rad, radians_from_degrees(20.0));
  }
}

TEST(StepValidity, KeepsAWeakStepOfASteadyDirection) {
  const auto ahead = [](double) { return -1.0; };
  EXPECT_EQ(count(judge({}, 40.0, ahead, weak_at_the_photograph), Verdict::kWalk), 80);
}

TEST(StepValidity, GivesTheBenefitOfTheDoubtToAStranger) {
  // Nothing known of the person: in the midst of a turn from the first step on.
  const auto spin = [](double time_s) { return core::wrap_angle(2.0 * time_s); };
  const auto judged = judge({}, 5.0, spin, weak_at_the_photograph);
  EXPECT_EQ(count(judged, Verdict::kTurn), 10);
}

TEST(StepValidity, JudgesWithoutHeadingsAsAWalkAndPassesOverWhatIsNoNumber) {
  StepValidity validity({});
  validity.add_heading(device_time_from_seconds(1.0), std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(validity.take(device_time_from_seconds(9.0)));
  EXPECT_FALSE(validity.take_rest());
  Step step;
  step.time = device_time_from_seconds(1.0);
  validity.add_step(step);
  EXPECT_FALSE(validity.take(device_time_from_seconds(1.7)));
  const auto judged = validity.take(device_time_from_seconds(1.75));
  ASSERT_TRUE(judged);
  EXPECT_EQ(judged->verdict, Verdict::kWalk);
  EXPECT_EQ(judged->scatter_rad, 0.0);
}

TEST(StepValidity, RefusesOptionsOutOfRange) {
  using Options = StepValidity::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.half_window_s = value}.validate());
    EXPECT_FALSE(Options{.scatter_rad = value}.validate());
    EXPECT_FALSE(Options{.weak_swing_ratio = value}.validate());
  }
}

}  // namespace
}  // namespace waylode::pdr
