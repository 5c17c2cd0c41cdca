// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/labelled_path.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::survey {
namespace {

using core::device_time_from_seconds;
using core::FloorId;
using core::kPi;
using core::Vector2;
using observation::MotionDelta;

constexpr LabelledPath::Options kOptions{.widest_scale = 2.0,
                                         .shortest_shaped_m = 1.5,
                                         .fastest_mps = 2.5,
                                         .longest_gap_s = 120.0,
                                         .mark_sigma_m = 0.7,
                                         .drift_sigma_ratio = 0.08};
constexpr double kStep_s = 0.5;

PlacedWaypoint mark(double time_s, double x_m, double y_m, std::uint16_t floor = 0) {
  return {device_time_from_seconds(time_s), FloorId{floor}, {x_m, y_m}};
}

/// `count` steps of one length and heading, half a second each, after those already there.
void walk(std::vector<MotionDelta>& steps, int count, double length_m, double heading_rad,
          double begin_s = 0.0) {
  for (int i = 0; i < count; ++i) {
    MotionDelta step;
    step.begin = steps.empty() ? device_time_from_seconds(begin_s) : steps.back().end;
    step.end = step.begin + core::from_seconds(kStep_s);
    step.length_m = length_m;
    step.heading_rad = heading_rad;
    steps.push_back(step);
  }
}

std::optional<Vector2> place(const LabelledPath& path, double time_s) {
  const auto label = path.at(device_time_from_seconds(time_s));
  return label ? std::optional(label->position_m) : std::nullopt;
}

#define EXPECT_PLACE(path, time_s, x_m, y_m)                    \
  do {                                                          \
    const auto found = place(path, time_s);                     \
    ASSERT_TRUE(found) << "at " << (time_s);                    \
    EXPECT_NEAR((*found - Vector2(x_m, y_m)).norm(), 0.0, 1e-9) \
        << "at " << (time_s) << ": " << found->transpose();     \
  } while (false)

TEST(LabelledPath, IsLinearAlongAnEvenStraightWalk) {
  std::vector<MotionDelta> steps;
  walk(steps, 20, 0.7, 0.3);
  // 14 m by steps; 15 m by the marks, straight north.
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 3.0, -2.0, 4), mark(10.0, 3.0, 13.0, 4)};
  const LabelledPath path(kOptions, marks, steps);
  for (const double time_s : {0.0, 0.2, 3.3, 5.0, 9.9, 10.0}) {
    EXPECT_PLACE(path, time_s, 3.0, -2.0 + 1.5 * time_s);
    EXPECT_EQ(path.at(device_time_from_seconds(time_s))->floor, FloorId{4});
  }
  ASSERT_EQ(path.stretches().size(), 1U);
  const auto& stretch = path.stretches()[0];
  EXPECT_EQ(stretch.floor, FloorId{4});
  EXPECT_TRUE(stretch.shaped);
  EXPECT_FALSE(stretch.rejected);
  EXPECT_NEAR(stretch.marked_m, 15.0, 1e-12);
  EXPECT_NEAR(stretch.reckoned_m, 14.0, 1e-9);
  EXPECT_NEAR(stretch.turn_rad, kPi / 2.0 - 0.3, 1e-9);
}

TEST(LabelledPath, KeepsAnElTurnedAndScaled) {
  std::vector<MotionDelta> steps;
  walk(steps, 10, 0.5, 0.0);
  walk(steps, 10, 0.5, kPi / 2.0);
  // By steps 5 m east, then 5 m north; the marks say 1.5 times that, a quarter turn clockwise.
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 1.0, 2.0), mark(10.0, 8.5, -5.5)};
  const LabelledPath path(kOptions, marks, steps);
  EXPECT_PLACE(path, 0.0, 1.0, 2.0);
  EXPECT_PLACE(path, 2.0, 1.0, -1.0);
  EXPECT_PLACE(path, 5.0, 1.0, -5.5);
  EXPECT_PLACE(path, 9.0, 7.0, -5.5);
  EXPECT_PLACE(path, 10.0, 8.5, -5.5);
}

