// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/wknn.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::radio {
namespace {

using core::device_time_from_ms;
using core::FloorId;
using core::TransmitterId;
using core::Vector2;

// Manhattan distance of strengths (rssi + 100) / 100: worked out by hand.
constexpr Matcher::Options kPlainMatcher{.distance = Distance::kManhattan,
                                         .floor_dbm = -100.0F,
                                         .exponent = 1.0F,
                                         .age_decay_per_s = 1.0F};
constexpr WknnEstimator::Options kOptions{.neighbours = 4,
                                          .floor_neighbours = 4,
                                          .weight_exponent = 2.0,
                                          .base_sigma_m = 2.0,
                                          .spread_gain = 0.5,
                                          .min_readings = 2,
                                          .few_readings = 0.0,
                                          .floor_few_readings = 0.0};

/// What transmitters 1, 2, ... were heard with; 0 for not heard.
struct Surveyed {
  std::uint16_t floor;
  Vector2 position_m;
  std::vector<float> rssi_dbm;
};

site::RadioMapStorage map_of(const std::vector<Surveyed>& fingerprints) {
  site::RadioMapBuilder builder;
  for (const Surveyed& surveyed : fingerprints) {
    site::FingerprintRecord record;
    record.floor = surveyed.floor;
    record.x_m = static_cast<float>(surveyed.position_m.x());
    record.y_m = static_cast<float>(surveyed.position_m.y());
    std::vector<site::MapReading> readings;
    for (std::size_t i = 0; i < surveyed.rssi_dbm.size(); ++i) {
      if (surveyed.rssi_dbm[i] != 0.0F) {
        readings.push_back({TransmitterId::wifi(i + 1), surveyed.rssi_dbm[i], 0.0F});
      }
    }
    builder.add(record, std::move(readings));
  }
  return builder.build();
}

Query query_of(const std::vector<float>& rssi_dbm) {
  Query query{device_time_from_ms(7'300), device_time_from_ms(8'000), {}};
  for (std::size_t i = 0; i < rssi_dbm.size(); ++i) {
    if (rssi_dbm[i] != 0.0F) {
      query.readings.push_back({TransmitterId::wifi(i + 1), rssi_dbm[i], 0.0F});
    }
  }
  return query;
}

std::optional<observation::RadioObservation> estimate(
    const std::vector<Surveyed>& survey, const Query& query,
    const WknnEstimator::Options& options = kOptions, std::optional<FloorId> floor = std::nullopt) {
  const auto storage = map_of(survey);
  const auto matcher = Matcher::create(storage.view(), kPlainMatcher);
  return WknnEstimator(*matcher, options).estimate(query, floor);
}

TEST(WknnEstimator, PutsASingleNeighbourWhereItWasSurveyed) {
  const auto seen = estimate({{3, {12.5, -4.25}, {-50.0F, -60.0F}}}, query_of({-55.0F, -70.0F}));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->measured, device_time_from_ms(7'300));
  EXPECT_EQ(seen->delivered, device_time_from_ms(8'000));
  ASSERT_EQ(seen->floors.size(), 1U);
  const auto& hypothesis = seen->floors[0];
  EXPECT_EQ(hypothesis.floor, FloorId{3});
  EXPECT_EQ(hypothesis.position_m, Vector2(12.5, -4.25));
  EXPECT_TRUE(hypothesis.covariance_m2.isApprox(4.0 * core::Matrix2::Identity()));
  EXPECT_NEAR(hypothesis.log_likelihood, 0.0, 1e-12);
  ASSERT_EQ(hypothesis.candidates.size(), 1U);
  EXPECT_EQ(hypothesis.candidates[0].weight, 1.0);
}

TEST(WknnEstimator, MeetsEquallyNearPlacesInTheMiddle) {
  const auto seen = estimate({{0, {0.0, 0.0}, {-40.0F, -60.0F}}, {0, {6.0, 8.0}, {-60.0F, -40.0F}}},
                             query_of({-50.0F, -50.0F}));
  ASSERT_TRUE(seen);
  const auto& hypothesis = seen->floors.at(0);
  EXPECT_NEAR((hypothesis.position_m - Vector2(3.0, 4.0)).norm(), 0.0, 1e-5);
  // Scatter of +-(3, 4): [9 12; 12 16]. 2^2 I + 0.5 * scatter.
  core::Matrix2 expected_m2;
  expected_m2 << 8.5, 6.0, 6.0, 12.0;
  EXPECT_LT((hypothesis.covariance_m2 - expected_m2).norm(), 1e-4);
}

TEST(WknnEstimator, WeighsNeighboursByDistance) {
  // Distances 0.1 and 0.2, squared inverse: weights 0.8 and 0.2.
  const auto seen =
      estimate({{0, {0.0, 1.0}, {-50.0F, -80.0F}}, {0, {10.0, 1.0}, {-20.0F, -80.0F}}},
               query_of({-40.0F, -80.0F}));
  ASSERT_TRUE(seen);
  const auto& hypothesis = seen->floors.at(0);
  ASSERT_EQ(hypothesis.candidates.size(), 2U);
  EXPECT_NEAR(hypothesis.candidates[0].weight, 0.8, 1e-5);
  EXPECT_NEAR(hypothesis.candidates[1].weight, 0.2, 1e-5);
  EXPECT_NEAR(hypothesis.position_m.x(), 2.0, 1e-4);
  // 0.8 * 2^2 + 0.2 * 8^2 = 16 along x; 2^2 + 0.5 * 16.
  EXPECT_NEAR(hypothesis.covariance_m2(0, 0), 12.0, 1e-3);
  EXPECT_NEAR(hypothesis.covariance_m2(1, 1), 4.0, 1e-9);
}

TEST(WknnEstimator, TakesNoMoreThanKNeighbours) {
  WknnEstimator::Options options = kOptions;
  options.neighbours = options.floor_neighbours = 1;
  const auto seen =
      estimate({{0, {0.0, 1.0}, {-50.0F, -80.0F}}, {0, {10.0, 1.0}, {-20.0F, -80.0F}}},
               query_of({-40.0F, -80.0F}), options);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->floors.at(0).position_m, Vector2(0.0, 1.0));
}

TEST(WknnEstimator, LetsTheNearestVoteForTheFloor) {
  // Floor 1 is nearer: weights 0.8 against 0.2; a tenth of the vote is doubt, shared by the floors.
  const std::vector<Surveyed> survey = {{0, {10.0, 1.0}, {-20.0F, -80.0F}},
                                        {1, {0.0, 1.0}, {-50.0F, -80.0F}}};
  const auto seen = estimate(survey, query_of({-40.0F, -80.0F}));
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->floors.size(), 2U);
  EXPECT_EQ(seen->floors[0].floor, FloorId{1});
  EXPECT_NEAR(std::exp(seen->floors[0].log_likelihood), 0.9 * 0.8 + 0.05, 1e-6);
  EXPECT_NEAR(std::exp(seen->floors[1].log_likelihood), 0.9 * 0.2 + 0.05, 1e-6);
}

TEST(WknnEstimator, NeverRulesAFloorOut) {
  WknnEstimator::Options options = kOptions;
  options.floor_neighbours = 1;
  const std::vector<Surveyed> survey = {{0, {10.0, 1.0}, {-20.0F, -80.0F}},
                                        {1, {0.0, 1.0}, {-50.0F, -80.0F}}};
  const auto seen = estimate(survey, query_of({-40.0F, -80.0F}), options);
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->floors.size(), 2U);
  EXPECT_NEAR(std::exp(seen->floors[0].log_likelihood), 0.95, 1e-9);
  EXPECT_NEAR(std::exp(seen->floors[1].log_likelihood), 0.05, 1e-9);
}

TEST(WknnEstimator, TrustsAScanByHowMuchItHeard) {
  // Two readings: trust 2 / (2 + 2) in the place, 2 / (2 + 6) in the floor.
  WknnEstimator::Options options = kOptions;
  options.few_readings = 2.0;
  options.floor_few_readings = 6.0;
  const std::vector<Surveyed> survey = {{0, {10.0, 1.0}, {-20.0F, -80.0F}},
                                        {1, {0.0, 1.0}, {-50.0F, -80.0F}}};
  const auto plain = estimate(survey, query_of({-40.0F, -80.0F}), kOptions);
  const auto wary = estimate(survey, query_of({-40.0F, -80.0F}), options);
  ASSERT_TRUE(plain);
  ASSERT_TRUE(wary);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(wary->floors[i].position_m, plain->floors[i].position_m);
    EXPECT_TRUE(
        wary->floors[i].covariance_m2.isApprox(2.0 * plain->floors[i].covariance_m2, 1e-12));
    EXPECT_NEAR(wary->floors[i].log_likelihood, 0.25 * plain->floors[i].log_likelihood, 1e-12);
  }
}

