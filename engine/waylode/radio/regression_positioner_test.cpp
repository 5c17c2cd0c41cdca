// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/regression_positioner.hpp"

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
using Options = RegressionPositioner::Options;
using Kind = RegressionPositioner::Kind;

ReferenceMap make(const std::vector<Surveyed>& survey) {
  const site::RadioMapStorage storage = map_of(survey);
  return *ReferenceMap::create(storage.view(), {});
}

/// Strengths that rise with x and y by 1 dB per metre, on a grid of 8 x 6 places.
std::vector<Surveyed> slopes(std::uint16_t floor, float offset_dbm) {
  std::vector<Surveyed> survey;
  for (int i = 0; i < 48; ++i) {
    const Vector2 place_m(2.0 * (i % 8), 2.0 * (i / 8));
    survey.push_back({floor,
                      place_m,
                      {offset_dbm + static_cast<float>(place_m.x()),
                       offset_dbm + static_cast<float>(place_m.y())}});
  }
  return survey;
}

TEST(RegressionPositioner, LearnsWhereStrengthsComeFrom) {
  const ReferenceMap map = make(slopes(3, -80.0F));
  const auto positioner = RegressionPositioner::create(map, {.margin_m = 1.0});
  ASSERT_TRUE(positioner);
  const auto seen = positioner->estimate(query_of({-75.0F, -73.0F}), std::nullopt, std::nullopt);
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->observation.floors.size(), 1U);
  const auto& floor = seen->observation.floors[0];
  EXPECT_EQ(floor.floor, FloorId{3});
  EXPECT_NEAR((floor.position_m - Vector2(5.0, 7.0)).norm(), 0.0, 0.3);
  EXPECT_TRUE(core::is_valid_covariance(floor.covariance_m2));
  EXPECT_GE(floor.covariance_m2(0, 0), 0.25);
  EXPECT_EQ(seen->comparisons, positioner->vector_count());
  EXPECT_EQ(seen->observation.measured, core::device_time_from_ms(7'300));
}

TEST(RegressionPositioner, StaysWithinTheMarginOfItsPoints) {
  const ReferenceMap map = make(slopes(0, -80.0F));
  const auto positioner = RegressionPositioner::create(map, {.margin_m = 0.25});
  ASSERT_TRUE(positioner);
  for (const float rssi_dbm : {-99.0F, -20.0F}) {
    const auto seen =
        positioner->estimate(query_of({rssi_dbm, rssi_dbm}), std::nullopt, std::nullopt);
    ASSERT_TRUE(seen);
    const Vector2 place_m = seen->observation.floors.at(0).position_m;
    EXPECT_TRUE((core::Bounds2{{-0.25, -0.25}, {14.25, 10.25}}.contains(place_m)));
  }
}

TEST(RegressionPositioner, LetsTheNearestVoteForTheFloor) {
  std::vector<Surveyed> survey = slopes(0, -80.0F);
  for (const Surveyed& surveyed : slopes(1, -60.0F)) survey.push_back(surveyed);
  const ReferenceMap map = make(survey);
  const auto positioner = RegressionPositioner::create(map, {});
  ASSERT_TRUE(positioner);
  const auto seen = positioner->estimate(query_of({-55.0F, -53.0F}), std::nullopt, std::nullopt);
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->observation.floors.size(), 2U);
  EXPECT_EQ(seen->observation.floors[0].floor, FloorId{1});
  EXPECT_NEAR(std::exp(seen->observation.floors[0].log_likelihood), 0.95, 1e-9);
  EXPECT_EQ(seen->comparisons, positioner->vector_count() + 96U);
  const auto known = positioner->estimate(query_of({-55.0F, -53.0F}), FloorId{0}, std::nullopt);
  ASSERT_TRUE(known);
  ASSERT_EQ(known->observation.floors.size(), 1U);
  EXPECT_EQ(known->observation.floors[0].floor, FloorId{0});
}

TEST(RegressionPositioner, MergesPointsThatAreTooMany) {
  const ReferenceMap map = make(slopes(0, -80.0F));
  const auto positioner =
      RegressionPositioner::create(map, {.kind = Kind::kSupportVectors, .max_points = 12});
  ASSERT_TRUE(positioner);
  EXPECT_LE(positioner->vector_count(), 2U * 12U);
  EXPECT_TRUE(positioner->estimate(query_of({-75.0F, -73.0F}), std::nullopt, std::nullopt));
}

TEST(RegressionPositioner, ChoosesTheTransmittersThatVary) {
  std::vector<Surveyed> survey = slopes(0, -80.0F);
  for (Surveyed& surveyed : survey) surveyed.rssi_dbm.insert(surveyed.rssi_dbm.begin(), -30.0F);
  const ReferenceMap map = make(survey);
  const auto positioner =
      RegressionPositioner::create(map, {.max_transmitters = 2, .margin_m = 1.0});
  ASSERT_TRUE(positioner);
  const auto seen =
      positioner->estimate(query_of({-30.0F, -75.0F, -73.0F}), std::nullopt, std::nullopt);
  ASSERT_TRUE(seen);
  EXPECT_NEAR((seen->observation.floors.at(0).position_m - Vector2(5.0, 7.0)).norm(), 0.0, 0.3);
  // Of the two that it listens to, none is heard.
  EXPECT_FALSE(positioner->estimate(query_of({-30.0F}), std::nullopt, std::nullopt));
}

