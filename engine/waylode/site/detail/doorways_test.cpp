// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/doorways.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::site::detail {
namespace {

using core::Vector2;

const Wall kWall{Vector2(0, 1), Vector2(10, 1)};

void expect_near(const std::vector<Wall>& walls, const std::vector<Wall>& expected) {
  ASSERT_EQ(walls.size(), expected.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    EXPECT_LT((walls[i].from_m - expected[i].from_m).norm(), 1e-12) << i;
    EXPECT_LT((walls[i].to_m - expected[i].to_m).norm(), 1e-12) << i;
  }
}

TEST(Doorways, OpenTheWallByTheCirclesChord) {
  // Half chord of a circle of radius 1 that misses the wall by 0.6 m: 0.8 m.
  const std::vector<Door> doors = {{Vector2(4, 1.6), 2.0}};
  expect_near(without_doorways({&kWall, 1}, doors),
              {{Vector2(0, 1), Vector2(3.2, 1)}, {Vector2(4.8, 1), Vector2(10, 1)}});
}

TEST(Doorways, MayOverlapAndLieAtTheEnds) {
  const std::vector<Door> doors = {{Vector2(10, 1), 2.0},
                                   {Vector2(5, 1), 2.0},
                                   {Vector2(0, 1), 1.0},
                                   {Vector2(6, 1), 1.0},
                                   {Vector2(5, 1), 0.5}};
  expect_near(without_doorways({&kWall, 1}, doors),
              {{Vector2(0.5, 1), Vector2(4, 1)}, {Vector2(6.5, 1), Vector2(9, 1)}});
}

TEST(Doorways, MayTakeAWholeWall) {
  const std::vector<Door> doors = {{Vector2(5, 1), 10.0}};
  EXPECT_TRUE(without_doorways({&kWall, 1}, doors).empty());
}

TEST(Doorways, LeaveWallsAloneThatTheyDoNotMeet) {
  const double nan = std::nan("");
  const std::vector<Door> doors = {{Vector2(5, 2), 2.0},  // touches
                                   {Vector2(12, 1), 3.0}, {Vector2(5, 1), 0.0},
                                   {Vector2(5, 1), -1.0}, {Vector2(5, 1), nan},
                                   {Vector2(nan, 1), 1.0}};
  const std::vector<Wall> walls = {kWall, {Vector2(5, 1), Vector2(5, 1)}};
  EXPECT_EQ(without_doorways(walls, doors), walls);
  EXPECT_EQ(without_doorways(walls, {}), walls);
  EXPECT_TRUE(without_doorways({}, doors).empty());
}

RC_GTEST_PROP(Doorways, LeaveJustWhatLiesOutsideEveryCircle, ()) {
  const auto coordinate = [] { return 0.01 * *rc::gen::inRange(-1000, 1000); };
  const Wall wall{Vector2(coordinate(), coordinate()), Vector2(coordinate(), coordinate())};
  std::vector<Door> doors(static_cast<std::size_t>(*rc::gen::inRange(0, 5)));
  for (Door& door : doors) {
    door = {Vector2(coordinate(), coordinate()), 0.1 * *rc::gen::inRange(1, 80)};
  }
  const std::vector<Wall> rest = without_doorways({&wall, 1}, doors);
  const double length_m = (wall.to_m - wall.from_m).norm();
  RC_PRE(length_m > 0.1);
  for (int i = 0; i <= 200; ++i) {
    const Vector2 point_m = wall.from_m + (i / 200.0) * (wall.to_m - wall.from_m);
    double nearest_m = 1e9;  // to a circle's rim, from outside positive
    for (const Door& door : doors) {
      nearest_m = std::min(nearest_m, (point_m - door.position_m).norm() - 0.5 * door.width_m);
    }
    bool is_left = false;
    for (const Wall& part : rest) {
      const double past_m = (point_m - part.from_m).norm() + (point_m - part.to_m).norm();
      is_left = is_left || past_m - (part.to_m - part.from_m).norm() < 1e-9;
    }
    if (nearest_m < -1e-6) RC_ASSERT(!is_left);
    // Rests of less than a millimetre are gone: a point well clear of all rims is not in one.
    if (nearest_m > 2e-3) RC_ASSERT(is_left);
  }
}

}  // namespace
}  // namespace waylode::site::detail
