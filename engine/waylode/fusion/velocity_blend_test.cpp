// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/velocity_blend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::fusion {
namespace {

using core::kPi;

VelocityBlend::Options options() {
  VelocityBlend::Options result;
  result.speed = {0.3, 0.1, 0.6};
  result.heading = {0.2, 0.1, 0.7};
  result.turn_rad = 0.6;
  result.fastest_mps = 2.0;
  result.slowest_mps = 0.2;
  return result;
}

TEST(VelocityBlend, WeighsSpeedsAndHeadings) {
  const PolarVelocity blended = VelocityBlend(options()).blend({1.0, 0.2}, {1.5, -0.1}, {1.2, 0.4});
  EXPECT_NEAR(blended.speed_mps, 0.3 + 0.15 + 0.72, 1e-12);
  const double sine = 0.2 * std::sin(0.2) + 0.1 * std::sin(-0.1) + 0.7 * std::sin(0.4);
  const double cosine = 0.2 * std::cos(0.2) + 0.1 * std::cos(-0.1) + 0.7 * std::cos(0.4);
  EXPECT_NEAR(blended.heading_rad, std::atan2(sine, cosine), 1e-12);
}

TEST(VelocityBlend, AveragesHeadingsAcrossTheSeam) {
  // 10 and 20 degrees to either side of west: a plain mean would point east.
  const PolarVelocity blended =
      VelocityBlend(options()).blend({1.0, kPi - 0.1}, {1.0, kPi - 0.1}, {1.0, -kPi + 0.2});
  const double off_rad = std::atan2(0.3 * std::sin(-0.1) + 0.7 * std::sin(0.2),
                                    0.3 * std::cos(-0.1) + 0.7 * std::cos(0.2));
  EXPECT_NEAR(core::wrap_angle(blended.heading_rad - kPi), off_rad, 1e-12);
}

TEST(VelocityBlend, FollowsTheSensorsAloneInATurn) {
  const VelocityBlend blend(options());
  const PolarVelocity about = blend.blend({1.3, 0.1}, {1.3, 0.1}, {0.7, 0.1 + kPi});
  EXPECT_NEAR(about.speed_mps, 0.7, 1e-12);
  EXPECT_NEAR(core::wrap_angle(about.heading_rad - 0.1 - kPi), 0.0, 1e-12);
  EXPECT_TRUE(blend.is_turn({1.0, 3.0}, {1.0, -2.6}));   // 0.68 rad over the seam.
  EXPECT_FALSE(blend.is_turn({1.0, 3.0}, {1.0, -2.8}));  // 0.48 rad.
}

TEST(VelocityBlend, TakesNoDirectionFromPointsThatHardlyMoved) {
  const PolarVelocity blended = VelocityBlend(options()).blend({1.0, 0.3}, {0.1, -2.0}, {1.0, 0.3});
  EXPECT_NEAR(blended.heading_rad, 0.3, 1e-12);
  EXPECT_NEAR(blended.speed_mps, 0.91, 1e-12);
}

TEST(VelocityBlend, CapsTheSpeedOfPointsThatJumped) {
  EXPECT_NEAR(VelocityBlend(options()).blend({1.0, 0.0}, {40.0, 0.0}, {1.0, 0.0}).speed_mps,
              0.3 + 0.2 + 0.6, 1e-12);
}

TEST(VelocityBlend, MovesByItsVelocity) {
  const core::Vector2 place_m =
      moved_m({1.0, 2.0}, {1.5, kPi / 6.0}, std::chrono::milliseconds(800));
  EXPECT_NEAR(place_m.x(), 1.0 + 1.2 * std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(place_m.y(), 2.6, 1e-12);
}

TEST(VelocityBlend, RejectsSharesThatDoNotSumToOne) {
  EXPECT_TRUE(VelocityBlend::Options{}.validate());
  EXPECT_TRUE(options().validate());
  for (const VelocityBlend::Shares& bad :
       {VelocityBlend::Shares{0.3, 0.3, 0.3}, VelocityBlend::Shares{-0.1, 0.5, 0.6},
        VelocityBlend::Shares{std::nan(""), 0.5, 0.5}}) {
    auto wrong = options();
    wrong.speed = bad;
    EXPECT_FALSE(wrong.validate());
    wrong = options();
    wrong.heading = bad;
    EXPECT_FALSE(wrong.validate());
  }
  for (double VelocityBlend::Options::* member :
       {&VelocityBlend::Options::turn_rad, &VelocityBlend::Options::fastest_mps}) {
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
      auto wrong = options();
      wrong.*member = bad;
      EXPECT_FALSE(wrong.validate());
    }
  }
}

}  // namespace
}  // namespace waylode::fusion
