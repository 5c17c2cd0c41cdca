// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::survey {
namespace {

using core::FloorId;
using core::Vector2;

LabelledPath::Stretch stretch(double marked_m, double reckoned_m, double turn_rad) {
  LabelledPath::Stretch result;
  result.marked_m = marked_m;
  result.reckoned_m = reckoned_m;
  result.turn_rad = turn_rad;
  return result;
}

site::FingerprintRecord fingerprint(float x_m, float y_m) {
  site::FingerprintRecord record;
  record.x_m = x_m;
  record.y_m = y_m;
  return record;
}

site::Polygon rectangle(double left_m, double bottom_m, double right_m, double top_m) {
  return {{{left_m, bottom_m}, {right_m, bottom_m}, {right_m, top_m}, {left_m, top_m}}, {}};
}

TEST(HeadingOffset, NeedsTenStretchesThatTell) {
  std::vector<LabelledPath::Stretch> stretches(9, stretch(8.0, 7.5, 0.4));
  stretches.push_back(stretch(2.9, 7.5, 0.4));
  stretches.push_back(stretch(8.0, 2.9, 0.4));
  EXPECT_FALSE(heading_offset(stretches));
  stretches.push_back(stretch(8.0, 7.5, 0.4));
  ASSERT_TRUE(heading_offset(stretches));
  EXPECT_NEAR(*heading_offset(stretches), 0.4, 1e-9);
}

TEST(HeadingOffset, AveragesAcrossHalfATurn) {
  std::vector<LabelledPath::Stretch> stretches(6, stretch(8.0, 8.0, core::kPi - 0.1));
  stretches.insert(stretches.end(), 6, stretch(8.0, 8.0, -core::kPi + 0.1));
  ASSERT_TRUE(heading_offset(stretches));
  EXPECT_NEAR(std::abs(*heading_offset(stretches)), core::kPi, 1e-9);
}

TEST(HeadingOffset, IsHardlyMovedByAWalkWithThePhoneAskew) {
  std::vector<LabelledPath::Stretch> stretches(12, stretch(8.0, 8.0, 0.1));
  stretches.insert(stretches.end(), 4, stretch(8.0, 8.0, 1.6));
  // The plain mean would be off by atan2(4 sin 1.5, 12 + 4 cos 1.5) = 0.32 rad.
  EXPECT_NEAR(heading_offset(stretches).value(), 0.1, 0.02);
}

TEST(CoveredRatio, CountsRasterPointsOfTheSurveysBoxWithoutAPlan) {
  // Box 8 x 2 m, 9 x 3 raster points. Within 2 m of (0, 0): 3 + 2 + 1 of its corner (dx^2 + dy^2
  // <= 4), and as many of the opposite corner.
  const std::vector<site::FingerprintRecord> fingerprints = {fingerprint(0.0F, 0.0F),
                                                             fingerprint(8.0F, 2.0F)};
  EXPECT_NEAR(covered_ratio({}, fingerprints, 2.0), 12.0 / 27.0, 1e-12);
  EXPECT_EQ(covered_ratio({}, {}, 2.0), 0.0);
  EXPECT_EQ(covered_ratio({}, std::span(fingerprints).first(1), 2.0), 1.0);
}

TEST(CoveredRatio, CountsTheWalkableAreaOfAPlan) {
  site::Floor floor;
  floor.bounds = {{-5.5, -5.5}, {25.0, 15.0}};
  floor.plan.walkable = {rectangle(0.0, 0.0, 10.0, 4.0)};
  // The raster lies at half metres: 10 x 4 points inside. Within 3 m of (2.5, 2.5): of its own row
  // 0.5 to 5.5, of the rows 1 m and 2 m beside it 0.5 to 4.5.
  const std::vector<site::FingerprintRecord> fingerprints = {fingerprint(2.5F, 2.5F)};
  EXPECT_NEAR(covered_ratio(floor, fingerprints, 3.0), (6.0 + 5.0 + 5.0 + 5.0) / 40.0, 1e-12);
}

TEST(CoveredRatio, LeavesObstaclesOutOfTheArea) {
  site::Floor floor;
  floor.bounds = {{-5.5, -5.5}, {25.0, 15.0}};
  floor.plan.walkable = {rectangle(0.0, 0.0, 10.0, 4.0)};
  floor.plan.obstacles = {rectangle(5.0, 0.0, 10.0, 4.0)};
  // 5 x 4 points are left; (5.5, 2.5) is no more among the covered ones.
  const std::vector<site::FingerprintRecord> fingerprints = {fingerprint(2.5F, 2.5F)};
  EXPECT_EQ(covered_ratio(floor, fingerprints, 3.0), 1.0);
}

TEST(FloorQuality, AddsUpWhatEachFloorHolds) {
  site::SiteParts parts;
  parts.floors.resize(2);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "F2";
  parts.floors[0].heading_offset_rad = 0.3;
  site::RadioMapBuilder builder;
  const auto add = [&](std::uint16_t floor, float x_m, std::vector<std::uint64_t> transmitters) {
    site::FingerprintRecord record = fingerprint(x_m, 0.0F);
    record.floor = floor;
    std::vector<site::MapReading> readings;
    for (const auto number : transmitters) {
      readings.push_back({core::TransmitterId::wifi(number), -60.0F, 0.0F});
    }
    builder.add(record, std::move(readings));
  };
  add(0, 0.0F, {1, 2, 3});
  add(0, 1.0F, {1});
  add(0, 2.0F, {1, 2, 3, 4, 5});
  add(1, 0.0F, {5});
  parts.radio_map = builder.build();
  const std::vector<std::vector<LabelledPath::Stretch>> stretches = {
      {stretch(10.0, 8.0, 0.0), stretch(6.0, 6.0, 0.0), stretch(9.0, 6.0, 0.0),
       stretch(2.0, 0.1, 0.0)},
      {}};
  const auto quality = floor_quality(parts, stretches, {{0, 3}, {1}});
  ASSERT_EQ(quality.size(), 2U);
  EXPECT_EQ(quality[0].floor, "F1");
  EXPECT_EQ(quality[0].recordings, 2U);
  EXPECT_EQ(quality[0].fingerprints, 3U);
  EXPECT_EQ(quality[0].transmitters, 5U);
  EXPECT_EQ(quality[0].median_transmitters_per_fingerprint, 3.0);
  EXPECT_NEAR(quality[0].surveyed_m, 27.0, 1e-12);
  EXPECT_NEAR(quality[0].step_scale, 1.25, 1e-12);  // Of 1.25, 1 and 1.5; 2 m do not tell.
  EXPECT_EQ(quality[0].heading_offset_rad, 0.3);
  EXPECT_EQ(quality[0].covered_ratio, 1.0);
  EXPECT_EQ(quality[1].floor, "F2");
  EXPECT_EQ(quality[1].fingerprints, 1U);
  EXPECT_EQ(quality[1].transmitters, 1U);
  EXPECT_EQ(quality[1].surveyed_m, 0.0);
  EXPECT_EQ(quality[1].step_scale, 1.0);
}

}  // namespace
}  // namespace waylode::survey
