// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/building.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "test_support.hpp"
#include "waylode/sim/ascii_building.hpp"
#include "waylode/sim/simulate.hpp"

namespace waylode::sim {
namespace {

using core::Vector2;

site::FloorDraft draft_of(const char* name, int level) {
  site::FloorDraft draft;
  draft.floor.name = name;
  draft.floor.level = level;
  draft.floor.elevation_m = 3.0 * level;
  draft.floor.bounds.max_m = {30.0, 20.0};
  site::Polygon area;
  area.outer = {{0.0, 0.0}, {30.0, 0.0}, {30.0, 20.0}, {0.0, 20.0}};
  area.holes = {{{5.0, 5.0}, {5.0, 15.0}, {25.0, 15.0}, {25.0, 5.0}}};
  draft.floor.plan.walkable = {area};
  return draft;
}

TEST(Building, SortsFloorsAndTakesOutlinesForMissingWalls) {
  const auto building = building_from_plans("house", {draft_of("up", 1), draft_of("down", -1)});
  ASSERT_TRUE(building);
  EXPECT_EQ(building->floors[0].floor.name, "down");
  EXPECT_EQ(building->find_floor("up"), core::FloorId{1});
  EXPECT_EQ(building->radio_walls[0].size(), 8U);
}

TEST(Building, RefusesNoneOrTwinFloors) {
  EXPECT_FALSE(building_from_plans("house", {}));
  EXPECT_FALSE(building_from_plans("house", {draft_of("a", 1), draft_of("b", 1)}));
  EXPECT_FALSE(building_from_plans("house", {draft_of("a", 1), draft_of("a", 2)}));
}

TEST(Building, HangsSeededAccessPointsOverWalkableGround) {
  auto building = building_from_plans("house", {draft_of("a", 0)});
  ASSERT_TRUE(building);
  Building again = *building;
  add_seeded_access_points(*building, 10.0, 3);
  add_seeded_access_points(again, 10.0, 3);
  EXPECT_EQ(building->transmitters, again.transmitters);
  // Six squares of 10 m, each with ground outside the block in the middle.
  EXPECT_EQ(building->transmitters.size(), 6U);
  for (const Transmitter& transmitter : building->transmitters) {
    const Vector2& p = transmitter.position_m;
    const bool is_in_block = p.x() > 5.2 && p.x() < 24.8 && p.y() > 5.2 && p.y() < 14.8;
    EXPECT_FALSE(is_in_block);
  }
}

TEST(Building, CanBeReadFromPlanFilesAndWalkedIn) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.geojson") << site::format_plan(draft_of("a", 0));
  std::ofstream(folder.path() / "b.geojson") << site::format_plan(draft_of("b", 1));
  const auto scenario = parse_scenario(
      "[building]\n"
      "plans = ['a.geojson', 'b.geojson']\n"
      "access_point_spacing_m = 10\n"
      "[[point]]\nname = 'west'\nfloor = 'a'\nx_m = 2\ny_m = 10\n"
      "[[point]]\nname = 'east'\nfloor = 'b'\nx_m = 28\ny_m = 10\n"
      "[[stairs]]\nlower_floor = 'a'\nx_m = 15\ny_m = 2\nradius_m = 1\n"
      "[[walker]]\nname = 'w'\nroute = ['west', 'east']\n",
      "s.toml", folder.path());
  ASSERT_TRUE(scenario) << core::to_string(scenario.error());
  const auto simulation = simulate(*scenario);
  ASSERT_TRUE(simulation) << core::to_string(simulation.error());
  const TruthState& end = simulation->recordings[0].truth.back();
  EXPECT_EQ(end.floor, core::FloorId{1});
  EXPECT_LT((end.position_m - Vector2(28.0, 10.0)).norm(), 0.1);
}

TEST(Building, NamesThePlanFileThatIsMissing) {
  const auto scenario = parse_scenario(
      "[building]\nplans = ['none.geojson']\n[[walker]]\nname = 'w'\nroute = ['a', 'b']\n",
      "s.toml", "no_such_folder");
  ASSERT_FALSE(scenario);
  EXPECT_EQ(scenario.error().code, core::ErrorCode::kFileNotFound);
}

}  // namespace
}  // namespace waylode::sim
