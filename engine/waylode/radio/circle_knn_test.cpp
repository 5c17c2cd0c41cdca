// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/circle_knn.hpp"

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

using Options = CircleKnn::Options;

core::Belief belief_at(std::uint16_t floor, const Vector2& position_m) {
  core::Belief belief;
  belief.floor = FloorId{floor};
  belief.position_m = position_m;
  return belief;
}

/// Places 1 m apart along a corridor, 1 dB each.
std::vector<Surveyed> corridor() {
  std::vector<Surveyed> survey;
  for (int i = 0; i < 20; ++i) {
    survey.push_back({0, {1.0 * i, 0.5}, {-40.0F - static_cast<float>(i), -70.0F}});
  }
  survey.push_back({1, {10.0, 0.5}, {-50.0F, -70.0F}});
  return survey;
}

std::optional<Positioning> estimate(const std::vector<float>& rssi_dbm,
                                    const std::optional<core::Belief>& prior,
                                    const Options& options = {},
                                    std::optional<FloorId> floor = std::nullopt) {
  const ReferenceMap map = make(corridor());
  return CircleKnn(map, options).estimate(query_of(rssi_dbm), floor, prior);
}

TEST(CircleKnn, ComparesWithinTheCircleAndOnIt) {
  // Places 8 to 12; 14 would be nearest of all.
  const auto seen = estimate({-54.0F, -70.0F}, belief_at(0, {10.0, 0.5}));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 5U);
  ASSERT_EQ(seen->observation.floors.size(), 1U);
  EXPECT_EQ(seen->observation.floors[0].floor, FloorId{0});
  // Distances 2, 3, 4, 5 dB to the places 12, 11, 10, 9.
  const double total = 1.0 / 2 + 1.0 / 3 + 1.0 / 4 + 1.0 / 5;
  EXPECT_NEAR(seen->observation.floors[0].position_m.x(),
              (12.0 / 2 + 11.0 / 3 + 10.0 / 4 + 9.0 / 5) / total, 1e-5);
}

TEST(CircleKnn, TakesFewerNeighboursFromASmallCircle) {
  const auto seen = estimate({-54.0F, -70.0F}, belief_at(0, {10.4, 0.5}), {.radius_m = 0.7});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 2U);
  // 3 dB to place 11, 4 dB to place 10.
  EXPECT_NEAR(seen->observation.floors.at(0).position_m.x(), (11.0 / 3 + 10.0 / 4) / (7.0 / 12),
              1e-5);
}

TEST(CircleKnn, SaysNothingWhenTheCircleIsEmpty) {
  EXPECT_FALSE(estimate({-54.0F, -70.0F}, belief_at(0, {10.0, 9.0})));
  EXPECT_FALSE(estimate({-54.0F, -70.0F}, belief_at(5, {10.0, 0.5})));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(estimate({-54.0F, -70.0F}, belief_at(0, {nan, 0.5})));
}

TEST(CircleKnn, SearchesAllWithoutAPrior) {
  const auto seen = estimate({-54.0F, -70.0F}, std::nullopt, {.neighbours = 1});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 21U);
  EXPECT_EQ(seen->observation.floors.at(0).position_m, Vector2(14.0, 0.5));
}

TEST(CircleKnn, DoesNotCarryAPriorToAnotherFloor) {
  const auto seen =
      estimate({-54.0F, -70.0F}, belief_at(1, {10.0, 0.5}), {.neighbours = 1}, FloorId{0});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 20U);
  EXPECT_EQ(seen->observation.floors.at(0).position_m, Vector2(14.0, 0.5));
}

TEST(CircleKnn, SaysNothingWhereTheMapKnowsNothing) {
  const auto prior = belief_at(0, {10.0, 0.5});
  EXPECT_FALSE(estimate({}, prior));
  EXPECT_FALSE(estimate({0.0F, 0.0F, -50.0F}, prior));
  EXPECT_FALSE(estimate({std::numeric_limits<float>::quiet_NaN()}, prior));
}

TEST(CircleKnn, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.radius_m = 0.0}.validate());
  EXPECT_FALSE(Options{.radius_m = std::numeric_limits<double>::quiet_NaN()}.validate());
  EXPECT_FALSE(Options{.neighbours = 0}.validate());
}

}  // namespace
}  // namespace waylode::radio
