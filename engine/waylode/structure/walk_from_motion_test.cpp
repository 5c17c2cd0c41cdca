// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/walk_from_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::structure {
namespace {

using core::radians_from_degrees;
using observation::MotionDelta;

core::DeviceTime at_s(double seconds) { return core::device_time_from_seconds(seconds); }

/// Adds steps of 0.7 m, two a second, in one direction.
void walk_on(std::vector<MotionDelta>& motion, int steps, double heading_deg) {
  for (int i = 0; i < steps; ++i) {
    MotionDelta delta;
    delta.begin = motion.empty() ? at_s(100.0) : motion.back().end;
    delta.end = delta.begin + core::from_seconds(0.5);
    delta.length_m = 0.7;
    delta.length_sigma_m = 0.05;
    delta.heading_rad = radians_from_degrees(heading_deg);
    delta.heading_sigma_rad = 0.08;
    motion.push_back(delta);
  }
}

Walk walk_of(const std::vector<MotionDelta>& motion, const std::vector<LandmarkMark>& marks = {},
             const SegmentationOptions& options = {}) {
  const auto walk = walk_from_motion(motion, marks, options);
  EXPECT_TRUE(walk) << core::to_string(walk.error());
  EXPECT_TRUE((Survey{{walk.value_or(Walk{})}, {}, {}}.validate()));
  return walk.value_or(Walk{});
}

TEST(WalkFromMotion, SplitsWhereTheWayTurns) {
  std::vector<MotionDelta> motion;
  walk_on(motion, 20, 175);
  walk_on(motion, 10, -95);
  const Walk walk = walk_of(motion);
  ASSERT_EQ(walk.segments.size(), 2U);
  EXPECT_NEAR(walk.segments[0].length_m, 14.0, 1e-9);
  EXPECT_NEAR(walk.segments[0].direction_rad, radians_from_degrees(175), 1e-9);
  EXPECT_EQ(walk.segments[0].begin, at_s(100.0));
  EXPECT_EQ(walk.segments[0].end, at_s(110.0));
  EXPECT_NEAR(walk.segments[1].length_m, 7.0, 1e-9);
  EXPECT_NEAR(walk.segments[1].direction_rad, radians_from_degrees(-95), 1e-9);
  // sqrt(20 * 0.05^2 + (0.02 * 14)^2); hypot(0.032, 0.08 / sqrt(20)).
  EXPECT_NEAR(walk.segments[0].length_sigma_m, 0.3583, 1e-4);
  EXPECT_NEAR(walk.segments[0].direction_sigma_rad, 0.03667, 1e-5);
}

TEST(WalkFromMotion, AveragesDirectionsAcrossHalfATurn) {
  std::vector<MotionDelta> motion;
  for (int i = 0; i < 6; ++i) walk_on(motion, 1, i % 2 == 0 ? 176 : -178);
  const Walk walk = walk_of(motion);
  ASSERT_EQ(walk.segments.size(), 1U);
  EXPECT_NEAR(walk.segments[0].direction_rad, radians_from_degrees(179), 1e-9);
}

TEST(WalkFromMotion, LetsCorridorsMeetWhereACornerWasCut) {
  std::vector<MotionDelta> motion;
  walk_on(motion, 10, 0);
  walk_on(motion, 1, 30);
  walk_on(motion, 1, 60);
  walk_on(motion, 8, 90);
  const Walk walk = walk_of(motion);
  ASSERT_EQ(walk.segments.size(), 2U);
  // Both steps of the turn advance along either corridor.
  const double of_turn_m =
      0.7 * (std::cos(radians_from_degrees(30)) + std::cos(radians_from_degrees(60)));
  EXPECT_NEAR(walk.segments[0].length_m, 7.0 + of_turn_m, 1e-9);
  EXPECT_NEAR(walk.segments[1].length_m, 5.6 + of_turn_m, 1e-9);
  EXPECT_NEAR(walk.segments[1].direction_rad, radians_from_degrees(90), 1e-9);
}

TEST(WalkFromMotion, GoesOnStraightAfterADodge) {
  std::vector<MotionDelta> motion;
  walk_on(motion, 10, 0);
  walk_on(motion, 2, 40);
  walk_on(motion, 2, -40);
  walk_on(motion, 10, 0);
  const Walk walk = walk_of(motion);
  ASSERT_EQ(walk.segments.size(), 1U);
  EXPECT_NEAR(walk.segments[0].direction_rad, 0.0, 1e-9);
}

TEST(WalkFromMotion, NamesTheTurnThatAMarkIsNear) {
  std::vector<MotionDelta> motion;
  walk_on(motion, 20, 0);
  walk_on(motion, 20, 90);
  // A second late, two steps behind the corner; the last long after the walk.
  const Walk walk =
      walk_of(motion, {{at_s(99.0), "Door"}, {at_s(111.0), "Lift"}, {at_s(500.0), "Kiosk"}});
  ASSERT_EQ(walk.segments.size(), 2U);
  EXPECT_EQ(walk.landmark_at(0), "Door");
  EXPECT_EQ(walk.landmark_at(1), "Lift");
  EXPECT_EQ(walk.landmark_at(2), "Kiosk");
}

TEST(WalkFromMotion, SplitsACorridorAtAMark) {
  std::vector<MotionDelta> motion;
  walk_on(motion, 20, 10);
  const Walk walk = walk_of(motion, {{at_s(104.0), "Shop"}});
  ASSERT_EQ(walk.segments.size(), 2U);
  EXPECT_NEAR(walk.segments[0].length_m, 8 * 0.7, 1e-9);
  EXPECT_NEAR(walk.segments[1].length_m, 12 * 0.7, 1e-9);
  EXPECT_EQ(walk.landmark_at(1), "Shop");
}

TEST(WalkFromMotion, RefusesTwoMarksAtOneStep) {
  std::vector<MotionDelta> motion;
  walk_on(motion, 20, 10);
  const std::vector<LandmarkMark> marks = {{at_s(104.0), "Shop"}, {at_s(104.0), "Bar"}};
  EXPECT_EQ(walk_from_motion(motion, marks, {}).error().code, core::ErrorCode::kInvalidArgument);
}

TEST(WalkFromMotion, MakesNothingOfStandingAndLittleOfFewSteps) {
  EXPECT_TRUE(walk_of({}).segments.empty());
  EXPECT_TRUE(walk_of({}, {{at_s(1.0), "Door"}}).segments.empty());
  MotionDelta standing;
  standing.end = at_s(5.0);
  EXPECT_TRUE(walk_of({standing}).segments.empty());
  std::vector<MotionDelta> motion;
  walk_on(motion, 1, 45);
  const Walk walk = walk_of(motion);
  ASSERT_EQ(walk.segments.size(), 1U);
  EXPECT_NEAR(walk.segments[0].length_m, 0.7, 1e-12);
}

TEST(WalkFromMotion, RefusesWhatIsNoMotion) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<MotionDelta> motion;
  walk_on(motion, 5, 0);
  for (double MotionDelta::* const number :
       {&MotionDelta::length_m, &MotionDelta::heading_rad, &MotionDelta::length_sigma_m,
        &MotionDelta::heading_sigma_rad}) {
    std::vector<MotionDelta> bad = motion;
    bad[2].*number = nan;
    EXPECT_EQ(walk_from_motion(bad, {}, {}).error().code, core::ErrorCode::kInvalidArgument);
  }
  std::vector<MotionDelta> bad = motion;
  bad[2].length_m = -0.1;
  EXPECT_FALSE(walk_from_motion(bad, {}, {}));
  bad = motion;
  std::swap(bad[1], bad[3]);
  EXPECT_EQ(walk_from_motion(bad, {}, {}).error().code, core::ErrorCode::kInvalidArgument);
  SegmentationOptions options;
  options.largest_deviation_rad = nan;
  EXPECT_EQ(walk_from_motion(motion, {}, options).error().code, core::ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace waylode::structure
