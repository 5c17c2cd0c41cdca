// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/connectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::site {
namespace {

using core::Vector2;

Plan two_ways_off() {
  Plan plan;
  plan.connectors = {{ConnectorKind::kStairs, "north", Vector2(3, 4), {1}},
                     {ConnectorKind::kLift, "", Vector2(20, 0), {}}};
  return plan;
}

TEST(Connectors, NamesComeBackAsKinds) {
  for (const ConnectorKind kind : {ConnectorKind::kStairs, ConnectorKind::kLift,
                                   ConnectorKind::kEscalator, ConnectorKind::kRamp}) {
    EXPECT_EQ(connector_kind(name_of(kind)), kind);
  }
  EXPECT_FALSE(connector_kind("ladder"));
  EXPECT_FALSE(connector_kind(""));
}

TEST(Connectors, TheNearestIsFoundWithItsStraightDistance) {
  const auto nearest = nearest_connector(two_ways_off(), {0, 0});
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->index, 0U);
  EXPECT_DOUBLE_EQ(nearest->distance_m, 5.0);
}

TEST(Connectors, OnlyThoseThatMayLeadToTheLevelCount) {
  EXPECT_EQ(nearest_connector(two_ways_off(), {0, 0}, 1)->index, 0U);
  const auto down = nearest_connector(two_ways_off(), {0, 0}, -1);
  ASSERT_TRUE(down);
  EXPECT_EQ(down->index, 1U);
  EXPECT_DOUBLE_EQ(down->distance_m, 20.0);
  Plan stairs_only = two_ways_off();
  stairs_only.connectors.pop_back();
  EXPECT_FALSE(nearest_connector(stairs_only, {0, 0}, -1));
}

TEST(Connectors, NothingIsNearestWithoutConnectorsOrPlace) {
  EXPECT_FALSE(nearest_connector({}, {0, 0}));
  EXPECT_FALSE(nearest_connector(two_ways_off(), {std::nan(""), 0}));
  EXPECT_FALSE(nearest_connector(two_ways_off(), {0, std::numeric_limits<double>::infinity()}));
  Plan broken = two_ways_off();
  broken.connectors[0].position_m.x() = std::nan("");
  EXPECT_EQ(nearest_connector(broken, {0, 0})->index, 1U);
}

TEST(Connectors, OneComesOutAtTheEntryOfTheSameName) {
  SiteParts parts;
  parts.floors.resize(3);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "F2";
  parts.floors[1].level = 1;
  parts.floors[2].name = "F3";
  parts.floors[2].level = 2;
  parts.floors[0].plan = two_ways_off();
  // The upper floor's frame starts 100 m east of the site's.
  parts.floors[1].site_from_floor.translation_m = Vector2(100, 0);
  parts.floors[1].plan.connectors = {{ConnectorKind::kLift, "north", Vector2(-97, 4), {}},
                                     {ConnectorKind::kStairs, "north", Vector2(-60, 9), {}},
                                     {ConnectorKind::kStairs, "north", Vector2(-95, 5), {}}};
  const Plan ground = parts.floors[0].plan;
  const Site site(std::move(parts));
  const core::FloorId f1{0};
  const core::FloorId f2{1};
  const core::FloorId f3{2};
  EXPECT_EQ(connector_exit_m(site, f1, ground.connectors[0], f2), Vector2(-95, 5));
  EXPECT_EQ(connector_exit_m(site, f1, ground.connectors[1], f2), Vector2(-80, 0));
  EXPECT_FALSE(connector_exit_m(site, f1, ground.connectors[0], f3));
  EXPECT_FALSE(connector_exit_m(site, f1, ground.connectors[0], f1));
}

}  // namespace
}  // namespace waylode::site
