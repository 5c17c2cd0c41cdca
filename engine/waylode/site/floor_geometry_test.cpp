// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/floor_geometry.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "test_support.hpp"
#include "waylode/core/file.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/site/plan_geojson.hpp"

namespace waylode::site {
namespace {

using core::Vector2;

/// A hall of 20 m x 10 m with a pillar hole, an obstacle at its right end and one wall.
Plan hall() {
  Plan plan;
  plan.walkable = {{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{{5, 4}, {5, 6}, {7, 6}, {7, 4}}}}};
  plan.obstacles = {{{{15, 2}, {20, 2}, {20, 8}, {15, 8}}, {}}};
  plan.walls = {{Vector2(10, 0), Vector2(10, 6)}};
  return plan;
}

TEST(FloorGeometry, DoorsAreOpen) {
  Plan plan;
  plan.walls = {{Vector2(3, 0), Vector2(3, 12)}};
  plan.doors = {{Vector2(3, 6), 1.5}};
  const FloorGeometry geometry(plan);
  EXPECT_FALSE(geometry.crosses_wall({2, 6.7}, {4, 6.7}));
  EXPECT_TRUE(geometry.crosses_wall({2, 6.8}, {4, 6.8}));
}

TEST(FloorGeometry, KnowsWherePeopleCanBe) {
  const FloorGeometry geometry(hall());
  EXPECT_TRUE(geometry.is_walkable(Vector2(1, 1)));
  EXPECT_TRUE(geometry.is_walkable(Vector2(17, 9)));
  EXPECT_FALSE(geometry.is_walkable(Vector2(6, 5)));    // in the hole
  EXPECT_FALSE(geometry.is_walkable(Vector2(17, 5)));   // in the obstacle
  EXPECT_FALSE(geometry.is_walkable(Vector2(-1, 5)));   // outside
  EXPECT_FALSE(geometry.is_walkable(Vector2(21, 11)));  // outside
  EXPECT_TRUE(geometry.is_walkable(Vector2(0, 0)));     // left and lower edges belong to it
  EXPECT_FALSE(geometry.is_walkable(Vector2(3, 10)));   // the upper one does not
}

TEST(FloorGeometry, WithoutAPlanLetsPeopleBeAnywhere) {
  const FloorGeometry geometry(Plan{});
  EXPECT_FALSE(geometry.has_walls());
  EXPECT_TRUE(geometry.is_walkable(Vector2(-1e6, 1e6)));
  EXPECT_FALSE(geometry.crosses_wall(Vector2(-1e6, 0), Vector2(1e6, 3)));
  EXPECT_EQ(geometry.nearest_walkable(Vector2(3, 4), 1.0), Vector2(3, 4));
}

TEST(FloorGeometry, StopsAtWallsAndObstacles) {
  const FloorGeometry geometry(hall());
  EXPECT_TRUE(geometry.has_walls());
  EXPECT_TRUE(geometry.crosses_wall(Vector2(9, 3), Vector2(11, 4)));
  EXPECT_TRUE(geometry.crosses_wall(Vector2(11, 4), Vector2(9, 3)));
  EXPECT_FALSE(geometry.crosses_wall(Vector2(9, 7), Vector2(11, 7)));  // past the wall's end
  EXPECT_TRUE(geometry.crosses_wall(Vector2(14, 5), Vector2(16, 5)));  // into the obstacle
  EXPECT_FALSE(geometry.crosses_wall(Vector2(-1, 5), Vector2(1, 5)));  // a walkable area's edge
  EXPECT_TRUE(geometry.crosses_wall(Vector2(-100, 3), Vector2(100, 3)));
  EXPECT_FALSE(geometry.crosses_wall(Vector2(100, 300), Vector2(120, 310)));
}

TEST(FloorGeometry, TreatsTouchingAsStated) {
  const FloorGeometry geometry(hall());
  // The wall runs up along x = 10: its left side, with the line, is x <= 10.
  EXPECT_FALSE(geometry.crosses_wall(Vector2(9, 3), Vector2(10, 3)));
  EXPECT_TRUE(geometry.crosses_wall(Vector2(10, 3), Vector2(11, 3)));
  EXPECT_FALSE(geometry.crosses_wall(Vector2(10, 1), Vector2(10, 5)));  // along it
  EXPECT_FALSE(geometry.crosses_wall(Vector2(10, 3), Vector2(10, 3)));  // standing on it
  EXPECT_TRUE(geometry.crosses_wall(Vector2(9, 6), Vector2(11, 6)));    // through its end
}

TEST(FloorGeometry, FindsTheWayBackToWalkableGround) {
  const FloorGeometry geometry(hall());
  // The obstacle's left edge is 1 m away from (16, 5), its upper and lower ones 3 m.
  const auto near = geometry.nearest_walkable(Vector2(16, 5), 10.0);
  ASSERT_TRUE(near);
  EXPECT_TRUE(geometry.is_walkable(*near));
  EXPECT_GE((*near - Vector2(16, 5)).norm(), 1.0);
  EXPECT_LT((*near - Vector2(16, 5)).norm(), 1.36);
  EXPECT_FALSE(geometry.nearest_walkable(Vector2(16, 5), 0.9));
  const auto outside = geometry.nearest_walkable(Vector2(-3, -4), 10.0);
  ASSERT_TRUE(outside);
  EXPECT_GE((*outside - Vector2(-3, -4)).norm(), 5.0);
  EXPECT_LT((*outside - Vector2(-3, -4)).norm(), 5.36);
}

using Integers = std::array<std::int64_t, 4>;  // x, y of both ends

std::int64_t exact_turn(const Integers& line, std::int64_t x, std::int64_t y) {
  return (line[2] - line[0]) * (y - line[1]) - (line[3] - line[1]) * (x - line[0]);
}

/// The stated rule in exact integers.
bool exactly_crosses(const Integers& wall, const Integers& way) {
  if ((exact_turn(wall, way[0], way[1]) >= 0) == (exact_turn(wall, way[2], way[3]) >= 0)) {
    return false;
  }
  const std::int64_t a = exact_turn(way, wall[0], wall[1]);
  const std::int64_t b = exact_turn(way, wall[2], wall[3]);
  return (a <= 0 && b >= 0) || (a >= 0 && b <= 0);
}

Integers any_segment(int reach) {
  Integers segment{};
  for (auto& value : segment) value = *rc::gen::inRange(-reach, reach + 1);
  return segment;
}

RC_GTEST_PROP(FloorGeometryProperty, AgreesWithEveryWallTriedInTurn, ()) {
  const int reach = *rc::gen::element(4, 30, 2000);  // many coincidences to few
  Plan plan;
  std::vector<Integers> walls;
  const int count = *rc::gen::inRange(0, 25);
  for (int i = 0; i < count; ++i) {
    const Integers wall = any_segment(reach);
    if (wall[0] == wall[2] && wall[1] == wall[3]) continue;
    const auto reversed = Integers{wall[2], wall[3], wall[0], wall[1]};
    // A wall drawn twice in both directions is kept in the first.
    if (std::ranges::find(walls, reversed) != walls.end()) continue;
    walls.push_back(wall);
    plan.walls.push_back({Vector2(static_cast<double>(wall[0]), static_cast<double>(wall[1])),
                          Vector2(static_cast<double>(wall[2]), static_cast<double>(wall[3]))});
  }
  const FloorGeometry geometry(plan);
  for (int i = 0; i < 20; ++i) {
    const Integers way = any_segment(reach + 3);
    const bool expected = std::ranges::any_of(
        walls, [&](const Integers& wall) { return exactly_crosses(wall, way); });
    RC_ASSERT(geometry.crosses_wall(
                  Vector2(static_cast<double>(way[0]), static_cast<double>(way[1])),
                  Vector2(static_cast<double>(way[2]), static_cast<double>(way[3]))) == expected);
  }
}

/// Whether the point is in a convex counter-clockwise ring: left of every edge.
bool in_convex(const Ring& ring, const Vector2& point) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2 edge = ring[(i + 1) % ring.size()] - ring[i];
    const Vector2 offset = point - ring[i];
    if (edge.x() * offset.y() - edge.y() * offset.x() < 0.0) return false;
  }
  return true;
}

