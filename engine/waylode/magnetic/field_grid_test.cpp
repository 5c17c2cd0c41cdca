// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/field_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::magnetic {
namespace {

using core::FloorId;
using core::Vector2;
using site::MagneticPoint;

FieldGrid::Options options() { return {.node_m = 0.25, .reach_m = 1.0, .kernel_m = 0.5}; }

MagneticPoint point(float x_m, float y_m, float horizontal_ut, float vertical_ut,
                    std::uint16_t floor = 0) {
  return {x_m, y_m, horizontal_ut, vertical_ut, 0.5F, floor, 3};
}

/// Points every half metre of a 10 m square: H = 20 + 2 x, Z = -40 + 1.5 y.
std::vector<MagneticPoint> slope() {
  std::vector<MagneticPoint> points;
  for (int row = 0; row <= 20; ++row) {
    for (int column = 0; column <= 20; ++column) {
      const auto x_m = 0.5F * static_cast<float>(column);
      const auto y_m = 0.5F * static_cast<float>(row);
      points.push_back(point(x_m, y_m, 20.0F + 2.0F * x_m, -40.0F + 1.5F * y_m));
    }
  }
  return points;
}

TEST(FieldGrid, FollowsASlope) {
  const FieldGrid grid(slope(), options());
  for (const Vector2& place : {Vector2(3.0, 4.0), Vector2(5.13, 6.41), Vector2(2.37, 7.77)}) {
    const auto field = grid.at(place);
    ASSERT_TRUE(field);
    EXPECT_NEAR(field->horizontal_ut, 20.0 + 2.0 * place.x(), 0.1);
    EXPECT_NEAR(field->vertical_ut, -40.0 + 1.5 * place.y(), 0.1);
    // Root of 2^2 + 1.5^2.
    EXPECT_NEAR(grid.gradient_utpm(place).value(), 2.5, 0.2);
  }
}

TEST(FieldGrid, KnowsNothingAwayFromSurveyedGround) {
  const std::vector<MagneticPoint> points = {point(2.0F, 3.0F, 25.0F, -41.0F)};
  const FieldGrid grid(points, options());
  EXPECT_EQ(grid.at(Vector2(2.0, 3.0)), (LevelField{25.0, -41.0}));
  EXPECT_TRUE(grid.at(Vector2(2.6, 3.0)));
  EXPECT_FALSE(grid.at(Vector2(3.3, 3.0)));
  EXPECT_FALSE(grid.at(Vector2(2.0, 4.3)));
  EXPECT_FALSE(grid.at(Vector2(-50.0, 3.0)));
  EXPECT_FALSE(grid.gradient_utpm(Vector2(9.0, 3.0)));
}

TEST(FieldGrid, LeavesTheGapBetweenTwoWalksOpen) {
  const std::vector<MagneticPoint> points = {point(0.0F, 0.0F, 25.0F, -41.0F),
                                             point(6.0F, 0.0F, 35.0F, -30.0F)};
  const FieldGrid grid(points, options());
  EXPECT_FALSE(grid.at(Vector2(3.0, 0.0)));
  EXPECT_NEAR(grid.at(Vector2(5.8, 0.1))->horizontal_ut, 35.0, 1e-6);
}

TEST(FieldGrid, WeighsNearPointsMore) {
  const std::vector<MagneticPoint> points = {point(0.0F, 0.0F, 20.0F, -40.0F),
                                             point(1.0F, 0.0F, 30.0F, -44.0F)};
  const FieldGrid grid(points, options());
  EXPECT_NEAR(grid.at(Vector2(0.5, 0.0))->horizontal_ut, 25.0, 1e-6);
  // Weights exp(-1/8) at 0.25 m and exp(-9/8) at 0.75 m: share 1 / (1 + e) of the farther.
  EXPECT_NEAR(grid.at(Vector2(0.25, 0.0))->horizontal_ut, 20.0 + 10.0 / (1.0 + std::exp(1.0)),
              1e-4);
}

TEST(FieldGrid, HasNoSlopeInAFlatField) {
  std::vector<MagneticPoint> points = slope();
  for (MagneticPoint& each : points) each.horizontal_ut = each.vertical_ut = 30.0F;
  const FieldGrid grid(points, options());
  EXPECT_NEAR(grid.gradient_utpm(Vector2(4.0, 4.0)).value(), 0.0, 1e-6);
}

TEST(FieldGrid, TellsHowFarReadingsAtOnePlaceDiffer) {
  std::vector<MagneticPoint> points = {point(0.0F, 0.0F, 20.0F, -40.0F),
                                       point(3.0F, 0.0F, 20.0F, -40.0F),
                                       point(6.0F, 0.0F, 20.0F, -40.0F)};
  points[0].count = 5;
  points[0].sigma_ut = 2.0F;
  points[1].count = 9;
  points[1].sigma_ut = 4.0F;
  points[2].count = 2;  // Too few to tell.
  points[2].sigma_ut = 90.0F;
  // Sample variance: squares 5 * 4 + 9 * 16 over 4 + 8.
  EXPECT_NEAR(FieldGrid(points, options()).scatter_ut(), std::sqrt(164.0 / 12.0), 1e-6);
  EXPECT_EQ(FieldGrid({}, options()).scatter_ut(), 0.0);
}

TEST(FieldGrid, OfNothingKnowsNothing) {
  EXPECT_TRUE(FieldGrid{}.empty());
  EXPECT_FALSE(FieldGrid{}.at(Vector2::Zero()));
  EXPECT_FALSE(FieldGrid{}.gradient_utpm(Vector2::Zero()));
  EXPECT_TRUE(FieldGrid({}, options()).empty());
}

TEST(FieldGrid, KnowsNothingNowhere) {
  const FieldGrid grid(slope(), options());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(grid.at(Vector2(nan, 3.0)));
  EXPECT_FALSE(grid.at(Vector2(3.0, nan)));
  EXPECT_FALSE(grid.at(Vector2(infinity, 3.0)));
  EXPECT_FALSE(grid.at(Vector2(3.0, -infinity)));
  EXPECT_FALSE(grid.gradient_utpm(Vector2(nan, nan)));
}

TEST(FieldGrid, StaysSmallWherePointsLieFarApart) {
  // A bundle may say so; its numbers are finite.
  const float far_m = std::numeric_limits<float>::max();
  const std::vector<MagneticPoint> points = {point(-far_m, 0.0F, 20.0F, -40.0F),
                                             point(far_m, far_m, 30.0F, -40.0F)};
  const FieldGrid grid(points, options());
  EXPECT_FALSE(grid.empty());
  EXPECT_GT(grid.node_m(), 1e30);
}

TEST(FieldGrid, KeepsFloorsApart) {
  const std::vector<MagneticPoint> points = {point(1.0F, 1.0F, 20.0F, -40.0F, 0),
                                             point(1.0F, 1.0F, 33.0F, -44.0F, 2)};
  const std::vector<FieldGrid> grids = field_grids({points}, 3, options());
  ASSERT_EQ(grids.size(), 3U);
  EXPECT_NEAR(grids[0].at(Vector2(1.0, 1.0))->horizontal_ut, 20.0, 1e-6);
  EXPECT_TRUE(grids[1].empty());
  EXPECT_NEAR(grids[2].at(Vector2(1.0, 1.0))->horizontal_ut, 33.0, 1e-6);
}

TEST(FieldGrid, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(FieldGrid::Options{}.validate());
  const double nan = std::nan("");
  for (const FieldGrid::Options& bad :
       {FieldGrid::Options{0.01, 1.0, 0.5}, FieldGrid::Options{nan, 1.0, 0.5},
        FieldGrid::Options{0.5, 0.25, 0.5}, FieldGrid::Options{0.25, 1.0, 0.0},
        FieldGrid::Options{0.25, 1.0, nan}}) {
    const auto valid = bad.validate();
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::magnetic
