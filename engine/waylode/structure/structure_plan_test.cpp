// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/structure_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "waylode/core/rng.hpp"
#include "waylode/site/floor_geometry.hpp"
#include "waylode/structure/structure_adjuster.hpp"
#include "waylode/structure/testing/route_walks.hpp"

namespace waylode::structure {
namespace {

using core::Vector2;
using ::testing::Contains;
using ::testing::HasSubstr;

AdjustedStructure structure_of(const std::vector<std::pair<Vector2, std::string>>& nodes,
                               const std::vector<std::pair<std::size_t, std::size_t>>& edges) {
  AdjustedStructure structure;
  structure.scale_known = true;
  for (const auto& [position_m, name] : nodes) {
    StructureNode node;
    node.position_m = position_m;
    node.landmark = name;
    structure.nodes.push_back(node);
  }
  for (const auto& [from, to] : edges) {
    StructureEdge edge;
    edge.from = from;
    edge.to = to;
    structure.edges.push_back(edge);
  }
  return structure;
}

double area_m2(const site::Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2& a = ring[i];
    const Vector2& b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double walkable_m2(const site::Plan& plan) {
  double sum = 0.0;
  for (const site::Polygon& polygon : plan.walkable) {
    sum += std::abs(area_m2(polygon.outer));
    for (const site::Ring& hole : polygon.holes) sum -= std::abs(area_m2(hole));
  }
  return sum;
}

TEST(StructurePlan, DrawsACornerWithoutGapOrOverlap) {
  const auto draft =
      to_plan(structure_of({{{0, 0}, "Door"}, {{20, 0}, ""}, {{20, 15}, "Cafe"}}, {{0, 1}, {1, 2}}),
              {.floor = "F2", .corridor_width_m = 3.0, .landmark_size_m = 1.0});
  ASSERT_TRUE(draft) << core::to_string(draft.error());
  EXPECT_EQ(draft->floor.name, "F2");
  EXPECT_EQ(draft->floor.level, 1);
  const site::Plan& plan = draft->floor.plan;
  ASSERT_EQ(plan.walkable.size(), 1U);
  EXPECT_EQ(plan.walkable[0].outer.size(), 6U);
  // 23 m and 15 m of corridor, 3 m wide.
  EXPECT_NEAR(walkable_m2(plan), 3.0 * (23.0 + 15.0), 1e-6);
  EXPECT_EQ(plan.walls.size(), 6U);
  ASSERT_EQ(plan.rooms.size(), 2U);
  EXPECT_EQ(plan.rooms[1].name, "Cafe");
  EXPECT_NEAR(area_m2(plan.rooms[1].outline.outer), 1.0, 1e-9);
  EXPECT_TRUE(draft->notes.empty());
  const site::FloorGeometry geometry(plan);
  EXPECT_TRUE(geometry.is_walkable({20, 0}));
  EXPECT_TRUE(geometry.is_walkable({20, 14}));
  EXPECT_FALSE(geometry.is_walkable({10, 5}));
  EXPECT_FALSE(geometry.crosses_wall({1, 0}, {20, 0.5}));
  EXPECT_TRUE(geometry.crosses_wall({1, 0}, {20, 14}));
}

TEST(StructurePlan, LeavesTheCourtyardOfALoopOut) {
  const auto draft =
      to_plan(structure_of({{{0, 0}, ""}, {{12, 0}, ""}, {{12, 9}, ""}, {{0, 9}, ""}},
                           {{0, 1}, {1, 2}, {2, 3}, {3, 0}}),
              {.corridor_width_m = 2.0});
  ASSERT_TRUE(draft);
  ASSERT_EQ(draft->floor.plan.walkable.size(), 1U);
  ASSERT_EQ(draft->floor.plan.walkable[0].holes.size(), 1U);
  // 14 x 11 less 10 x 7.
  EXPECT_NEAR(walkable_m2(draft->floor.plan), 14.0 * 11.0 - 10.0 * 7.0, 1e-6);
  EXPECT_EQ(draft->floor.plan.walls.size(), 8U);
}

TEST(StructurePlan, SaysThatTheScaleIsNotKnown) {
  AdjustedStructure structure = structure_of({{{0, 0}, ""}, {{5, 0}, ""}}, {{0, 1}});
  structure.scale_known = false;
  EXPECT_THAT(to_plan(structure, {})->notes, Contains(HasSubstr("scale is not known")));
}

TEST(StructurePlan, RefusesNothingAndOptionsOutOfRange) {
  EXPECT_EQ(to_plan({}, {}).error().code, core::ErrorCode::kSurveyInsufficient);
  const AdjustedStructure structure = structure_of({{{0, 0}, ""}, {{5, 0}, ""}}, {{0, 1}});
  EXPECT_EQ(to_plan(structure, {.floor = ""}).error().code, core::ErrorCode::kInvalidOptions);
  EXPECT_EQ(to_plan(structure, {.corridor_width_m = std::nan("")}).error().code,
            core::ErrorCode::kInvalidOptions);
  EXPECT_EQ(to_plan(structure, {.landmark_size_m = 0.0}).error().code,
            core::ErrorCode::kInvalidOptions);
}

RC_GTEST_PROP(StructurePlanProperties, IsReadBackAsWritten, (std::uint64_t seed)) {
  core::Rng rng(seed);
  std::vector<std::pair<Vector2, std::string>> nodes;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  const std::size_t count = 2 + rng.below(7);
  for (std::size_t i = 0; i < count; ++i) {
    // Often on a lattice, where corridors touch and overlap exactly, sometimes anywhere.
    const bool lattice = rng.below(3) != 0;
    const Vector2 position_m =
        lattice ? Vector2(4.0 * static_cast<double>(rng.below(6)) + 1e-4 * rng.normal(),
                          4.0 * static_cast<double>(rng.below(5)))
                : Vector2(rng.uniform(-30.0, 30.0), rng.uniform(-30.0, 30.0));
    nodes.emplace_back(position_m, rng.below(2) == 0 ? "" : "room \"" + std::to_string(i) + "\"");
    if (i == 0) continue;
    const std::size_t from = rng.below(i);
    if ((nodes[from].first - position_m).norm() > 0.5) edges.emplace_back(from, i);
  }
  RC_PRE(!edges.empty());
  const auto draft = to_plan(structure_of(nodes, edges),
                             {.corridor_width_m = rng.below(2) == 0 ? 2.0 : rng.uniform(0.2, 9.0)});
  RC_ASSERT(draft.has_value());
  const auto again = site::parse_plan(site::format_plan(*draft), "again");
  RC_ASSERT(again.has_value());
  RC_TAG(draft->floor.plan.walls.empty() ? "without walls" : "with walls");
  RC_ASSERT(again->floor.name == draft->floor.name);
  RC_ASSERT(again->floor.bounds == draft->floor.bounds);
  RC_ASSERT(again->floor.plan == draft->floor.plan);
  // Every centre line can be walked.
  const site::FloorGeometry geometry(draft->floor.plan);
  for (const auto& [from, to] : edges) {
    const Vector2 middle_m = 0.5 * (nodes[from].first + nodes[to].first);
    RC_ASSERT(geometry.is_walkable(middle_m));
    RC_ASSERT(!geometry.crosses_wall(middle_m, nodes[to].first));
  }
}

}  // namespace
}  // namespace waylode::structure
