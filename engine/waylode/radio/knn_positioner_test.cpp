// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/knn_positioner.hpp"

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

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
using Options = KnnPositioner::Options;

std::optional<Positioning> estimate(const std::vector<Surveyed>& survey,
                                    const std::vector<float>& rssi_dbm, const Options& options = {},
                                    std::optional<FloorId> floor = std::nullopt) {
  const ReferenceMap map = make(survey);
  return KnnPositioner(map, options).estimate(query_of(rssi_dbm), floor, std::nullopt);
}

/// To a scan of (-50, -60): 5, 10 and 20 dB away, the last two on floor 1.
const std::vector<Surveyed> kThree = {{0, {0.0, 1.0}, {-53.0F, -56.0F}},
                                      {1, {10.0, 3.0}, {-60.0F, -60.0F}},
                                      {1, {20.0, 8.0}, {-50.0F, -80.0F}}};

TEST(KnnPositioner, TakesThePlainCentroidOfTheNearest) {
  const auto seen = estimate(kThree, {-50.0F, -60.0F}, {.neighbours = 2, .base_sigma_m = 3.0});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 3U);
  EXPECT_EQ(seen->observation.measured, core::device_time_from_ms(7'300));
  EXPECT_EQ(seen->observation.delivered, core::device_time_from_ms(8'000));
  EXPECT_NEAR(seen->observation.known_share_ratio, 1.0, 1e-12);
  ASSERT_EQ(seen->observation.floors.size(), 2U);
  // The two nearest of all are on different floors: a tie, and the order of floors.
  EXPECT_EQ(seen->observation.floors[0].floor, FloorId{0});
  EXPECT_NEAR(seen->observation.floors[0].log_likelihood, std::log(0.5), 1e-12);
  const auto& upper = seen->observation.floors[1];
  EXPECT_NEAR((upper.position_m - Vector2(15.0, 5.5)).norm(), 0.0, 1e-6);
  core::Matrix2 expected_m2;  // 3^2 I and the scatter of +-(5, 2.5).
  expected_m2 << 9.0 + 25.0, 12.5, 12.5, 9.0 + 6.25;
  EXPECT_LT((upper.covariance_m2 - expected_m2).norm(), 1e-5);
}

TEST(KnnPositioner, WeighsByInverseDistance) {
  const auto seen = estimate(kThree, {-50.0F, -60.0F}, {.neighbours = 3, .weighted = true});
  ASSERT_TRUE(seen);
  // Inverse distances 0.2, 0.1, 0.05: floor 0 has 4 of 7 votes, less a tenth of doubt.
  EXPECT_NEAR(std::exp(seen->observation.floors[0].log_likelihood), 0.9 * 4.0 / 7.0 + 0.05, 1e-9);
  const auto& upper = seen->observation.floors[1];
  EXPECT_NEAR(upper.candidates[0].weight, 2.0 / 3.0, 1e-6);
  EXPECT_NEAR(upper.position_m.x(), 10.0 * 2.0 / 3.0 + 20.0 / 3.0, 1e-5);
}

TEST(KnnPositioner, ReturnsThePlaceThatWasHeardExactly) {
  const auto seen = estimate(kThree, {-60.0F, -60.0F}, {.weighted = true}, FloorId{1});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->observation.floors.at(0).position_m, Vector2(10.0, 3.0));
}

TEST(KnnPositioner, StaysOnAKnownFloorAndTakesWhatThereIs) {
  const auto seen = estimate(kThree, {-50.0F, -60.0F}, {.neighbours = 99}, FloorId{1});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 2U);
  ASSERT_EQ(seen->observation.floors.size(), 1U);
  EXPECT_NEAR((seen->observation.floors[0].position_m - Vector2(15.0, 5.5)).norm(), 0.0, 1e-6);
  EXPECT_FALSE(estimate(kThree, {-50.0F, -60.0F}, {}, FloorId{7}));
}

TEST(KnnPositioner, SaysNothingWhereTheMapKnowsNothing) {
  EXPECT_FALSE(estimate(kThree, {}));
  EXPECT_FALSE(estimate(kThree, {0.0F, 0.0F, -50.0F}));
  EXPECT_FALSE(estimate(kThree, {kNan, kNan}));
  EXPECT_FALSE(estimate({}, {-50.0F}));
  EXPECT_FALSE(estimate({{0, {1.0, 1.0}, {-50.0F, 0.0F}}, {0, {5.0, 1.0}, {-50.0F, 0.0F}}},
                        {0.0F, -60.0F}, {.compared = Compared::kCommonMean}));
}

TEST(KnnPositioner, MakesDoWithOneTransmitterAndOneFingerprint) {
  const auto seen = estimate({{4, {2.0, -3.0}, {-70.0F}}}, {-40.0F}, {.base_sigma_m = 1.5});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->observation.floors.at(0).floor, FloorId{4});
  EXPECT_EQ(seen->observation.floors[0].position_m, Vector2(2.0, -3.0));
  EXPECT_TRUE(seen->observation.floors[0].covariance_m2.isApprox(2.25 * core::Matrix2::Identity()));
}

TEST(KnnPositioner, IsHonestAboutItsErrorInAHall) {
  core::Rng rng(311);
  const testing::Hall hall(rng);
  const ReferenceMap map = make(hall.survey);
  const testing::HallErrors errors = testing::errors_in_hall(KnnPositioner(map, {}), rng);
  EXPECT_LT(errors.mean_m, 2.5);
  EXPECT_GT(errors.mean_square_mahalanobis, 1.0);  // Half to twice the variance claimed.
  EXPECT_LT(errors.mean_square_mahalanobis, 4.0);
  EXPECT_NEAR(errors.mean_comparisons, 240.0, 1e-9);
}

TEST(KnnPositioner, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.neighbours = 0}.validate());
  EXPECT_FALSE(Options{.neighbours = 1001}.validate());
  for (const double sigma_m : {0.0, nan}) EXPECT_FALSE(Options{.base_sigma_m = sigma_m}.validate());
  for (const double gain : {-0.1, nan}) EXPECT_FALSE(Options{.spread_gain = gain}.validate());
}

}  // namespace
}  // namespace waylode::radio
