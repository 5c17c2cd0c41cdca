// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/pressure_climb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "waylode/core/rng.hpp"

namespace waylode::pdr {
namespace {

using observation::VerticalMotion;
using sample::BarometerSample;

/// ISO 2533, the standard atmosphere's troposphere.
double pressure_at(double height_m) {
  return 1013.25 * std::pow(1.0 - 0.0065 * height_m / 288.15, 5.255877);
}

using Heights = std::function<double(double time_s)>;

/// What is told of heights by time, sampled ten times a second.
std::vector<VerticalMotion> told_of(const Heights& height_m, double until_s,
                                    double noise_hpa = 0.0) {
  PressureClimb climbs{PressureClimb::Options()};
  core::Rng rng(7);
  std::vector<VerticalMotion> told;
  for (int i = 0; i < static_cast<int>(10.0 * until_s); ++i) {
    const double time_s = 0.1 * i;
    const BarometerSample sample{core::device_time_from_seconds(time_s),
                                 pressure_at(height_m(time_s)) + noise_hpa * rng.normal()};
    if (const auto climb = climbs.add(sample)) told.push_back(*climb);
  }
  return told;
}

/// From `begin_s` on by `rate_mps` until `climb_m` is made.
double ramp(double time_s, double begin_s, double rate_mps, double climb_m) {
  const double made_m = rate_mps * std::max(0.0, time_s - begin_s);
  return std::abs(made_m) < std::abs(climb_m) ? made_m : climb_m;
}

double seconds_of(core::DeviceTime time) { return core::to_seconds(time - core::DeviceTime{}); }

TEST(PressureClimb, TellsStairsWhileTheyAreClimbedAndTheirWholeHeightInTheEnd) {
  const auto told =
      told_of([](double time_s) { return 95.0 + ramp(time_s, 40.0, 0.25, 4.0); }, 80.0, 0.006);
  ASSERT_GE(told.size(), 3U);
  // 1.5 m at 0.25 m/s takes 6 s; half a metre of it may be lost to the drift.
  EXPECT_LT(seconds_of(told.front().end), 49.0);
  EXPECT_NEAR(seconds_of(told.front().begin), 41.0, 2.0);
  EXPECT_NEAR(told.back().climb_m, 4.0, 0.4);
  for (const VerticalMotion& climb : told) EXPECT_EQ(climb.begin, told.front().begin);
}

TEST(PressureClimb, TellsADescentByLift) {
  const auto told =
      told_of([](double time_s) { return 30.0 + ramp(time_s, 25.0, -1.0, -9.3); }, 60.0, 0.006);
  ASSERT_FALSE(told.empty());
  EXPECT_LT(seconds_of(told.front().end), 28.0);
  EXPECT_NEAR(told.back().climb_m, -9.3, 0.3);
}

TEST(PressureClimb, TellsAFastLiftFromADoorsJump) {
  // From rest by 1 m/s^2 to 2 m/s, through 8 m.
  const auto told = told_of(
      [](double time_s) {
        const double ran_s = std::clamp(time_s - 20.0, 0.0, 5.0);
        return ran_s < 2.0 ? 0.5 * ran_s * ran_s : 2.0 + 2.0 * (ran_s - 2.0);
      },
      50.0);
  ASSERT_FALSE(told.empty());
  EXPECT_NEAR(told.back().climb_m, 8.0, 0.3);
}

TEST(PressureClimb, CountsAHalfLandingWithTheClimb) {
  const auto told = told_of(
      [](double time_s) {
        return ramp(time_s, 30.0, 0.3, 1.8) + ramp(time_s, 44.0, 0.3, 1.6);  // 8 s between.
      },
      80.0);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().begin, told.front().begin);
  EXPECT_NEAR(told.back().climb_m, 3.4, 0.4);
}

TEST(PressureClimb, TellsTheNextClimbAnewAfterARest) {
  const auto told = told_of(
      [](double time_s) { return ramp(time_s, 30.0, 0.4, 3.0) + ramp(time_s, 70.0, 0.4, 2.6); },
      110.0);
  ASSERT_FALSE(told.empty());
  EXPECT_GT(told.back().begin, told.front().begin);
  EXPECT_NEAR(told.back().climb_m, 2.6, 0.4);
}

TEST(PressureClimb, TakesBackAClimbThatReturns) {
  const auto told = told_of(
      [](double time_s) { return ramp(time_s, 30.0, 0.4, 2.4) - ramp(time_s, 38.0, 0.4, 2.4); },
      80.0);
  ASSERT_FALSE(told.empty());
  EXPECT_NEAR(told.back().climb_m, 0.0, 0.3);
}

TEST(PressureClimb, FollowsTheWeather) {
  // A storm: 3 hPa an hour, some 25 m of height.
  EXPECT_TRUE(told_of([](double time_s) { return time_s * 25.0 / 3600.0; }, 3600.0, 0.006).empty());
}

TEST(PressureClimb, PassesOverADoorsJump) {
  for (const double jump_m : {-2.5, 1.7, 4.0}) {
    const auto told = told_of(
        [&](double time_s) { return time_s > 20.05 && time_s < 50.05 ? jump_m : 0.0; }, 80.0);
    EXPECT_TRUE(told.empty()) << jump_m;
  }
}

TEST(PressureClimb, PassesOverSamplesThatAreNoPressureAndThoseThatComeLate) {
  PressureClimb clean{PressureClimb::Options()};
  PressureClimb littered{PressureClimb::Options()};
  std::size_t told = 0;
  for (int i = 0; i < 600; ++i) {
    const auto time = core::device_time_from_seconds(0.1 * i);
    const BarometerSample sample{time, pressure_at(ramp(0.1 * i, 30.0, 0.4, 4.0))};
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -3.0, 0.0}) {
      EXPECT_EQ(littered.add({time, bad}), std::nullopt);
    }
    const auto expected = clean.add(sample);
    EXPECT_EQ(littered.add(sample), expected);
    EXPECT_EQ(littered.add({time, pressure_at(80.0)}), std::nullopt);  // The same time again.
    EXPECT_EQ(littered.add({time - core::from_seconds(2.0), pressure_at(80.0)}), std::nullopt);
    if (expected) ++told;
  }
  EXPECT_GT(told, 0U);
}

