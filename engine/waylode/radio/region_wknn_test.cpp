// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/region_wknn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/radio/knn_positioner.hpp"
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

using Options = RegionWknn::Options;

std::optional<Positioning> estimate(const std::vector<Surveyed>& survey,
                                    const std::vector<float>& rssi_dbm, const Options& options,
                                    std::optional<FloorId> floor = std::nullopt) {
  const ReferenceMap map = make(survey);
  return RegionWknn(map, options).estimate(query_of(rssi_dbm), floor, std::nullopt);
}

/// Transmitter 1 is strongest at the first three points, 2 at the fourth, 3 at the last.
const std::vector<Surveyed> kSurvey = {{0, {0.0, 0.0}, {-40.0F, -70.0F, -90.0F}},
                                       {0, {3.0, 0.0}, {-46.0F, -66.0F, -90.0F}},
                                       {0, {6.0, 0.0}, {-52.0F, -62.0F, -90.0F}},
                                       {0, {9.0, 0.0}, {-58.0F, -57.0F, -90.0F}},
                                       {0, {40.0, 0.0}, {-90.0F, -90.0F, -40.0F}}};

TEST(RegionWknn, ComparesOnlyWhereTheSameTransmitterIsStrongest) {
  // To (-43, -68, -90): 3.61, 3.61 and 10.8 dB in the region.
  const auto seen = estimate(kSurvey, {-43.0F, -68.0F, -90.0F}, {.neighbours = 2});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 3U);
  EXPECT_NEAR(seen->observation.floors.at(0).position_m.x(), 1.5, 1e-5);
}

TEST(RegionWknn, WeighsByInverseDistance) {
  // To (-42, -70, -90): 2 dB and sqrt(16 + 16) = 5.657 dB.
  const auto seen = estimate(kSurvey, {-42.0F, -70.0F, -90.0F}, {.neighbours = 2});
  ASSERT_TRUE(seen);
  const double near = 1.0 / 2.0;
  const double far = 1.0 / std::sqrt(32.0);
  EXPECT_NEAR(seen->observation.floors.at(0).position_m.x(), 3.0 * far / (near + far), 1e-5);
}

TEST(RegionWknn, TakesTheNextRegionsWhenOneIsTooSmall) {
  const auto seen = estimate(kSurvey, {-59.0F, -56.0F, -90.0F}, {.neighbours = 4});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 4U);  // Of transmitter 2, then of 1.
  const auto exact = estimate(kSurvey, {-58.0F, -57.0F, -90.0F}, {.neighbours = 1});
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->comparisons, 1U);
  EXPECT_EQ(exact->observation.floors.at(0).position_m, Vector2(9.0, 0.0));
}

TEST(RegionWknn, SearchesTheWholeMapAtLast) {
  // No point has transmitter 4 for its strongest, or any that was heard here.
  std::vector<Surveyed> survey = kSurvey;
  for (Surveyed& surveyed : survey) surveyed.rssi_dbm.push_back(-95.0F);
  const auto seen = estimate(survey, {0.0F, 0.0F, 0.0F, -95.0F}, {.neighbours = 3});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->comparisons, 5U);
  const auto more = estimate(kSurvey, {-43.0F, -68.0F, -90.0F}, {.neighbours = 9});
  ASSERT_TRUE(more);
  EXPECT_EQ(more->comparisons, 5U);
}

TEST(RegionWknn, StaysOnAKnownFloor) {
  std::vector<Surveyed> survey = kSurvey;
  survey.push_back({1, {70.0, 5.0}, {-42.0F, -71.0F, -90.0F}});
  const auto seen = estimate(survey, {-42.0F, -71.0F, -90.0F}, {.neighbours = 1}, FloorId{0});
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->observation.floors.size(), 1U);
  EXPECT_EQ(seen->observation.floors[0].position_m, Vector2(0.0, 0.0));
  const auto both = estimate(survey, {-42.0F, -71.0F, -90.0F}, {.neighbours = 1});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->observation.floors.at(0).floor, FloorId{1});
}

TEST(RegionWknn, SaysNothingWhereTheMapKnowsNothing) {
  EXPECT_FALSE(estimate(kSurvey, {}, {}));
  EXPECT_FALSE(estimate(kSurvey, {0.0F, 0.0F, 0.0F, -50.0F}, {}));
  EXPECT_FALSE(estimate({}, {-50.0F}, {}));
  EXPECT_FALSE(estimate(kSurvey, {-50.0F}, {}, FloorId{3}));
  EXPECT_FALSE(estimate(kSurvey, {std::numeric_limits<float>::quiet_NaN()}, {}));
}

TEST(RegionWknn, IsAsGoodAsAFullSearchForAQuarterOfTheComparisons) {
  core::Rng rng(313);
  const testing::Hall hall(rng);
  const ReferenceMap map = make(hall.survey);
  core::Rng scans_of_region(17);
  core::Rng scans_of_all(17);
  const auto region = testing::errors_in_hall(RegionWknn(map, {}), scans_of_region);
  const auto all = testing::errors_in_hall(KnnPositioner(map, {.neighbours = 4, .weighted = true}),
                                           scans_of_all);
  EXPECT_LT(region.mean_m, 1.1 * all.mean_m);
  EXPECT_NEAR(region.mean_comparisons, all.mean_comparisons / 4.0, all.mean_comparisons / 20.0);
  EXPECT_GT(region.mean_square_mahalanobis, 1.0);
  EXPECT_LT(region.mean_square_mahalanobis, 4.0);
}

TEST(RegionWknn, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.neighbours = 0}.validate());
  EXPECT_FALSE(Options{.base_sigma_m = 0.0}.validate());
}

}  // namespace
}  // namespace waylode::radio