TEST(WknnEstimator, StaysOnAKnownFloor) {
  const std::vector<Surveyed> survey = {{0, {10.0, 1.0}, {-20.0F, -80.0F}},
                                        {1, {0.0, 1.0}, {-50.0F, -80.0F}}};
  const auto seen = estimate(survey, query_of({-40.0F, -80.0F}), kOptions, FloorId{0});
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->floors.size(), 1U);
  EXPECT_EQ(seen->floors[0].floor, FloorId{0});
  EXPECT_EQ(seen->floors[0].position_m, Vector2(10.0, 1.0));
}

TEST(WknnEstimator, SaysNothingOfTooFewReadings) {
  const std::vector<Surveyed> survey = {{0, {1.0, 2.0}, {-50.0F, -60.0F}}};
  EXPECT_FALSE(estimate(survey, query_of({-50.0F})));
  EXPECT_TRUE(estimate(survey, query_of({-50.0F, -60.0F})));
  EXPECT_FALSE(estimate(survey, query_of({0.0F, 0.0F, -50.0F, -60.0F})));  // None is known.
  EXPECT_FALSE(estimate({}, query_of({-50.0F, -60.0F})));
}

TEST(WknnEstimator, TellsHowMuchOfTheSignalTheMapKnows) {
  const auto seen = estimate({{0, {1.0, 2.0}, {-50.0F}}}, query_of({-40.0F, -60.0F}));
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->known_share_ratio, 0.6, 1e-6);  // 0.6 of 0.6 + 0.4.
}

