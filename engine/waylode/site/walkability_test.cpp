// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/walkability.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "waylode/site/floor_geometry.hpp"

namespace waylode::site {
namespace {

using core::Bounds2;
using core::Vector2;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A hall of 20 m x 12 m with a block in it, drawn on the raster's lines so that depths are exact.
const Bounds2 kHall{Vector2(0, 0), Vector2(20, 12)};
Plan hall() {
  Plan plan;
  plan.walkable = {{box(0, 0, 20, 12), {}}};
  plan.obstacles = {{box(6, 4, 12, 9), {}}};
  return plan;
}

TEST(Walkability, WithoutAPlanHasNoOpinion) {
  Plan plan;
  plan.rooms = {{"A", {box(0, 0, 1, 1), {}}}};
  plan.doors = {{Vector2(1, 1), 1.0}};
  const Walkability walkability(plan, {{0.0, 0.0}, {10.0, 4.0}}, {});
  EXPECT_FALSE(walkability.knows_anything());
  EXPECT_EQ(walkability.log_penalty({1.0, 1.0}, {2.0, 1.0}), 0.0);
  EXPECT_EQ(walkability.log_penalty({1.0, 1.0}, {-200.0, 1.0}), 0.0);
  EXPECT_EQ(walkability.depth_m({-200.0, 1.0}), 0.0);
  EXPECT_EQ(walkability.nearest_walkable({-200.0, 1.0}), Vector2(-200.0, 1.0));
}

TEST(Walkability, DepthIsTheDistanceToTheObstaclesEdge) {
  const Walkability walkability(hall(), kHall, {});
  EXPECT_TRUE(walkability.knows_anything());
  EXPECT_EQ(walkability.depth_m({3, 3}), 0.0);
  EXPECT_NEAR(walkability.depth_m({7.1, 6.3}), 1.1, 1e-12);
  EXPECT_NEAR(walkability.depth_m({9.1, 4.35}), 0.35, 1e-12);
  EXPECT_NEAR(walkability.depth_m({9.1, 6.4}), 2.4, 1e-12);
}

TEST(Walkability, BeyondTheOutlineDepthIsTheDistanceBack) {
  const Walkability walkability(hall(), kHall, {});
  EXPECT_NEAR(walkability.depth_m({23.0, 5.1}), 3.0, 1e-9);
  EXPECT_NEAR(walkability.depth_m({-4.0, -3.0}), 5.0, 1e-9);
  // The bounds reach beyond the outline: the same, but told by the raster.
  const Walkability wider(hall(), {Vector2(-10, -10), Vector2(40, 40)}, {});
  EXPECT_NEAR(wider.depth_m({23.0, 5.1}), 3.0, 1e-9);
  EXPECT_NEAR(wider.depth_m({-4.0, -3.0}), 5.0, 1e-9);
}

TEST(Walkability, WithoutAnOutlineNothingIsSaidBeyondTheBounds) {
  Plan plan = hall();
  plan.walkable.clear();
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.depth_m({200, -50}), 0.0);
  EXPECT_NEAR(walkability.depth_m({7.1, 6.3}), 1.1, 1e-12);
}

TEST(Walkability, DepthCostsItsSquareUpToTheLimit) {
  const Walkability walkability(hall(), kHall, {});
  // One softness deep costs a half, two cost two: 0.5 (d / 0.6)^2.
  EXPECT_NEAR(walkability.log_penalty({6.5, 6}, {6.6, 6}), -0.5, 1e-12);
  EXPECT_NEAR(walkability.log_penalty({6.5, 6}, {7.2, 6}), -2.0, 1e-12);
  EXPECT_EQ(walkability.log_penalty({8, 6}, {9.1, 6.4}), -6.0);  // 0.5 * 16
  Walkability::Options options;
  options.softness_m = 1.2;
  options.max_penalty = 1.5;
  const Walkability softer(hall(), kHall, options);
  EXPECT_NEAR(softer.log_penalty({6.5, 6}, {7.2, 6}), -0.5, 1e-12);
  EXPECT_EQ(softer.log_penalty({8, 6}, {9.1, 6.4}), -1.5);
}

TEST(Walkability, EnteringAnObstacleCostsItsDepthAndLeavingItNothing) {
  const Walkability walkability(hall(), kHall, {});
  EXPECT_NEAR(walkability.log_penalty({5.7, 6}, {6.3, 6}), -0.125, 1e-12);
  EXPECT_EQ(walkability.log_penalty({6.3, 6}, {5.7, 6}), 0.0);
}

TEST(Walkability, JumpingOverAnObstacleCostsAsAWall) {
  Plan plan = hall();
  plan.obstacles = {{box(6, 0, 6.25, 12), {}}};
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.log_penalty({5.8, 6}, {6.5, 6}), -3.0);
  EXPECT_EQ(walkability.log_penalty({5.8, 6}, {5.1, 6}), 0.0);
}