TEST(LabelledPath, MeetsEveryMark) {
  std::vector<MotionDelta> steps;
  walk(steps, 13, 0.6, 0.4);
  walk(steps, 9, 0.7, -1.0);
  walk(steps, 18, 0.65, 2.0);
  const std::vector<PlacedWaypoint> marks = {mark(0.3, 0.0, 0.0), mark(6.1, 6.0, 3.0),
                                             mark(12.9, 7.0, -1.0), mark(19.8, 2.0, 5.0)};
  const LabelledPath path(kOptions, marks, steps);
  for (const PlacedWaypoint& waypoint : marks) {
    const auto label = path.at(waypoint.time);
    ASSERT_TRUE(label);
    EXPECT_LT((label->position_m - waypoint.position_m).norm(), 1e-9);
    EXPECT_NEAR(label->sigma_m, 0.7, 1e-9);
  }
}

TEST(LabelledPath, IsLessSureFarFromMarks) {
  std::vector<MotionDelta> steps;
  walk(steps, 20, 0.7, 0.0);
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 0.0, 0.0), mark(10.0, 14.0, 0.0)};
  const LabelledPath path(kOptions, marks, steps);
  // In the middle 7 m from either mark, at 8 s 2.8 m from the nearer one.
  EXPECT_NEAR(path.at(device_time_from_seconds(5.0))->sigma_m, std::hypot(0.7, 0.08 * 7.0), 1e-9);
  EXPECT_NEAR(path.at(device_time_from_seconds(8.0))->sigma_m, std::hypot(0.7, 0.08 * 2.8), 1e-9);
}

TEST(LabelledPath, GoesStraightByTimeWithoutSteps) {
  const std::vector<PlacedWaypoint> marks = {mark(10.0, 0.0, 0.0), mark(20.0, 6.0, -8.0)};
  const LabelledPath path(kOptions, marks, {});
  EXPECT_PLACE(path, 12.5, 1.5, -2.0);
  EXPECT_PLACE(path, 20.0, 6.0, -8.0);
  EXPECT_FALSE(path.stretches()[0].shaped);
}

TEST(LabelledPath, GoesStraightByShareOfStepsWhereTheyDoNotFit) {
  // Ten steps back and forth after five seconds of standing: no shape of 8 m.
  std::vector<MotionDelta> steps;
  walk(steps, 5, 0.8, 0.0, 5.0);
  walk(steps, 5, 0.8, kPi);
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 0.0, 0.0), mark(10.0, 8.0, 0.0)};
  const LabelledPath path(kOptions, marks, steps);
  EXPECT_FALSE(path.stretches()[0].shaped);
  EXPECT_PLACE(path, 4.9, 0.0, 0.0);
  EXPECT_PLACE(path, 6.0, 1.6, 0.0);
  EXPECT_PLACE(path, 9.0, 6.4, 0.0);
}

TEST(LabelledPath, TakesNoShapeFromMarksCloseTogether) {
  std::vector<MotionDelta> steps;
  walk(steps, 2, 0.6, 1.0);
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 0.0, 0.0), mark(1.0, 1.4, 0.0)};
  const LabelledPath path(kOptions, marks, steps);
  EXPECT_FALSE(path.stretches()[0].shaped);
  EXPECT_PLACE(path, 0.5, 0.7, 0.0);
}

TEST(LabelledPath, UsesShapeOnlyWithinTheWidestScale) {
  for (const auto& [marked_m, shaped] : {std::pair(3.4, false), std::pair(3.6, true),
                                         std::pair(13.9, true), std::pair(14.1, false)}) {
    std::vector<MotionDelta> steps;
    walk(steps, 10, 0.7, 0.0);
    const std::vector<PlacedWaypoint> marks = {mark(0.0, 0.0, 0.0), mark(8.0, marked_m, 0.0)};
    EXPECT_EQ(LabelledPath(kOptions, marks, steps).stretches()[0].shaped, shaped) << marked_m;
  }
}