RC_GTEST_PROP(WknnEstimator, MovesWithTheMap, ()) {
  const Vector2 shift_m(*rc::gen::inRange(-500, 500), *rc::gen::inRange(-500, 500));
  const auto any_rssi = [] { return static_cast<float>(*rc::gen::inRange(-95, -30)); };
  std::vector<Surveyed> survey;
  for (std::uint16_t i = 0; i < 6; ++i) {
    const Vector2 place_m(*rc::gen::inRange(-200, 200), *rc::gen::inRange(-200, 200));
    survey.push_back({static_cast<std::uint16_t>(i / 3), place_m, {any_rssi(), any_rssi()}});
  }
  const Query query = query_of({any_rssi(), any_rssi()});
  const auto here = estimate(survey, query);
  for (Surveyed& surveyed : survey) surveyed.position_m += shift_m;
  const auto there = estimate(survey, query);
  RC_ASSERT(here.has_value() && there.has_value());
  RC_ASSERT(here->floors.size() == there->floors.size());
  for (std::size_t i = 0; i < here->floors.size(); ++i) {
    const auto& a = here->floors[i];
    const auto& b = there->floors[i];
    RC_ASSERT(a.floor == b.floor);
    RC_ASSERT(a.log_likelihood == b.log_likelihood);
    RC_ASSERT((a.position_m + shift_m - b.position_m).norm() < 1e-9);
    RC_ASSERT((a.covariance_m2 - b.covariance_m2).norm() < 1e-6);
  }
}

TEST(WknnEstimator, RefusesOptionsOutOfRange) {
  using Options = WknnEstimator::Options;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE((Options{.neighbours = 0, .floor_neighbours = 0}.validate()));
  EXPECT_FALSE((Options{.neighbours = 201, .floor_neighbours = 5}.validate()));
  EXPECT_FALSE((Options{.neighbours = 5, .floor_neighbours = 6}.validate()));
  for (const double exponent : {-0.1, 20.5, kNan}) {
    EXPECT_FALSE(Options{.weight_exponent = exponent}.validate());
  }
  for (const double sigma_m : {0.0, kNan})
    EXPECT_FALSE(Options{.base_sigma_m = sigma_m}.validate());
  for (const double gain : {-0.1, kNan}) EXPECT_FALSE(Options{.spread_gain = gain}.validate());
}

TEST(WknnEstimator, CallsAScanForeignWhenTheMapKnowsNoneOfItsWifi) {
  const auto storage = map_of({{0, {0.0, 0.0}, {-50.0F, -60.0F}}});
  const auto matcher = Matcher::create(storage.view(), kPlainMatcher);
  const WknnEstimator estimator(*matcher, kOptions);
  EXPECT_TRUE(estimator.is_foreign(query_of({0.0F, 0.0F, -50.0F, -50.0F})));
  EXPECT_FALSE(estimator.is_foreign(query_of({0.0F, 0.0F, -50.0F})));            // Too few.
  EXPECT_FALSE(estimator.is_foreign(query_of({-90.0F, 0.0F, -50.0F, -50.0F})));  // One is known.
  EXPECT_FALSE(estimator.is_foreign(query_of({})));
  Query bluetooth = query_of({});
  for (std::uint64_t i = 0; i < 9; ++i) {
    bluetooth.readings.push_back({TransmitterId::bluetooth(i), -50.0F, 0.0F});
  }
  EXPECT_FALSE(estimator.is_foreign(bluetooth));
}

}  // namespace
}  // namespace waylode::radio
