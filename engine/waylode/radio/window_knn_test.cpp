// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/window_knn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/radio/testing/surveyed_map.hpp"

namespace waylode::radio {
namespace {

using core::FloorId;
using core::Vector2;
using testing::map_of;
using testing::query_of;
using testing::Surveyed;

ReferenceMap make(const std::vector<Surveyed>& survey) {
  const site::RadioMapStorage storage = map_of(survey);
  return *ReferenceMap::create(storage.view(), {});
}

using Options = WindowKnn::Options;

std::optional<Positioning> estimate(const std::vector<Surveyed>& survey,
                                    const std::vector<float>& rssi_dbm, const Options& options = {},
                                    std::optional<FloorId> floor = std::nullopt) {
  const ReferenceMap map = make(survey);
  return WindowKnn(map, options).estimate(query_of(rssi_dbm), floor, std::nullopt);
}

/// To a scan of (-50, -60, -80), windows +-5, +-7 and +-10: 3, 2, 1 and 0 hits.
const std::vector<Surveyed> kSurvey = {{0, {1.0, 0.0}, {-54.0F, -66.0F, -89.0F}},
                                       {0, {4.0, 0.0}, {-54.5F, -60.0F, -90.5F}},
                                       {0, {7.0, 0.0}, {-50.0F, -67.0F, -95.0F}},
                                       {0, {11.0, 0.0}, {-56.0F, -68.0F, -91.0F}}};
const std::vector<float> kScan = {-50.0F, -60.0F, -80.0F};

TEST(WindowKnn, KeepsThePointsWithTheMostHitsOrOneFewer) {
  const auto seen = estimate(kSurvey, kScan);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 2U);
  // Fewer than the 4 neighbours: the centroid of the 2 that there are.
  EXPECT_NEAR(seen->observation.floors.at(0).position_m.x(), 2.5, 1e-6);
  const auto strict = estimate(kSurvey, kScan, {.slack_hits = 0});
  ASSERT_TRUE(strict);
  EXPECT_EQ(strict->comparisons, 1U);
  EXPECT_EQ(strict->observation.floors.at(0).position_m, Vector2(1.0, 0.0));
}

TEST(WindowKnn, CanAskForAllHits) {
  const auto seen = estimate(kSurvey, kScan, {.keep = WindowKnn::Keep::kAllHits});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 1U);
}

TEST(WindowKnn, LeavesTheBoundsOfAWindowOut) {
  const std::vector<Surveyed> survey = {
      {0, {0.0, 0.0}, {-55.0F}}, {0, {5.0, 0.0}, {-54.5F}}, {0, {9.0, 0.0}, {-45.0F}}};
  const auto seen = estimate(survey, {-50.0F});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 1U);
  EXPECT_EQ(seen->observation.floors.at(0).position_m, Vector2(5.0, 0.0));
}

TEST(WindowKnn, TakesTheWindowOfTheLevelHeard) {
  // 8.5 dB off: outside at -60 (7 dB), inside at -75 (10 dB), and 11 dB at -90 (12 dB).
  const auto kept = [](float heard_dbm, float off_db) {
    const std::vector<Surveyed> survey = {{0, {0.0, 0.0}, {heard_dbm - off_db, -40.0F}},
                                          {0, {9.0, 0.0}, {-99.5F, -40.0F}}};
    return estimate(survey, {heard_dbm, -40.0F}, {.slack_hits = 0})->comparisons;
  };
  EXPECT_EQ(kept(-60.0F, 8.5F), 2U);  // Both have but the hit of the other transmitter.
  EXPECT_EQ(kept(-75.0F, 8.5F), 1U);
  EXPECT_EQ(kept(-90.0F, -11.0F), 2U);  // -99.5 is within 12 dB of -90, too.
  EXPECT_EQ(kept(-86.0F, -11.0F), 1U);
  EXPECT_EQ(kept(-84.0F, -11.0F), 2U);
}