TEST(FloorGeometry, AgreesWithHalfPlanesOnManyTriangles) {
  core::Rng rng(20);
  Plan plan;
  for (int i = 0; i < 40; ++i) {
    Ring ring;
    for (int k = 0; k < 3; ++k) ring.emplace_back(rng.uniform(0.0, 30.0), rng.uniform(0.0, 20.0));
    const Vector2 a = ring[1] - ring[0];
    const Vector2 b = ring[2] - ring[0];
    if (a.x() * b.y() - a.y() * b.x() < 0.0) std::swap(ring[1], ring[2]);
    plan.obstacles.push_back({ring, {}});
  }
  const FloorGeometry geometry(plan);
  for (int i = 0; i < 5000; ++i) {
    const Vector2 point(rng.uniform(-2.0, 32.0), rng.uniform(-2.0, 22.0));
    const bool covered = std::ranges::any_of(
        plan.obstacles, [&](const Polygon& polygon) { return in_convex(polygon.outer, point); });
    ASSERT_EQ(geometry.is_walkable(point), !covered) << point.transpose();
  }
}

TEST(FloorGeometry, CopesWithAPlanOfAbsurdSize) {
  Plan plan;
  plan.walls = {{Vector2(-1e9, 0), Vector2(1e9, 1)}, {Vector2(0, -1e9), Vector2(3, 1e9)}};
  const FloorGeometry geometry(plan);
  EXPECT_TRUE(geometry.crosses_wall(Vector2(50, -10), Vector2(50, 10)));
  EXPECT_FALSE(geometry.crosses_wall(Vector2(50, 10), Vector2(60, 10)));
}

TEST(FloorGeometry, AgreesWithEveryWallOfARealFloor) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  const auto folder = *root / "ilc/site1/F1";
  const auto draft =
      parse_ilc_floor(core::read_file(folder / "geojson_map.json").value(),
                      core::read_file(folder / "floor_info.json").value(), "F1", folder.string());
  ASSERT_TRUE(draft);
  const FloorGeometry geometry(draft->floor.plan);
  core::Rng rng(21);
  const auto turn = [](const Vector2& a, const Vector2& b, const Vector2& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  };
  int crossed = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector2 from(rng.uniform(0.0, 240.0), rng.uniform(0.0, 176.0));
    const Vector2 to = from + Vector2(rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0));
    // Proper crossings only: random points lie on no line.
    const bool expected = std::ranges::any_of(draft->floor.plan.walls, [&](const Wall& wall) {
      return turn(wall.from_m, wall.to_m, from) * turn(wall.from_m, wall.to_m, to) < 0.0 &&
             turn(from, to, wall.from_m) * turn(from, to, wall.to_m) < 0.0;
    });
    ASSERT_EQ(geometry.crosses_wall(from, to), expected);
    crossed += expected ? 1 : 0;
  }
  EXPECT_GT(crossed, 100);
}

}  // namespace
}  // namespace waylode::site