TEST(Walkability, CrossingAThinWallCostsOnceBothWays) {
  Plan plan = hall();
  plan.walls = {{Vector2(3, 1), Vector2(3, 5)}, {Vector2(3.2, 1), Vector2(3.2, 5)}};
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.log_penalty({2.8, 2}, {3.1, 2.2}), -3.0);
  EXPECT_EQ(walkability.log_penalty({3.1, 2.2}, {2.8, 2}), -3.0);
  EXPECT_EQ(walkability.log_penalty({2.8, 2}, {3.5, 2.2}), -3.0);   // both
  EXPECT_EQ(walkability.log_penalty({2.8, 5.1}, {3.5, 5.3}), 0.0);  // past their ends
  EXPECT_EQ(walkability.log_penalty({2.9, 2}, {2.9, 4}), 0.0);      // along them
}

TEST(Walkability, AWallIntoAnObstacleAddsToItsDepthUpToTheLimit) {
  Plan plan = hall();
  plan.walls = {{Vector2(7, 3), Vector2(7, 10)}};
  const Walkability walkability(plan, kHall, {});
  EXPECT_NEAR(walkability.log_penalty({6.9, 6}, {7.2, 6}), -5.0, 1e-12);
  EXPECT_EQ(walkability.log_penalty({6.9, 6}, {7.6, 6}), -6.0);
}

TEST(Walkability, ADoorLiftsTheWallWithinItsWidth) {
  Plan plan = hall();
  plan.walls = {{Vector2(3, 0), Vector2(3, 12)}};
  plan.doors = {{Vector2(3, 6), 1.5}};
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.log_penalty({2.7, 6.7}, {3.3, 6.7}), 0.0);
  EXPECT_EQ(walkability.log_penalty({2.7, 5.3}, {3.3, 5.3}), 0.0);
  EXPECT_EQ(walkability.log_penalty({2.7, 6.8}, {3.3, 6.8}), -3.0);
  EXPECT_EQ(walkability.log_penalty({2.7, 5.2}, {3.3, 5.2}), -3.0);
}

TEST(Walkability, ADoorOpensAWallDrawnThick) {
  Plan plan = hall();
  plan.obstacles = {{box(6, 0, 6.5, 12), {}}};
  plan.doors = {{Vector2(6.25, 6), 1.5}};
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.log_penalty({5.9, 6}, {6.3, 6}), 0.0);
  EXPECT_EQ(walkability.log_penalty({5.9, 6}, {6.6, 6}), 0.0);
  EXPECT_EQ(walkability.log_penalty({5.9, 8}, {6.6, 8}), -3.0);
  EXPECT_LT(walkability.log_penalty({5.9, 8}, {6.3, 8}), 0.0);
}

TEST(Walkability, APositionThatIsNotFiniteCostsTheMost) {
  for (const Plan& plan : {hall(), Plan{}}) {
    const Walkability walkability(plan, kHall, {});
    for (const Vector2& bad : {Vector2(kNan, 1), Vector2(1, kNan), Vector2(kInfinity, 1),
                               Vector2(1, -kInfinity), Vector2(1e200, 0)}) {
      EXPECT_EQ(walkability.log_penalty(bad, {1, 1}), -6.0);
      EXPECT_EQ(walkability.log_penalty({1, 1}, bad), -6.0);
      EXPECT_EQ(walkability.log_penalty(bad, Vector2(kNan, kNan)), -6.0);
    }
    EXPECT_EQ(walkability.depth_m({kNan, 1}), kInfinity);
    EXPECT_EQ(walkability.depth_m({1, kInfinity}), kInfinity);
    EXPECT_FALSE(walkability.nearest_walkable({kNan, 1}));
  }
}