TEST(PressureClimb, StartsAnewAfterALongGap) {
  const auto heights = [](double gap_s) {
    PressureClimb climbs{PressureClimb::Options()};
    std::size_t told = 0;
    for (int i = 0; i < 400; ++i) {
      const double time_s = 0.1 * i + (i < 200 ? 0.0 : gap_s);
      const double height_m = i < 200 ? 10.0 : 14.0;
      if (climbs.add({core::device_time_from_seconds(time_s), pressure_at(height_m)})) ++told;
    }
    return told;
  };
  EXPECT_EQ(heights(90.0), 0U);
  EXPECT_GE(heights(20.0), 1U);  // A lift without samples.
}

TEST(PressureClimb, RejectsOptionsThatMakeNoSense) {
  EXPECT_TRUE(PressureClimb::Options().validate());
  const auto with = [](double PressureClimb::Options::* member, double value) {
    PressureClimb::Options options;
    options.*member = value;
    return options.validate();
  };
  using Options = PressureClimb::Options;
  for (const auto member : {&Options::averaging_s, &Options::drift_tau_s, &Options::certain_climb_m,
                            &Options::report_step_m, &Options::rest_s, &Options::rest_band_m,
                            &Options::sigma_m, &Options::longest_gap_s}) {
    const auto valid = with(member, std::nan(""));
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
    EXPECT_FALSE(with(member, 0.0));
  }
  EXPECT_FALSE(with(&Options::least_rise_s, -1.0));
}

}  // namespace
}  // namespace waylode::pdr