TEST(RegressionPositioner, AnswersWithTheMeanOfTooFewPoints) {
  const ReferenceMap map = make({{0, {1.0, 2.0}, {-50.0F}}, {0, {4.0, 6.0}, {-60.0F}}});
  const auto positioner = RegressionPositioner::create(map, {.min_sigma_m = 0.5});
  ASSERT_TRUE(positioner);
  const auto seen = positioner->estimate(query_of({-50.0F}), std::nullopt, std::nullopt);
  ASSERT_TRUE(seen);
  EXPECT_NEAR((seen->observation.floors.at(0).position_m - Vector2(2.5, 4.0)).norm(), 0.0, 1e-6);
  core::Matrix2 expected_m2;  // The scatter of +-(1.5, 2), and 0.5^2 I.
  expected_m2 << 2.25 + 0.25, 3.0, 3.0, 4.0 + 0.25;
  EXPECT_LT((seen->observation.floors[0].covariance_m2 - expected_m2).norm(), 1e-5);
}

TEST(RegressionPositioner, SaysNothingWhereTheMapKnowsNothing) {
  const ReferenceMap map = make(slopes(0, -80.0F));
  const auto positioner = RegressionPositioner::create(map, {});
  ASSERT_TRUE(positioner);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& scan :
       {std::vector<float>{}, std::vector<float>{0.0F, 0.0F, -50.0F}, std::vector<float>{nan}}) {
    EXPECT_FALSE(positioner->estimate(query_of(scan), std::nullopt, std::nullopt));
  }
  EXPECT_FALSE(positioner->estimate(query_of({-70.0F, -70.0F}), FloorId{9}, std::nullopt));
}

/// The simulation of [Zhao2019] 3: a corridor of 16.15 m x 3.7 m, four transmitters on either side,
/// 48 places at 1 m, one scan each; exponent 2, noise of 2 dB.
std::vector<float> corridor_scan(const Vector2& place_m, core::Rng& rng) {
  std::vector<float> rssi_dbm;
  for (int i = 0; i < 8; ++i) {
    const Vector2 at_m(2.075 + 4.0 * (i % 4), i < 4 ? 0.0 : 3.7);
    const double away_m = std::max(0.3, (place_m - at_m).norm());
    rssi_dbm.push_back(
        static_cast<float>(-35.0 - 20.0 * std::log10(away_m / 2.0) + 2.0 * rng.normal()));
  }
  return rssi_dbm;
}

struct CorridorErrors {
  double mean_m = 0.0;
  double share_within_1_5_m = 0.0;
};

CorridorErrors errors_in_corridor(Kind kind) {
  core::Rng rng(337);
  std::vector<Surveyed> survey;
  for (int i = 0; i < 48; ++i) {
    const Vector2 place_m(0.575 + i / 3, 0.85 + i % 3);
    survey.push_back({0, place_m, corridor_scan(place_m, rng)});
  }
  const ReferenceMap map = make(survey);
  const auto positioner = RegressionPositioner::create(map, {.kind = kind});
  CorridorErrors errors;
  constexpr int kScans = 600;
  for (int i = 0; i < kScans; ++i) {
    const Vector2 truth_m(rng.uniform(0.0, 16.15), rng.uniform(0.0, 3.7));
    const auto seen =
        positioner->estimate(query_of(corridor_scan(truth_m, rng)), std::nullopt, std::nullopt);
    const double error_m = (seen->observation.floors.at(0).position_m - truth_m).norm();
    errors.mean_m += error_m / kScans;
    if (error_m <= 1.5) errors.share_within_1_5_m += 1.0 / kScans;
  }
  return errors;
}

TEST(RegressionPositioner, ReachesThePublishedErrorsInTheirCorridor) {
  // Published: relevance vectors 89.6 % within 1.5 m and 1.42 m on average; support vectors 73.5 %.
  const CorridorErrors relevance = errors_in_corridor(Kind::kRelevanceVectors);
  EXPECT_GE(relevance.share_within_1_5_m, 0.896);
  EXPECT_LE(relevance.mean_m, 1.42);
  const CorridorErrors support = errors_in_corridor(Kind::kSupportVectors);
  EXPECT_NEAR(support.share_within_1_5_m, 0.735, 0.08);
}

TEST(RegressionPositioner, IsHonestAboutItsErrorInAHall) {
  core::Rng rng(331);
  const testing::Hall hall(rng);
  const ReferenceMap map = make(hall.survey);
  const auto positioner = RegressionPositioner::create(map, {});
  ASSERT_TRUE(positioner);
  const testing::HallErrors errors = testing::errors_in_hall(*positioner, rng);
  EXPECT_LT(errors.mean_m, 2.5);
  EXPECT_GT(errors.mean_square_mahalanobis, 1.0);  // Half to twice the variance claimed.
  EXPECT_LT(errors.mean_square_mahalanobis, 4.0);
}

TEST(RegressionPositioner, RefusesAnEmptyMapAndOptionsOutOfRange) {
  const ReferenceMap empty = make({});
  const auto refused = RegressionPositioner::create(empty, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, core::ErrorCode::kMapMissing);
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.max_transmitters = 0}.validate());
  EXPECT_FALSE(Options{.max_points = 4}.validate());
  EXPECT_FALSE(Options{.floor_neighbours = 0}.validate());
  EXPECT_FALSE(Options{.scan_sigma_db = -0.1}.validate());
  EXPECT_FALSE(Options{.unknown_sigma_m = -0.1}.validate());
  EXPECT_FALSE(Options{.min_sigma_m = 0.0}.validate());
  EXPECT_FALSE(Options{.margin_m = std::numeric_limits<double>::quiet_NaN()}.validate());
  Options options;
  options.relevance.kernel.gauss_rate = -1.0;
  EXPECT_FALSE(options.validate());
}

}  // namespace
}  // namespace waylode::radio