TEST(Walkability, DegeneratePlansNeitherCrashNorForbidEverything) {
  const Polygon point{{{3, 3}}, {}};
  const Polygon sliver{{{3, 3}, {3, 3}, {3, 3}}, {}};
  const Polygon nan{{{3, 3}, {kNan, 4}, {5, 5}}, {}};
  const Polygon bow_tie{{{1, 1}, {5, 5}, {5, 1}, {1, 5}}, {}};
  const Polygon huge{box(-1e300, -1e300, 1e300, 1e300), {}};
  const Polygon wide{box(-9e5, -9e5, 9e5, 9e5), {}};
  for (const Polygon& polygon : {Polygon{}, point, sliver, nan, bow_tie, huge, wide}) {
    for (int kind = 0; kind < 3; ++kind) {
      Plan plan;
      if (kind != 1) plan.walkable = {polygon};
      if (kind != 0) plan.obstacles = {polygon};
      plan.walls = {{Vector2(kNan, 0), Vector2(1, 1)}, {Vector2(2, 2), Vector2(2, 2)}};
      const Walkability walkability(plan, kHall, {});
      const double penalty = walkability.log_penalty({2, 2}, {2.3, 2.7});
      EXPECT_TRUE(penalty <= 0.0 && penalty >= -6.0);
      core::Rng rng(5);
      const Vector2 drawn_m = walkability.sample_walkable(rng);
      EXPECT_TRUE(kHall.contains(drawn_m));
      EXPECT_LT(walkability.depth_m(drawn_m), 1e-9);
    }
  }
  // The bow tie's even-odd inside: left and right of its crossing, not above and below.
  Plan plan;
  plan.obstacles = {bow_tie};
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.depth_m({3.1, 1.6}), 0.0);
  EXPECT_GT(walkability.depth_m({1.6, 3.1}), 0.0);
}

TEST(Walkability, APlanThatLeavesNoPlaceIsNotBelieved) {
  Plan plan;
  plan.obstacles = {{box(-5, -5, 30, 30), {}}};
  const Walkability walkability(plan, kHall, {});
  EXPECT_EQ(walkability.log_penalty({2, 2}, {2.3, 2.7}), 0.0);
  EXPECT_EQ(walkability.depth_m({2, 2}), 0.0);
}

TEST(Walkability, UnusableBoundsGiveWayToThePlansExtent) {
  for (const Bounds2& bounds :
       {Bounds2{}, Bounds2{Vector2(kNan, 0), Vector2(1, 1)}, Bounds2{Vector2(5, 5), Vector2(-5, 8)},
        Bounds2{Vector2(0, 0), Vector2(kInfinity, 1)}}) {
    const Walkability walkability(hall(), bounds, {});
    EXPECT_NEAR(walkability.depth_m({7.1, 6.3}), 1.1, 1e-12);
    core::Rng rng(7);
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(kHall.contains(walkability.sample_walkable(rng)));
  }
  const Walkability nothing({}, {Vector2(kNan, 0), Vector2(1, 1)}, {});
  core::Rng rng(7);
  EXPECT_TRUE(nothing.sample_walkable(rng).allFinite());
}

TEST(Walkability, DrawsEvenlyFromTheWalkablePlaces) {
  const Walkability walkability(hall(), kHall, {});
  core::Rng rng(11);
  constexpr int kDraws = 21'000;
  std::array<int, 4> quarters{};
  for (int i = 0; i < kDraws; ++i) {
    const Vector2 drawn_m = walkability.sample_walkable(rng);
    ASSERT_TRUE(kHall.contains(drawn_m));
    ASSERT_EQ(walkability.depth_m(drawn_m), 0.0);
    ++quarters[(drawn_m.x() >= 10.0 ? 1U : 0U) + (drawn_m.y() >= 6.0 ? 2U : 0U)];
  }
  // 60 m2 less what the block (x 6..12, y 4..9) takes: 8, 4, 12, 6; of 210 m2 in all.
  const std::array<double, 4> area_m2 = {52.0, 56.0, 48.0, 54.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const double expected = kDraws * area_m2[i] / 210.0;
    EXPECT_NEAR(quarters[i], expected, 4.0 * std::sqrt(expected)) << i;
  }
}

TEST(Walkability, OptionsOutOfRangeAreRefused) {
  EXPECT_TRUE(Walkability::Options{}.validate());
  for (double Walkability::Options::* const member :
       {&Walkability::Options::cell_m, &Walkability::Options::softness_m,
        &Walkability::Options::wall_penalty, &Walkability::Options::max_penalty}) {
    for (const double bad : {-1.0, 101.0, kNan}) {
      Walkability::Options options;
      options.*member = bad;
      EXPECT_FALSE(options.validate());
    }
  }
}

