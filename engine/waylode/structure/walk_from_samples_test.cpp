// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/walk_from_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::structure {
namespace {

/// 12 s eastwards, a turn of 1 s, 12 s northwards at two steps a second that swing by 6 m/s2; the
/// phone lies flat in the hand.
std::vector<sample::Sample> corner_walk() {
  std::vector<sample::Sample> samples;
  for (int i = 0; i < 2500; ++i) {
    const double t_s = 0.01 * i;
    const core::DeviceTime time = core::device_time_from_seconds(50.0 + t_s);
    const double heading_rad = 0.5 * core::kPi * std::clamp(t_s - 12.0, 0.0, 1.0);
    const double rate_radps = t_s >= 12.0 && t_s < 13.0 ? 0.5 * core::kPi : 0.0;
    // The device's y axis points where the person goes.
    const Eigen::AngleAxisd turn(heading_rad - 0.5 * core::kPi, core::Vector3::UnitZ());
    samples.emplace_back(sample::RotationSample{time, core::Quaternion(turn)});
    samples.emplace_back(sample::GyroscopeSample{time, core::Vector3(0.0, 0.0, rate_radps)});
    const double swing_mps2 = 3.0 * std::sin(2.0 * core::kPi * 2.0 * t_s);
    samples.emplace_back(
        sample::AccelerometerSample{time, core::Vector3(0.0, 0.0, 9.80665 + swing_mps2)});
  }
  return samples;
}

TEST(WalkFromSamples, GivesTheSegmentsOfARecording) {
  const std::vector<LandmarkMark> marks = {{core::device_time_from_seconds(62.5), "Corner"}};
  const auto walk = walk_from_samples(corner_walk(), marks, {}, {});
  ASSERT_TRUE(walk) << core::to_string(walk.error());
  ASSERT_EQ(walk->segments.size(), 2U);
  EXPECT_EQ(walk->landmark_at(1), "Corner");
  EXPECT_NEAR(core::wrap_angle(walk->segments[1].direction_rad - walk->segments[0].direction_rad),
              0.5 * core::kPi, 0.1);
  // Equally long but for a step or two at the ends.
  EXPECT_NEAR(walk->segments[1].length_m / walk->segments[0].length_m, 1.0, 0.15);
  EXPECT_GT(walk->segments[0].length_m, 8.0);
}

TEST(WalkFromSamples, MakesNoWalkOfNothing) {
  const auto walk = walk_from_samples({}, {}, {}, {});
  ASSERT_TRUE(walk);
  EXPECT_TRUE(walk->segments.empty());
}

}  // namespace
}  // namespace waylode::structure
