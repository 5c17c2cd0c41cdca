// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_support.hpp"

namespace waylode::sim {
namespace {

using ::testing::HasSubstr;

/// Nine lines; more can follow.
constexpr const char* kStart =
    "seed = 3\n"
    "[building]\n"
    "drawing = '''\n"
    "floor F1 level 0 elevation_m 0\n"
    "1..A..2\n"
    "'''\n"
    "[[walker]]\n"
    "name = 'w'\n"
    "route = ['1', '2']\n";

core::Error refused(const std::string& text) {
  const auto scenario = parse_scenario(text, "s.toml", ".");
  EXPECT_FALSE(scenario) << text;
  return scenario ? core::Error{} : scenario.error();
}

TEST(Scenario, ReadsWhatItIsTold) {
  const auto scenario = parse_scenario(std::string(kStart) +
                                           "survey = true\n"
                                           "[walker.phone]\n"
                                           "pose = 'pocket'\n"
                                           "rssi_offset_db = -3\n"
                                           "[radio]\n"
                                           "path_loss_exponent = 2.75\n",
                                       "s.toml", ".");
  ASSERT_TRUE(scenario) << core::to_string(scenario.error());
  EXPECT_EQ(scenario->seed, 3U);
  EXPECT_TRUE(scenario->walkers[0].is_survey);
  EXPECT_EQ(scenario->walkers[0].phone.pose, PhoneOptions::Pose::kPocket);
  EXPECT_EQ(scenario->walkers[0].phone.rssi_offset_db, -3.0);
  EXPECT_EQ(scenario->radio.path_loss_exponent, 2.75);
}

TEST(Scenario, GivesCommonHabitsToEveryWalker) {
  const auto scenario = parse_scenario(std::string("[gait]\nheight_m = 1.6\nspeed_mps = 1.1\n") +
                                           "[building]\n"
                                           "drawing = '''\n"
                                           "floor F1 level 0 elevation_m 0\n"
                                           "1..A..2\n"
                                           "'''\n"
                                           "[[walker]]\nname = 'a'\nroute = ['1', '2']\n"
                                           "[[walker]]\nname = 'b'\nroute = ['2', '1']\n"
                                           "[walker.gait]\nheight_m = 1.9\n",
                                       "s.toml", ".");
  ASSERT_TRUE(scenario) << core::to_string(scenario.error());
  EXPECT_EQ(scenario->walkers[0].gait.height_m, 1.6);
  EXPECT_EQ(scenario->walkers[1].gait.height_m, 1.9);
  EXPECT_EQ(scenario->walkers[1].gait.speed_mps, 1.1);
}

TEST(Scenario, NamesTheLineOfWhatItRefuses) {
  const std::string start = kStart;
  EXPECT_EQ(refused(start + "sped = 2\n").place, "s.toml:10");
  EXPECT_THAT(refused(start + "sped = 2\n").message, HasSubstr("'sped'"));
  EXPECT_EQ(refused(start + "[radio]\npath_loss_exponent = 'two'\n").place, "s.toml:11");
  EXPECT_EQ(refused(start + "[radio]\npath_loss_exponent = 11.0\n").place, "s.toml:11");
  EXPECT_EQ(refused(start + "[radio]\npath_loss_exponent = nan\n").place, "s.toml:11");
  EXPECT_EQ(refused(start + "[walker.phone]\npose = 'hat'\n").place, "s.toml:11");
  EXPECT_EQ(refused(start + "[[point]]\nname = 'x'\nfloor = 'F9'\nx_m = 1\ny_m = 1\n").place,
            "s.toml:12");
  EXPECT_EQ(refused(start + "start_s = = 1\n").place, "s.toml:10");
  EXPECT_EQ(refused("seed = 1\n[building]\ndrawing = '''\nfloor F1 level 0 elevation_m 0\n1.!\n'''"
                    "\n[[walker]]\nname = 'w'\nroute = ['1', '1']\n")
                .place,
            "s.toml:5");
}

TEST(Scenario, RefusesRoutesToNowhereAndTwins) {
  const std::string start = kStart;
  EXPECT_EQ(refused(start + "[[walker]]\nname = 'v'\nroute = ['1', '7']\n").place, "s.toml:12");
  EXPECT_THAT(refused(start + "[[walker]]\nname = 'w'\nroute = ['1', '2']\n").message,
              HasSubstr("rename"));
  EXPECT_THAT(refused(start + "[[walker]]\nname = '../w'\nroute = ['1', '2']\n").message,
              HasSubstr("file name"));
  EXPECT_THAT(refused("[building]\nname = 'x'\n").message, HasSubstr("drawing"));
}

TEST(Scenario, ReadsTheDemo) {
  const auto scenario =
      load_scenario(test::source_root() / "testdata" / "demo" / "demo_scenario.toml");
  ASSERT_TRUE(scenario) << core::to_string(scenario.error());
  EXPECT_EQ(scenario->building.floors.size(), 2U);
  EXPECT_EQ(scenario->building.stairwells.size(), 1U);
  EXPECT_GE(scenario->walkers.size(), 4U);
}

}  // namespace
}  // namespace waylode::sim
