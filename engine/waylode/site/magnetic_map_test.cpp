// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/magnetic_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::site {
namespace {

using core::FloorId;
using core::Vector2;

MagneticMapBuilder half_metre_cells() { return MagneticMapBuilder({.cell_m = 0.5}); }

TEST(MagneticMap, AveragesTheReadingsOfACell) {
  MagneticMapBuilder builder = half_metre_cells();
  builder.add(FloorId{0}, Vector2(1.1, 2.1), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(1.3, 2.3), 26.0, -48.0);
  const MagneticMapStorage storage = builder.build();
  ASSERT_EQ(storage.points.size(), 1U);
  const MagneticPoint& point = storage.points[0];
  EXPECT_FLOAT_EQ(point.x_m, 1.2F);
  EXPECT_FLOAT_EQ(point.y_m, 2.2F);
  EXPECT_FLOAT_EQ(point.horizontal_ut, 23.0F);
  EXPECT_FLOAT_EQ(point.vertical_ut, -44.0F);
  // Variances 9 and 16 of the two parts.
  EXPECT_NEAR(point.sigma_ut, std::sqrt(12.5), 1e-5);
  EXPECT_EQ(point.count, 2U);
}

TEST(MagneticMap, OfOneReadingHasNoScatter) {
  MagneticMapBuilder builder = half_metre_cells();
  builder.add(FloorId{3}, Vector2(-7.3, 0.2), 31.7, 5.3);
  EXPECT_EQ(builder.build().points.at(0), (MagneticPoint{-7.3F, 0.2F, 31.7F, 5.3F, 0.0F, 3, 1}));
}

TEST(MagneticMap, KeepsTheCellsOnBothSidesOfZeroApart) {
  MagneticMapBuilder builder = half_metre_cells();
  builder.add(FloorId{0}, Vector2(0.1, 0.1), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(-0.1, 0.1), 30.0, -40.0);
  EXPECT_EQ(builder.build().points.size(), 2U);
}

TEST(MagneticMap, ListsFloorsApartAndInOrder) {
  MagneticMapBuilder builder = half_metre_cells();
  builder.add(FloorId{2}, Vector2(1.0, 1.0), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(9.0, 1.0), 21.0, -41.0);
  builder.add(FloorId{2}, Vector2(5.0, 1.0), 22.0, -42.0);
  const MagneticMapStorage storage = builder.build();
  const MagneticMap map = storage.view();
  ASSERT_EQ(map.on_floor(FloorId{0}).size(), 1U);
  EXPECT_EQ(map.on_floor(FloorId{0})[0].horizontal_ut, 21.0F);
  EXPECT_EQ(map.on_floor(FloorId{2}).size(), 2U);
  EXPECT_TRUE(map.on_floor(FloorId{1}).empty());
  EXPECT_TRUE(map.on_floor(FloorId{7}).empty());
}

TEST(MagneticMap, OfNothingIsEmpty) {
  EXPECT_TRUE(half_metre_cells().build().view().empty());
  EXPECT_TRUE(MagneticMap{}.on_floor(FloorId{0}).empty());
}

TEST(MagneticMap, PassesOverWhatIsNoReading) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  MagneticMapBuilder builder = half_metre_cells();
  builder.add(FloorId{0}, Vector2(nan, 1.0), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(1.0, nan), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(1.0, -infinity), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(1.0, 1e9), 20.0, -40.0);
  builder.add(FloorId{0}, Vector2(1.0, 1.0), nan, -40.0);
  builder.add(FloorId{0}, Vector2(1.0, 1.0), 20.0, infinity);
  builder.add(FloorId{0}, Vector2(1.0, 1.0), -0.1, -40.0);
  EXPECT_TRUE(builder.build().points.empty());
}

TEST(MagneticMap, CountsUpToWhatFits) {
  MagneticMapBuilder builder = half_metre_cells();
  for (int i = 0; i < 70'000; ++i) builder.add(FloorId{0}, Vector2(0.2, 0.2), 24.0, -41.0);
  const MagneticPoint point = builder.build().points.at(0);
  EXPECT_EQ(point.count, 65'535U);
  EXPECT_EQ(point.horizontal_ut, 24.0F);
  EXPECT_EQ(point.sigma_ut, 0.0F);
}

TEST(MagneticMap, RefusesCellsThatAreNone) {
  EXPECT_TRUE(MagneticMapBuilder::Options{}.validate());
  for (const double cell_m : {0.0, -1.0, 0.01, std::nan("")}) {
    const auto valid = MagneticMapBuilder::Options{.cell_m = cell_m}.validate();
    ASSERT_FALSE(valid) << cell_m;
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
  }
}

RC_GTEST_PROP(MagneticMapProperty, CountsEveryReadingOnceAndStaysWithinItsCell, ()) {
  MagneticMapBuilder builder = half_metre_cells();
  const auto places = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(-90, 90), rc::gen::inRange(-90, 90)));
  for (const auto& [x, y] : places) {
    builder.add(FloorId{1}, Vector2(0.09 * x, 0.07 * y), 25.0 + 0.1 * x, -40.0);
  }
  std::size_t total = 0;
  for (const MagneticPoint& point : builder.build().points) {
    total += point.count;
    RC_ASSERT(point.sigma_ut <= 0.5F);  // Half a metre is 0.6 uT wide here.
    RC_ASSERT(std::abs(point.horizontal_ut - (25.0F + point.x_m / 0.9F)) < 1e-3F);
  }
  RC_ASSERT(total == places.size());
}

}  // namespace
}  // namespace waylode::site
