// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "waylode/sim/ascii_building.hpp"
#include "waylode/sim/detail/phone.hpp"

namespace waylode::sim::detail {
namespace {

constexpr const char* kCorner =
    "floor F1 level 0 elevation_m 0\n"
    "#####################\n"
    "#1.................2#\n"
    "##################..#\n"
    "##################..#\n"
    "##################..#\n"
    "##################3.#\n"
    "#####################\n";

struct Walked {
  Building building;
  std::vector<NavGrid> grids;
  Person person;
  std::unique_ptr<Walk> walk;

  Walked(const char* drawing, const std::vector<std::string>& route, GaitOptions gait = {}) {
    building = *parse_ascii_building(drawing, "drawing");
    for (const auto& draft : building.floors) grids.emplace_back(draft.floor);
    core::Rng rng(11);
    person = draw_person(gait, rng);
    auto strokes = plan_route(building, grids, route, gait, rng);
    EXPECT_TRUE(strokes) << core::to_string(strokes.error());
    walk = std::make_unique<Walk>(building, *strokes, person, gait, rng);
  }
};

TEST(Walk, StrikesTheHeelOncePerStep) {
  const Walked walked(kCorner, {"1", "2", "3", "1"});
  int strikes = 0;
  double before = 0.0;
  for (double t_s = 0.0; t_s <= walked.walk->duration_s(); t_s += 0.01) {
    const double steps = std::floor(walked.walk->at(t_s).step_phase + 1e-12);
    if (steps > before) ++strikes;
    before = steps;
  }
  EXPECT_EQ(static_cast<std::size_t>(strikes), walked.walk->steps().size());
}

TEST(Walk, CoversItsPathBySpeedAndBySteps) {
  const Walked walked(kCorner, {"1", "2", "3", "1"});
  double by_speed_m = 0.0;
  constexpr double kDt_s = 0.001;
  for (double t_s = 0.0; t_s <= walked.walk->duration_s(); t_s += kDt_s) {
    by_speed_m += walked.walk->at(t_s).speed_mps * kDt_s;
  }
  double by_steps_m = 0.0;
  for (const Walk::Step& step : walked.walk->steps()) by_steps_m += step.length_m;
  EXPECT_NEAR(by_steps_m, walked.walk->path_length_m(), 1e-9);
  EXPECT_NEAR(by_speed_m, walked.walk->path_length_m(), 0.02);
}

TEST(Walk, KeepsTheSpeedItIsGiven) {
  GaitOptions gait;
  gait.speed_mps = 1.15;
  gait.stand_before_s = 0.0;
  gait.step_sigma_ratio = 0.0;
  const Walked walked(kCorner, {"1", "2"}, gait);
  // Shorter first and last steps and whole steps only cost a few per cent.
  EXPECT_NEAR(walked.walk->path_length_m() / walked.walk->duration_s(), 1.15, 0.07);
}

TEST(Walk, TakesStepsByTheLawForTheHeight) {
  Person person;
  person.height_m = 1.85;
  person.step_scale_ratio = 1.1;
  // 1.1 (0.7 + 0.371 * 0.10 + 0.227 * 0.21 * 1.85 / 1.75)
  EXPECT_NEAR(step_length_m(person, 2.0), 0.8662, 1e-4);
}

TEST(Walk, BouncesByWeinbergsLaw) {
  GaitOptions gait;
  gait.bounce_constant = 0.4;
  const Walked walked(kCorner, {"1", "2"}, gait);
  core::Rng rng(1);
  const PhoneHold hold({}, rng);
  const auto steps = walked.walk->steps();
  const double start_s = steps[3].end_s;
  const double end_s = steps[4].end_s;
  double low = 1e9;
  double high = -1e9;
  double sum = 0.0;
  constexpr int kPieces = 400;
  for (int i = 0; i < kPieces; ++i) {
    const double t_s = start_s + (end_s - start_s) * (i + 0.5) / kPieces;
    const double up = gait_acceleration_mps2(walked.walk->at(t_s), 0.0, hold).z();
    low = std::min(low, up);
    high = std::max(high, up);
    sum += up;
  }
  EXPECT_NEAR(high - low, std::pow(steps[4].length_m / 0.4, 4.0), 0.05);
  EXPECT_NEAR(sum / kPieces, 0.0, 1e-6);
}

TEST(Walk, TurnsRoundOnTheSpot) {
  const Walked walked(kCorner, {"1", "2", "1"});
  double turned_rad = 0.0;
  for (double t_s = 0.01; t_s <= walked.walk->duration_s(); t_s += 0.01) {
    const BodyState before = walked.walk->at(t_s - 0.01);
    const BodyState now = walked.walk->at(t_s);
    EXPECT_LT(std::abs(now.heading_rad - before.heading_rad), 0.1);
    EXPECT_LT((now.position_m - before.position_m).norm(), 0.03);
    if (now.speed_mps == 0.0) turned_rad += std::abs(now.heading_rad - before.heading_rad);
  }
  EXPECT_NEAR(turned_rad, 3.1416, 0.2);
}

TEST(Walk, StepsInPlaceForPhotosAndDodges) {
  GaitOptions gait;
  gait.photo_stops = 2.0;
  gait.dodges = 3.0;
  const Walked walked(kCorner, {"1", "2", "3", "1"}, gait);
  double by_steps_m = 0.0;
  int in_place = 0;
  double before_s = 0.0;
  for (const Walk::Step& step : walked.walk->steps()) {
    by_steps_m += step.length_m;
    if (!step.is_effective) {
      ++in_place;
      EXPECT_EQ(step.length_m, 0.0);
      EXPECT_NEAR(step.end_s - before_s, 1.0 / 1.5, 1e-9);
      EXPECT_LT(
          (walked.walk->at(step.end_s).position_m - walked.walk->at(before_s).position_m).norm(),
          1e-9);
    }
    before_s = step.end_s;
  }
  EXPECT_NEAR(by_steps_m, walked.walk->path_length_m(), 1e-9);
  // 3 to 6 s and 1 to 2 s at 1.5 Hz, rounded.
  EXPECT_GE(in_place, 2 * 4 + 3 * 1);
  EXPECT_LE(in_place, 2 * 9 + 3 * 3);
}

TEST(Walk, TurnsAsideAndBackInPlace) {
  GaitOptions gait;
  gait.photo_stops = 1.0;
  const Walked walked(kCorner, {"1", "2"}, gait);
  double most_rad = 0.0;
  double low_mps2 = 0.0;
  double high_mps2 = 0.0;
  core::Rng rng(1);
  const PhoneHold hold({}, rng);
  for (double t_s = 0.01; t_s <= walked.walk->duration_s(); t_s += 0.01) {
    const BodyState now = walked.walk->at(t_s);
    const double turned_rad = now.heading_rad - walked.walk->at(t_s - 0.01).heading_rad;
    EXPECT_LT(std::abs(turned_rad), 0.03);
    if (!now.is_in_place) continue;
    most_rad = std::max(most_rad, std::abs(now.heading_rad));
    const double up_mps2 = gait_acceleration_mps2(now, 0.0, hold).z();
    low_mps2 = std::min(low_mps2, up_mps2);
    high_mps2 = std::max(high_mps2, up_mps2);
  }
  EXPECT_GT(most_rad, 50.0 * 3.1416 / 180.0 - 0.01);
  EXPECT_LT(most_rad, 110.0 * 3.1416 / 180.0 + 0.01);
  EXPECT_GT(high_mps2 - low_mps2, 2.45);
  EXPECT_LT(high_mps2 - low_mps2, 5.5);
  EXPECT_NEAR(walked.walk->at(walked.walk->duration_s()).heading_rad, 0.0, 1e-9);
}

TEST(Walk, GoesStraightThroughWallsWhenTold) {
  GaitOptions gait;
  gait.straight_ways = true;
  const Walked walked(kCorner, {"1", "3"}, gait);
  const core::Vector2 from_m = walked.building.find_point("1")->position_m;
  const core::Vector2 to_m = walked.building.find_point("3")->position_m;
  EXPECT_NEAR(walked.walk->path_length_m(), (to_m - from_m).norm(), 1e-6);
}

TEST(Walk, KeepsTheCadenceItIsGiven) {
  GaitOptions gait;
  gait.cadence_hz = 1.5;
  gait.cadence_sigma_ratio = 0.0;
  gait.end_step_ratio = 1.0;
  gait.step_sigma_ratio = 0.0;
  const Walked walked(kCorner, {"1", "2"}, gait);
  const auto steps = walked.walk->steps();
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_NEAR(steps[i].end_s - steps[i - 1].end_s, 1.0 / 1.5, 1e-9);
    EXPECT_NEAR(steps[i].length_m, steps[0].length_m, 1e-9);
  }
}

TEST(Walk, TapsPlacesInOrderWhereTheyAre) {
  const Walked walked(kCorner, {"1", "2", "3", "2", "1"});
  const auto& taps_s = walked.walk->tap_times_s();
  ASSERT_EQ(taps_s.size(), 5U);
  EXPECT_TRUE(std::is_sorted(taps_s.begin(), taps_s.end()));
  const char* names[] = {"1", "2", "3", "2", "1"};
  for (std::size_t i = 0; i < 5; ++i) {
    const core::Vector2 place_m = walked.building.find_point(names[i])->position_m;
    EXPECT_LT((walked.walk->at(taps_s[i]).position_m - place_m).norm(), 0.8) << i;
  }
}

TEST(Walk, RisesWithTheStairs) {
  const char* two_floors =
      "floor F1 level 0 elevation_m 1\n"
      "########\n#1...^^#\n#....^^#\n########\n"
      "floor F2 level 1 elevation_m 4.5\n"
      "########\n#2...^^#\n#....^^#\n########\n";
  const Walked walked(two_floors, {"F1/1", "F2/2", "F1/1"});
  EXPECT_EQ(walked.walk->at(0.0).elevation_m, 1.0);
  bool was_up = false;
  for (double t_s = 0.0; t_s <= walked.walk->duration_s(); t_s += 0.05) {
    const BodyState body = walked.walk->at(t_s);
    EXPECT_EQ(body.floor.index, body.elevation_m > 2.75 ? 1 : 0) << t_s;
    was_up = was_up || body.elevation_m == 4.5;
  }
  EXPECT_TRUE(was_up);
  EXPECT_EQ(walked.walk->at(walked.walk->duration_s()).elevation_m, 1.0);
}

TEST(Route, NamesThePlaceItCannotReach) {
  const Building building =
      *parse_ascii_building("floor F1 level 0 elevation_m 0\n1..#..2\n", "drawing");
  const std::vector<NavGrid> grids = {NavGrid(building.floors[0].floor)};
  core::Rng rng(1);
  const auto strokes = plan_route(building, grids, {"1", "2"}, {}, rng);
  ASSERT_FALSE(strokes);
  EXPECT_EQ(strokes.error().code, core::ErrorCode::kScenarioInvalid);
  EXPECT_NE(strokes.error().message.find("'2'"), std::string::npos);
}

}  // namespace
}  // namespace waylode::sim::detail
