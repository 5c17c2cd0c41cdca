// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/displacement_segmenter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using core::kPi;
using core::radians_from_degrees;
using observation::MotionDelta;

MotionDelta step(int index, double length_m, double heading_deg) {
  MotionDelta delta;
  delta.begin = device_time_from_seconds(0.5 * index);
  delta.end = device_time_from_seconds(0.5 * (index + 1));
  delta.length_m = length_m;
  delta.heading_rad = core::wrap_angle(radians_from_degrees(heading_deg));
  return delta;
}

std::vector<Displacement> segments_of(const std::vector<MotionDelta>& steps) {
  DisplacementSegmenter segmenter({});
  std::vector<Displacement> segments;
  for (const MotionDelta& each : steps) {
    if (const auto done = segmenter.add(each)) segments.push_back(*done);
  }
  if (const auto rest = segmenter.finish()) segments.push_back(*rest);
  EXPECT_FALSE(segmenter.finish());
  return segments;
}

TEST(DisplacementSegmenter, AddsUpAStraightStretch) {
  const auto segments = segments_of({step(0, 0.6, 178), step(1, 0.7, -176), step(2, 0.8, 173)});
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_NEAR(segments[0].length_m, 2.1, 1e-12);
  // 178, 184, 173: their circular mean is nearly 178.33.
  EXPECT_NEAR(core::degrees_from_radians(segments[0].direction_rad), 178.333, 0.02);
  EXPECT_EQ(segments[0].begin, device_time_from_seconds(0.0));
  EXPECT_EQ(segments[0].end, device_time_from_seconds(1.5));
  EXPECT_EQ(segments[0].step_count, 3U);
}

TEST(DisplacementSegmenter, BeginsAnewBeyondTwentyDegrees) {
  const auto segments = segments_of({step(0, 0.7, 10), step(1, 0.7, 29.9), step(2, 0.7, 40.1)});
  // 29.9 is 19.9 from 10; 40.1 is 20.15 from their mean.
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].step_count, 2U);
  EXPECT_EQ(segments[1].begin, device_time_from_seconds(1.0));
}

TEST(DisplacementSegmenter, MeasuresTheCornersOfARoom) {
  std::vector<MotionDelta> steps;
  int index = 0;
  for (const auto& [count, heading_deg] :
       {std::pair{6, 0.0}, std::pair{4, 90.0}, std::pair{3, 180.0}, std::pair{4, 270.0}}) {
    for (int i = 0; i < count; ++i) steps.push_back(step(index++, 0.5, heading_deg + 25.0));
  }
  const auto segments = segments_of(steps);
  ASSERT_EQ(segments.size(), 4U);
  for (const double corner_rad : corner_angles_rad(segments)) {
    EXPECT_NEAR(corner_rad, kPi / 2.0, 1e-9);
  }
  const auto corners_m = polyline_m({1.0, -2.0}, segments);
  ASSERT_EQ(corners_m.size(), 5U);
  // East 3 - 1.5, north 2 - 2, all turned by 25 degrees.
  const core::Vector2 end_m(1.0 + 1.5 * std::cos(radians_from_degrees(25)),
                            -2.0 + 1.5 * std::sin(radians_from_degrees(25)));
  EXPECT_NEAR((corners_m.back() - end_m).norm(), 0.0, 1e-9);
}

TEST(DisplacementSegmenter, PassesOverStepsThatDoNotMove) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto segments = segments_of({step(0, 0.6, 0), step(1, 0.0, 90), step(2, nan, 90),
                                     step(3, 0.6, nan), step(4, -1.0, 90), step(5, 0.6, 3)});
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_NEAR(segments[0].length_m, 1.2, 1e-12);
  EXPECT_EQ(segments[0].end, device_time_from_seconds(3.0));
}

TEST(DisplacementSegmenter, HasNothingToTellOfNothing) {
  EXPECT_TRUE(segments_of({}).empty());
  EXPECT_TRUE(corner_angles_rad({}).empty());
  EXPECT_EQ(polyline_m({3.0, 4.0}, {}).size(), 1U);
}

RC_GTEST_PROP(DisplacementSegmenter, KeepsEveryStepOfAnyWalk, ()) {
  const auto headings = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-180, 180));
  std::vector<MotionDelta> steps;
  double length_m = 0.0;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const double step_m = 0.5 + 0.01 * static_cast<double>(i % 7);
    steps.push_back(step(static_cast<int>(i), step_m, headings[i]));
    length_m += step_m;
  }
  double told_m = 0.0;
  std::size_t count = 0;
  core::DeviceTime end = device_time_from_seconds(0.0);
  for (const Displacement& each : segments_of(steps)) {
    RC_ASSERT(each.begin == end);
    RC_ASSERT(each.direction_rad > -kPi - 1e-12 && each.direction_rad <= kPi);
    end = each.end;
    told_m += each.length_m;
    count += each.step_count;
  }
  RC_ASSERT(count == steps.size());
  RC_ASSERT(std::abs(told_m - length_m) < 1e-9);
}

TEST(DisplacementSegmenter, RefusesOptionsOutOfRange) {
  using Options = DisplacementSegmenter::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.tolerance_rad = 0.0}.validate());
  EXPECT_FALSE(Options{.tolerance_rad = 2.0}.validate());
  EXPECT_FALSE(Options{.tolerance_rad = std::numeric_limits<double>::quiet_NaN()}.validate());
}

}  // namespace
}  // namespace waylode::pdr
