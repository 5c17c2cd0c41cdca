// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/floors_from_marks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace waylode::survey {
namespace {

sample::WaypointSample metre_mark(const char* floor, double x_m, double y_m) {
  sample::WaypointSample mark;
  mark.floor = floor;
  mark.position_m = core::Vector2(x_m, y_m);
  return mark;
}

sample::WaypointSample geo_mark(const char* floor, double latitude_deg, double longitude_deg) {
  sample::WaypointSample mark;
  mark.floor = floor;
  mark.geo_position = core::GeoPoint{latitude_deg, longitude_deg};
  return mark;
}

SurveyedRecording walk(std::vector<sample::Sample> samples) {
  return {"walk", std::move(samples), std::nullopt};
}

TEST(FloorsFromMarks, BoxesTheMarksOfEachFloorWithAMargin) {
  const std::vector<SurveyedRecording> walks = {
      walk({metre_mark("F2", 3.0, 40.0), metre_mark("B1", 1.0, 2.0)}),
      walk({metre_mark("F2", -5.0, 44.0), metre_mark("", 900.0, 900.0)})};
  const auto parts = floors_from_marks("mall", walks);
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->name, "mall");
  EXPECT_FALSE(parts->origin);
  ASSERT_EQ(parts->floors.size(), 2U);
  EXPECT_EQ(parts->floors[0].name, "B1");
  EXPECT_EQ(parts->floors[0].level, -1);
  EXPECT_EQ(parts->floors[1].name, "F2");
  EXPECT_EQ(parts->floors[1].level, 1);
  EXPECT_EQ(parts->floors[1].bounds.min_m, core::Vector2(-15.0, 30.0));
  EXPECT_EQ(parts->floors[1].bounds.max_m, core::Vector2(13.0, 54.0));
}

TEST(FloorsFromMarks, SortsNumberedFloorsByLevelNotByText) {
  const std::vector<SurveyedRecording> walks = {
      walk({metre_mark("-1", 0.0, 0.0), metre_mark("0", 0.0, 0.0), metre_mark("-2", 0.0, 0.0)})};
  const auto parts = floors_from_marks("museum", walks);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->floors.size(), 3U);
  EXPECT_EQ(parts->floors[0].name, "-2");
  EXPECT_EQ(parts->floors[1].name, "-1");
  EXPECT_EQ(parts->floors[2].name, "0");
}

TEST(FloorsFromMarks, MeasuresEastAndNorthOfTheFirstGeoreferencedMark) {
  // At the equator, one degree of longitude is pi / 180 * a = 111319.49 m (a = 6378137 m).
  constexpr double kEquatorialRadius_m = 6378137.0;
  constexpr double kStep_deg = 0.001;
  const std::vector<SurveyedRecording> walks = {
      walk({geo_mark("0", 0.0, 20.0), geo_mark("0", 0.0, 20.0 + kStep_deg)})};
  const auto parts = floors_from_marks("museum", walks);
  ASSERT_TRUE(parts);
  ASSERT_TRUE(parts->origin);
  EXPECT_EQ(*parts->origin, (core::GeoPoint{0.0, 20.0}));
  const double east_m = kEquatorialRadius_m * std::sin(kStep_deg * std::numbers::pi / 180.0);
  EXPECT_NEAR(parts->floors[0].bounds.max_m.x(), east_m + 10.0, 1e-6);
  EXPECT_NEAR(parts->floors[0].bounds.min_m.x(), -10.0, 1e-6);
}

TEST(FloorsFromMarks, PutsMarksWhereTheSiteFindsThem) {
  const std::vector<SurveyedRecording> walks = {
      walk({geo_mark("-1", 48.10, 11.50), geo_mark("0", 48.101, 11.502)})};
  auto parts = floors_from_marks("museum", walks);
  ASSERT_TRUE(parts);
  const site::Site site(*std::move(parts));
  const auto placed = place_waypoints(site, walks[0].samples, std::nullopt);
  ASSERT_EQ(placed.size(), 2U);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const auto& mark = std::get<sample::WaypointSample>(walks[0].samples[i]);
    EXPECT_EQ(site.floor(placed[i].floor).name, mark.floor);
    EXPECT_TRUE(site.floor(placed[i].floor).bounds.contains(placed[i].position_m));
    const auto back = site.geo_from_floor(placed[i].floor, placed[i].position_m);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->latitude_deg, mark.geo_position->latitude_deg, 1e-9);
    EXPECT_NEAR(back->longitude_deg, mark.geo_position->longitude_deg, 1e-9);
  }
}

TEST(FloorsFromMarks, RefusesWalksWhoseMarksNameNoFloor) {
  const std::vector<SurveyedRecording> walks = {walk({metre_mark("", 1.0, 2.0)})};
  const auto parts = floors_from_marks("mall", walks);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.error().code, core::ErrorCode::kSurveyInsufficient);
  EXPECT_EQ(parts.error().place, "mall");
}

TEST(FloorsFromMarks, RefusesToMixFrames) {
  const std::vector<SurveyedRecording> walks = {
      walk({metre_mark("F1", 1.0, 2.0), geo_mark("F1", 48.1, 11.5)})};
  const auto parts = floors_from_marks("mall", walks);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.error().code, core::ErrorCode::kSurveyInsufficient);
}

}  // namespace
}  // namespace waylode::survey
