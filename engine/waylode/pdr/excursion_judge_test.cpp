// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/excursion_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

using Verdict = ExcursionJudge::Verdict;

core::DeviceTime at_s(double t_s) { return core::DeviceTime{} + core::from_seconds(t_s); }

/// Verdicts on a step every half second of 20 s, as soon as each is plain; headings at 50 Hz sway
/// by 3 degrees with the stride.
struct Judged {
  std::vector<Verdict> verdicts;
  double longest_wait_s = 0.0;
};
Judged judge_walk(const std::function<double(double)>& course_deg) {
  ExcursionJudge judge{ExcursionJudge::Options()};
  Judged judged;
  double step_s = 0.5;
  for (int i = 0; i <= 1000; ++i) {
    const double t_s = i / 50.0;
    const double sway_deg = 3.0 * std::sin(2.0 * core::kPi * t_s);
    judge.add(at_s(t_s), core::radians_from_degrees(course_deg(t_s) + sway_deg));
    while (step_s <= 19.5) {
      const auto verdict = judge.judge(at_s(step_s), i == 1000);
      if (!verdict) break;
      judged.verdicts.push_back(*verdict);
      judged.longest_wait_s = std::max(judged.longest_wait_s, t_s - step_s);
      step_s += 0.5;
    }
  }
  return judged;
}

int count(const Judged& judged, Verdict verdict) {
  return static_cast<int>(std::count(judged.verdicts.begin(), judged.verdicts.end(), verdict));
}

/// Aside by `deg` and back between 8 s and 8 s + `for_s`.
double look_aside_deg(double t_s, double deg, double for_s) {
  if (t_s < 8.0 || t_s > 8.0 + for_s) return 0.0;
  const double sine = std::sin(core::kPi * (t_s - 8.0) / for_s);
  return deg * sine * sine;
}

TEST(ExcursionJudge, TakesAStraightWalkForOne) {
  const Judged judged = judge_walk([](double) { return 170.0; });
  EXPECT_EQ(count(judged, Verdict::kOnCourse), 39);
  EXPECT_LT(judged.longest_wait_s, 0.5);
}

TEST(ExcursionJudge, FindsALookAsideFromBeginningToEnd) {
  for (const double deg : {50.0, 80.0, 110.0, -80.0}) {
    for (const double for_s : {3.0, 4.5, 6.0}) {
      const Judged judged =
          judge_walk([&](double t_s) { return 170.0 + look_aside_deg(t_s, deg, for_s); });
      // Off by more than the return angle for all of it but its first and last moments.
      EXPECT_GE(count(judged, Verdict::kAside), static_cast<int>(2.0 * for_s) - 3) << deg << for_s;
      EXPECT_LE(count(judged, Verdict::kAside), static_cast<int>(2.0 * for_s) + 1) << deg << for_s;
      EXPECT_EQ(count(judged, Verdict::kTurning), 0) << deg << for_s;
    }
  }
}

TEST(ExcursionJudge, KeepsTheStepsOfACorner) {
  for (const double deg : {45.0, 90.0, 180.0, -90.0}) {
    const Judged judged = judge_walk(
        [&](double t_s) { return 170.0 + deg * std::clamp((t_s - 8.0) / 1.0, 0.0, 1.0); });
    EXPECT_EQ(count(judged, Verdict::kAside), 0) << deg;
    EXPECT_GE(count(judged, Verdict::kTurning), 1) << deg;
    // What follows the corner is on course again.
    EXPECT_EQ(judged.verdicts.back(), Verdict::kOnCourse) << deg;
  }
}

TEST(ExcursionJudge, FollowsABendingCourse) {
  const Judged judged = judge_walk([](double t_s) { return 6.0 * t_s; });
  EXPECT_EQ(count(judged, Verdict::kAside), 0);
}

TEST(ExcursionJudge, WaitsNoLongerThanItSays) {
  // Turning on and on: never back, never settled.
  const Judged judged = judge_walk([](double t_s) { return t_s < 5.0 ? 0.0 : 40.0 * (t_s - 5.0); });
  EXPECT_EQ(judged.verdicts.size(), 39U);
  EXPECT_LE(judged.longest_wait_s, ExcursionJudge::Options().longest_s + 0.5);
}

TEST(ExcursionJudge, KnowsNothingAsideWithoutDirections) {
  ExcursionJudge judge{ExcursionJudge::Options()};
  judge.add(at_s(0.0), std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(judge.judge(at_s(1.0)), Verdict::kOnCourse);
}

TEST(ExcursionJudge, RefusesOptionsOutOfRange) {
  ExcursionJudge::Options options;
  EXPECT_TRUE(options.validate());
  options.return_rad = options.leave_rad;
  EXPECT_FALSE(options.validate());
  options = {};
  options.longest_s = 0.5 * options.settle_s;
  EXPECT_FALSE(options.validate());
}

}  // namespace
}  // namespace waylode::pdr
