// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/ascii_building.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace waylode::sim {
namespace {

using core::Vector2;
using ::testing::HasSubstr;

double area_m2(const site::Ring& ring) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2& a = ring[i];
    const Vector2& b = ring[(i + 1) % ring.size()];
    doubled += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * doubled;
}

Building parsed(std::string_view text, AsciiBuildingOptions options = {}) {
  auto building = parse_ascii_building(text, "drawing", options);
  EXPECT_TRUE(building) << core::to_string(building.error());
  return *building;
}

core::Error refused(std::string_view text, AsciiBuildingOptions options = {}) {
  const auto building = parse_ascii_building(text, "house.txt", options);
  EXPECT_FALSE(building);
  return building ? core::Error{} : building.error();
}

TEST(AsciiBuilding, PutsMarksInTheMiddleOfTheirCells) {
  const Building building = parsed(
      "floor F1 level 0 elevation_m 0\n"
      "######\n"
      "#1..A#\n"
      "#..b.#\n"
      "######\n",
      {2.0, 1});
  EXPECT_EQ(building.find_point("1")->position_m, Vector2(3.0, 5.0));
  ASSERT_EQ(building.transmitters.size(), 2U);
  EXPECT_EQ(building.transmitters[0].position_m, Vector2(9.0, 5.0));
  EXPECT_EQ(building.transmitters[0].kind, Transmitter::Kind::kWifi);
  EXPECT_EQ(building.transmitters[1].position_m, Vector2(7.0, 3.0));
  EXPECT_EQ(building.transmitters[1].kind, Transmitter::Kind::kBluetooth);
  EXPECT_EQ(building.floors[0].floor.bounds.max_m, Vector2(12.0, 8.0));
}

TEST(AsciiBuilding, OutlinesFreeCellsWithTheirHoles) {
  const Building building = parsed(
      "floor F1 level 0 elevation_m 0\n"
      ".....\n"
      ".##..\n"
      ".....\n");
  const auto& walkable = building.floors[0].floor.plan.walkable;
  ASSERT_EQ(walkable.size(), 1U);
  EXPECT_EQ(walkable[0].outer.size(), 4U);
  EXPECT_DOUBLE_EQ(area_m2(walkable[0].outer), 15.0);
  ASSERT_EQ(walkable[0].holes.size(), 1U);
  EXPECT_EQ(walkable[0].holes[0].size(), 4U);
  EXPECT_DOUBLE_EQ(area_m2(walkable[0].holes[0]), -2.0);
}

TEST(AsciiBuilding, KeepsCellsThatTouchByACornerApart) {
  const Building building = parsed(
      "floor F1 level 0 elevation_m 0\n"
      "..#\n"
      ".##\n"
      "##.\n");
  const auto& walkable = building.floors[0].floor.plan.walkable;
  ASSERT_EQ(walkable.size(), 2U);
  EXPECT_DOUBLE_EQ(area_m2(walkable[0].outer) + area_m2(walkable[1].outer), 4.0);
}

TEST(AsciiBuilding, MergesWallFacesIntoLongLines) {
  const Building building = parsed(
      "floor F1 level 0 elevation_m 0\n"
      "######\n"
      "#....#\n"
      "######\n");
  const auto& walls = building.floors[0].floor.plan.walls;
  EXPECT_EQ(walls.size(), 4U);
  double sum_m = 0.0;
  for (const site::Wall& wall : walls) sum_m += (wall.to_m - wall.from_m).norm();
  EXPECT_DOUBLE_EQ(sum_m, 10.0);
}

TEST(AsciiBuilding, JoinsStairsOnTopOfEachOther) {
  const Building building = parsed(
      "floor F2 level 1 elevation_m 3.5\n"
      "#######\n"
      "#^^^.^#\n"
      "#^^^..#\n"
      "#######\n"
      "\n"
      "floor F1 level 0 elevation_m 0\n"
      "#######\n"
      "#^^^..#\n"
      "#^^^..#\n"
      "#######\n");
  EXPECT_EQ(building.floors[0].floor.name, "F1");
  ASSERT_EQ(building.stairwells.size(), 1U);
  EXPECT_EQ(building.stairwells[0].lower, core::FloorId{0});
  EXPECT_EQ(building.stairwells[0].centre_m, Vector2(2.5, 2.0));
  EXPECT_LT(building.stairwells[0].radius_m, 1.0);
}

TEST(AsciiBuilding, FillsShortRowsWithWall) {
  const Building building = parsed(
      "floor F1 level 0 elevation_m 0\n"
      "..\n"
      "....\n");
  EXPECT_DOUBLE_EQ(area_m2(building.floors[0].floor.plan.walkable[0].outer), 6.0);
}

TEST(AsciiBuilding, FindsPlacesByFloorWhenNeeded) {
  const Building building =
      parsed("floor F1 level 0 elevation_m 0\n1.2\nfloor F2 level 1 elevation_m 3\n1..\n");
  EXPECT_EQ(building.find_point("F2/1")->floor, core::FloorId{1});
  EXPECT_EQ(building.find_point("2")->floor, core::FloorId{0});
  EXPECT_THAT(building.find_point("1").error().message, HasSubstr("several floors"));
  EXPECT_FALSE(building.find_point("3"));
}

TEST(AsciiBuilding, NamesTheLineOfWhatItRefuses) {
  const std::string header = "floor F1 level 0 elevation_m 0\n";
  EXPECT_EQ(refused(header + "..\n.?\n").place, "house.txt:3");
  EXPECT_EQ(refused(header + "A.\n.A\n").place, "house.txt:3");
  EXPECT_EQ(refused(header + "..\n\n..\n").place, "house.txt:4");
  EXPECT_EQ(refused("..\n").place, "house.txt:1");
  EXPECT_EQ(refused("floor F1 level x elevation_m 0\n..\n").place, "house.txt:1");
  EXPECT_EQ(refused(header).place, "house.txt:1");
  EXPECT_EQ(refused("", {1.0, 12}).place, "house.txt:12");
  EXPECT_EQ(refused(header + ".\n" + "floor F9 level 0 elevation_m 3\n.\n").code,
            core::ErrorCode::kScenarioInvalid);
  EXPECT_EQ(refused(header + ".\n", {0.0, 1}).code, core::ErrorCode::kScenarioInvalid);
}

}  // namespace
}  // namespace waylode::sim