TEST(LabelledPath, RejectsStretchesThatCannotBe) {
  const auto rejected = [](const PlacedWaypoint& from, const PlacedWaypoint& to) {
    const std::vector<PlacedWaypoint> marks = {from, to};
    const LabelledPath path(kOptions, marks, {});
    const bool labelled = path.at(from.time + (to.time - from.time) / 2).has_value();
    EXPECT_EQ(labelled, !path.stretches()[0].rejected);
    return !labelled;
  };
  EXPECT_FALSE(rejected(mark(0.0, 0.0, 0.0), mark(10.0, 24.9, 0.0)));
  EXPECT_TRUE(rejected(mark(0.0, 0.0, 0.0), mark(10.0, 25.1, 0.0)));  // Faster than 2.5 m/s.
  EXPECT_FALSE(rejected(mark(0.0, 0.0, 0.0), mark(120.0, 24.9, 0.0)));
  EXPECT_TRUE(rejected(mark(0.0, 0.0, 0.0), mark(120.1, 24.9, 0.0)));
  EXPECT_TRUE(rejected(mark(0.0, 0.0, 0.0, 1), mark(10.0, 5.0, 0.0, 2)));
  EXPECT_TRUE(rejected(mark(5.0, 0.0, 0.0), mark(5.0, 0.0, 0.0)));
}

TEST(LabelledPath, GoesOnAfterARejectedStretch) {
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 0.0, 0.0, 0), mark(10.0, 10.0, 0.0, 0),
                                             mark(20.0, 3.0, 0.0, 1), mark(30.0, 3.0, 10.0, 1)};
  const LabelledPath path(kOptions, marks, {});
  EXPECT_PLACE(path, 5.0, 5.0, 0.0);
  EXPECT_FALSE(place(path, 15.0));
  EXPECT_PLACE(path, 25.0, 3.0, 5.0);
}

TEST(LabelledPath, LabelsNothingOutsideTheMarks) {
  const std::vector<PlacedWaypoint> marks = {mark(10.0, 0.0, 0.0), mark(20.0, 6.0, -8.0)};
  const LabelledPath path(kOptions, marks, {});
  EXPECT_FALSE(place(path, 9.999));
  EXPECT_FALSE(place(path, 20.001));
  EXPECT_FALSE(place(LabelledPath(kOptions, std::span(marks).first(1), {}), 10.0));
  EXPECT_FALSE(place(LabelledPath(kOptions, {}, {}), 10.0));
}

RC_GTEST_PROP(LabelledPath, DoesNotDependOnTheFrameOfDeadReckoning, ()) {
  std::vector<MotionDelta> steps;
  const int legs = *rc::gen::inRange(1, 5);
  for (int i = 0; i < legs; ++i) {
    walk(steps, 5, 0.01 * *rc::gen::inRange(40, 90), 0.01 * *rc::gen::inRange(-60, 60));
  }
  const double end_s = 2.5 * legs;
  const std::vector<PlacedWaypoint> marks = {mark(0.0, 1.0, 2.0), mark(end_s, 1.0, 2.0 + end_s)};
  LabelledPath::Options options = kOptions;
  options.widest_scale = 10.0;  // So that no stretch is at the verge of its shape.
  const LabelledPath path(options, marks, steps);
  RC_ASSERT(path.stretches()[0].shaped);

  const double turn_rad = 0.01 * *rc::gen::inRange(-314, 314);
  const double scale = 0.01 * *rc::gen::inRange(60, 160);
  for (MotionDelta& step : steps) {
    step.heading_rad = core::wrap_angle(step.heading_rad + turn_rad);
    step.length_m *= scale;
  }
  const LabelledPath changed(options, marks, steps);
  for (double time_s = 0.0; time_s < end_s; time_s += 0.37) {
    RC_ASSERT((*place(path, time_s) - *place(changed, time_s)).norm() < 1e-9);
  }
}

TEST(LabelledPath, RefusesOptionsOutOfRange) {
  using Options = LabelledPath::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.widest_scale = value}.validate());
    EXPECT_FALSE(Options{.shortest_shaped_m = value}.validate());
    EXPECT_FALSE(Options{.fastest_mps = value}.validate());
    EXPECT_FALSE(Options{.longest_gap_s = value}.validate());
    EXPECT_FALSE(Options{.mark_sigma_m = value}.validate());
    EXPECT_FALSE(Options{.drift_sigma_ratio = value}.validate());
  }
  EXPECT_FALSE(Options{.widest_scale = 1.0}.validate());
}

}  // namespace
}  // namespace waylode::survey