TEST(WindowKnn, ReachesAsFarBelowAndAboveAsItsTableSays) {
  const Options options{.windows = {{-127.0F, 9.0F, 3.0F}}, .slack_hits = 0};
  const std::vector<Surveyed> survey = {
      {0, {0.0, 0.0}, {-58.0F}}, {0, {5.0, 0.0}, {-48.0F}}, {0, {9.0, 0.0}, {-46.0F}}};
  const auto seen = estimate(survey, {-50.0F}, options);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 2U);
  EXPECT_NEAR(seen->observation.floors.at(0).position_m.x(), 2.5, 1e-6);
}

TEST(WindowKnn, CountsOnlyTheStrongestOfTheScan) {
  // By the strongest alone the first and third points hit; -50 is exactly the third's.
  const auto seen = estimate(kSurvey, kScan, {.strongest = 1, .neighbours = 1});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 3U);
  EXPECT_EQ(seen->observation.floors.at(0).position_m, Vector2(7.0, 0.0));
}

TEST(WindowKnn, TakesThePlainCentroidOfTheNearestKept) {
  std::vector<Surveyed> survey = kSurvey;
  survey.push_back({0, {20.0, 2.0}, {-50.0F, -60.0F, -80.0F}});
  survey.push_back({0, {30.0, 4.0}, {-50.0F, -60.0F, -81.0F}});
  const auto seen = estimate(survey, kScan, {.neighbours = 2});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 4U);
  EXPECT_NEAR((seen->observation.floors.at(0).position_m - Vector2(25.0, 3.0)).norm(), 0.0, 1e-5);
}

TEST(WindowKnn, ComparesAllWhenNoPointHits) {
  const std::vector<Surveyed> survey = {{0, {0.0, 0.0}, {-90.0F}}, {0, {5.0, 0.0}, {-80.0F}}};
  for (const auto keep : {WindowKnn::Keep::kMostHits, WindowKnn::Keep::kAllHits}) {
    const auto seen = estimate(survey, {-40.0F}, {.keep = keep, .neighbours = 1});
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->comparisons, 2U);
    EXPECT_EQ(seen->observation.floors.at(0).position_m, Vector2(5.0, 0.0));
  }
}

TEST(WindowKnn, SaysNothingWhereTheMapKnowsNothing) {
  EXPECT_FALSE(estimate(kSurvey, {}));
  EXPECT_FALSE(estimate({}, kScan));
  EXPECT_FALSE(estimate(kSurvey, kScan, {}, FloorId{4}));
  EXPECT_FALSE(estimate(kSurvey, {0.0F, 0.0F, 0.0F, -40.0F}));
  EXPECT_FALSE(estimate(kSurvey, {std::numeric_limits<float>::quiet_NaN()}));
}

TEST(WindowKnn, IsHonestAboutItsErrorInAHall) {
  core::Rng rng(317);
  const testing::Hall hall(rng);
  const ReferenceMap map = make(hall.survey);
  const testing::HallErrors errors = testing::errors_in_hall(WindowKnn(map, {}), rng);
  EXPECT_LT(errors.mean_m, 2.5);
  EXPECT_LT(errors.mean_comparisons, 120.0);
  EXPECT_GT(errors.mean_square_mahalanobis, 1.0);
  EXPECT_LT(errors.mean_square_mahalanobis, 4.0);
}

TEST(WindowKnn, RefusesOptionsOutOfRange) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.windows = {}}.validate());
  EXPECT_FALSE((Options{.windows = {{-55.0F, 0.0F, 5.0F}}}.validate()));
  EXPECT_FALSE((Options{.windows = {{-55.0F, 5.0F, nan}}}.validate()));
  EXPECT_FALSE((Options{.windows = {{-55.0F, 5.0F, 5.0F}, {-55.0F, 5.0F, 5.0F}}}.validate()));
  EXPECT_FALSE(Options{.strongest = 0}.validate());
  EXPECT_FALSE(Options{.neighbours = 0}.validate());
}

}  // namespace
}  // namespace waylode::radio
