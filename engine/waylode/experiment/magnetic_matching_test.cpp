// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/magnetic_matching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::experiment {
namespace {

using core::Vector2;
using core::Vector3;

constexpr double kSpeed_mps = 1.2;

/// 10 Hz along a corridor of 24 m; H and Z vary along it, the phone lies flat and faces ahead.
FieldWalk along(double y_m, bool back = false) {
  FieldWalk walk;
  walk.name = back ? "back" : "forth";
  const double heading_rad = back ? core::kPi : 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double walked_m = kSpeed_mps * 0.1 * i;
    const double x_m = back ? 24.0 - walked_m : walked_m;
    const double horizontal_ut = 25.0 + 8.0 * std::sin(0.9 * x_m);
    const double vertical_ut = -38.0 + 7.0 * std::cos(0.37 * x_m);
    walk.readings.push_back({core::device_time_from_ms(100 * i),
                             Vector3(0.0, horizontal_ut, vertical_ut), Vector3::UnitZ(),
                             heading_rad});
  }
  walk.stretches = {{Vector2(back ? 24.0 : 0.0, y_m), Vector2(back ? 0.0 : 24.0, y_m), 0, 200}};
  return walk;
}

MagneticMatchingOptions options() {
  MagneticMatchingOptions options;
  options.matcher.window_s = 5.0;
  options.speed_mps = kSpeed_mps;
  options.start_sigma_m = 0.7;
  return options;
}

TEST(FieldWalk, IsWalkedEvenly) {
  FieldWalk walk = along(2.0);
  walk.stretches = {{Vector2(1.0, 0.0), Vector2(5.0, 2.0), 10, 50}};
  EXPECT_FALSE(walk.truth_m(9));
  EXPECT_EQ(walk.truth_m(10), Vector2(1.0, 0.0));
  EXPECT_NEAR((*walk.truth_m(20) - Vector2(2.0, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_EQ(walk.truth_m(50), Vector2(5.0, 2.0));
  EXPECT_FALSE(walk.truth_m(51));
}

TEST(MagneticMatching, MeasuresHowFastPeopleWalk) {
  EXPECT_NEAR(mean_speed_mps({along(1.0), along(2.0, true)}), kSpeed_mps, 1e-9);
  EXPECT_EQ(mean_speed_mps({}), 0.0);
}

TEST(MagneticMatching, MapsTheFieldAlongTheStretches) {
  const auto map = map_of({along(2.0)}, {});
  ASSERT_GT(map.points.size(), 40U);
  for (const site::MagneticPoint& point : map.points) {
    EXPECT_NEAR(point.y_m, 2.0, 1e-5);
    const double x_m = point.x_m;
    // Averaged over up to half a metre.
    EXPECT_NEAR(point.horizontal_ut, 25.0 + 8.0 * std::sin(0.9 * x_m), 0.6);
    EXPECT_NEAR(point.vertical_ut, -38.0 + 7.0 * std::cos(0.37 * x_m), 0.3);
  }
}

TEST(MagneticMatching, FindsWalksOfEitherDirectionOnTheirMap) {
  const auto map = map_of({along(2.0)}, {});
  for (const bool chained : {false, true}) {
    MagneticMatchingOptions own = options();
    own.chained = chained;
    const auto result = match_walks({along(2.0), along(2.0, true)}, map.view(), own);
    ASSERT_EQ(result.errors_m.size(), 2U);
    // 20 s each, from 5 s on, about one a second.
    EXPECT_GE(result.tried, 24U);
    for (const Unit& errors_m : result.errors_m) {
      ASSERT_GT(errors_m.size(), 8U);
      // Along the corridor the field tells; across it, only that the map is 1.6 m wide.
      EXPECT_LT(mean_of(errors_m), 1.0);
    }
    EXPECT_LT(mean_of(result.squared_mahalanobis), 2.0);
  }
}

TEST(MagneticMatching, SearchesTheWholeMapWhenAsked) {
  const auto map = map_of({along(2.0)}, {});
  MagneticMatchingOptions global = options();
  global.global = true;
  const auto result = match_walks({along(2.0)}, map.view(), global);
  ASSERT_EQ(result.errors_m.size(), 1U);
  ASSERT_GT(result.errors_m[0].size(), 8U);
  EXPECT_LT(mean_of(result.errors_m[0]), 1.0);
}

TEST(MagneticMatching, SaysNothingWithoutAMap) {
  const auto result = match_walks({along(2.0)}, {}, options());
  EXPECT_GT(result.tried, 0U);
  ASSERT_EQ(result.errors_m.size(), 1U);
  EXPECT_TRUE(result.errors_m[0].empty());
  EXPECT_TRUE(match_walks({}, {}, options()).errors_m.empty());
}

}  // namespace
}  // namespace waylode::experiment