/// Boxes turned at random, on a hall of 40 m x 30 m, and walls.
Plan drawn_plan(core::Rng& rng) {
  Plan plan;
  const auto place = [&] { return Vector2(rng.uniform(0.0, 40.0), rng.uniform(0.0, 30.0)); };
  if (rng.uniform() < 0.5) plan.walkable = {{box(1.003, 1.007, 37.01, 29.03), {}}};
  const auto blocks = rng.below(6);
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const Vector2 middle(rng.uniform(7.1, 32.9), rng.uniform(7.1, 22.9));
    const Vector2 half(rng.uniform(0.5, 5.0), rng.uniform(0.5, 5.0));
    const Eigen::Rotation2Dd turned(rng.uniform(0.0, 3.0));
    Ring ring;
    for (const Vector2& corner : box(-half.x(), -half.y(), half.x(), half.y())) {
      ring.emplace_back(middle + turned * corner);
    }
    plan.obstacles.push_back({ring, {}});
  }
  const auto walls = rng.below(8);
  for (std::uint64_t i = 0; i < walls; ++i) plan.walls.push_back({place(), place()});
  return plan;
}
const Bounds2 kDrawnBounds{Vector2(0, 0), Vector2(40, 30)};

RC_GTEST_PROP(Walkability, DepthIsTheDistanceThatASearchOverAllCellsFinds, (std::uint64_t seed)) {
  constexpr double kCell_m = 0.25;
  core::Rng rng(seed);
  const Plan plan = drawn_plan(rng);
  const Walkability walkability(plan, kDrawnBounds, {});
  const FloorGeometry exact(plan);
  std::vector<Vector2> centres_m;
  for (double y_m = 0.5 * kCell_m; y_m < 30.0; y_m += kCell_m) {
    for (double x_m = 0.5 * kCell_m; x_m < 40.0; x_m += kCell_m) {
      if (exact.is_walkable({x_m, y_m})) centres_m.emplace_back(x_m, y_m);
    }
  }
  for (int i = 0; i < 10; ++i) {
    const Vector2 point_m(rng.uniform(0.0, 40.0), rng.uniform(0.0, 30.0));
    double least_m = kInfinity;
    for (const Vector2& centre_m : centres_m) {
      const Vector2 beyond_m = (point_m - centre_m).cwiseAbs() - Vector2(0.125, 0.125);
      least_m = std::min(least_m, beyond_m.cwiseMax(0.0).norm());
    }
    // The cell nearest to the middle of the point's own cell is taken: at most two half diagonals
    // farther than the one nearest to the point.
    const double depth_m = walkability.depth_m(point_m);
    RC_ASSERT(depth_m >= least_m - 1e-9);
    RC_ASSERT(depth_m <= least_m + 0.36);
    RC_ASSERT((depth_m > 1e-9) == (least_m > 1e-9));
  }
}

RC_GTEST_PROP(Walkability, CrossingAgreesWithTheExactGeometryWhereBothEndsAreWalkable,
              (std::uint64_t seed)) {
  core::Rng rng(seed);
  const Plan plan = drawn_plan(rng);
  const Walkability walkability(plan, kDrawnBounds, {});
  const FloorGeometry exact(plan);
  for (int i = 0; i < 40; ++i) {
    const Vector2 from_m = walkability.sample_walkable(rng);
    const double reach_m = i % 4 == 0 ? 20.0 : 0.9;
    const Vector2 to_m =
        from_m + Vector2(rng.uniform(-reach_m, reach_m), rng.uniform(-reach_m, reach_m));
    if (walkability.depth_m(to_m) > 0.0) continue;
    const double expected = exact.crosses_wall(from_m, to_m) ? -3.0 : 0.0;
    RC_ASSERT(walkability.log_penalty(from_m, to_m) == expected);
  }
}

RC_GTEST_PROP(Walkability, TheNearestWalkablePlaceIsAtTheDepth, (std::uint64_t seed)) {
  core::Rng rng(seed);
  const Walkability walkability(drawn_plan(rng), kDrawnBounds, {});
  for (int i = 0; i < 20; ++i) {
    const Vector2 point_m(rng.uniform(-20.0, 60.0), rng.uniform(-20.0, 50.0));
    const auto nearest_m = walkability.nearest_walkable(point_m);
    RC_ASSERT(nearest_m.has_value());
    RC_ASSERT(std::abs((*nearest_m - point_m).norm() - walkability.depth_m(point_m)) < 1e-9);
    RC_ASSERT(walkability.depth_m(*nearest_m) < 1e-9);
  }
}

}  // namespace
}  // namespace waylode::site
