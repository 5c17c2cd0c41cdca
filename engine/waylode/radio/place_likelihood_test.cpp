// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/place_likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/radio/testing/surveyed_map.hpp"

namespace waylode::radio {
namespace {

using core::FloorId;
using core::Vector2;
using testing::map_of;
using testing::query_of;
using testing::Surveyed;

/// A corridor of 40 m on floor 0, transmitter 1 loud at its west end and 2 at its east end; one
/// fingerprint on floor 1 that hears transmitter 3 alone.
std::vector<Surveyed> corridor() {
  std::vector<Surveyed> survey;
  for (int i = 0; i <= 20; ++i) {
    const float x_m = 2.0F * static_cast<float>(i);
    survey.push_back({0, Vector2(x_m, 3.0), {-50.0F - x_m, -90.0F + x_m}});
  }
  survey.push_back({1, Vector2(7.0, 7.0), {0.0F, 0.0F, -60.0F}});
  return survey;
}

struct Places {
  explicit Places(const PlaceLikelihood::Options& options = {})
      : storage(map_of(corridor())),
        matcher(Matcher::create(storage.view(), {}).value()),
        likelihood(PlaceLikelihood::create(matcher, options).value()) {}

  /// Of an observation with the two floors this likely.
  observation::RadioObservation with_rasters(const Query& query, double log_floor_0 = 0.0,
                                             double log_floor_1 = -2.0) const {
    observation::RadioObservation observation;
    observation.floors.resize(2);
    observation.floors[0].floor = FloorId{0};
    observation.floors[0].log_likelihood = log_floor_0;
    observation.floors[1].floor = FloorId{1};
    observation.floors[1].log_likelihood = log_floor_1;
    likelihood.add_rasters(query, observation);
    return observation;
  }

  site::RadioMapStorage storage;
  Matcher matcher;
  PlaceLikelihood likelihood;
};

const std::vector<float> kHeardAt30m = {-80.0F, -60.0F};

TEST(PlaceLikelihood, IsHighestWhereTheSameWasHeard) {
  for (const auto& [candidates, signal] : {std::pair(0.5, 0.5), {1.0, 0.0}, {0.0, 1.0}}) {
    PlaceLikelihood::Options options;
    options.candidates_weight = candidates;
    options.signal_weight = signal;
    options.candidate_sigma_m = 3.0;
    const auto observation = Places(options).with_rasters(query_of(kHeardAt30m));
    const auto& raster = observation.floors[0].raster;
    ASSERT_NE(raster, nullptr);
    EXPECT_GT(raster->at({30.0, 3.0}), raster->at({20.0, 3.0})) << candidates;
    EXPECT_GT(raster->at({20.0, 3.0}), raster->at({4.0, 3.0})) << candidates;
  }
}

TEST(PlaceLikelihood, SpreadsItsShareOverTheFloor) {
  // Far from all candidates nothing is left but the share: of the kernels' mass, per node.
  PlaceLikelihood::Options options;
  options.candidates = 1;
  options.candidate_sigma_m = 2.0;
  options.elsewhere_share = 0.2;
  options.candidates_weight = 1.0;
  options.signal_weight = 0.0;
  const auto raster = Places(options).with_rasters(query_of(kHeardAt30m)).floors[0].raster;
  ASSERT_NE(raster, nullptr);
  const double nodes = static_cast<double>(raster->columns * raster->rows);
  const double mass_nodes = 2.0 * std::acos(-1.0) * 4.0 / (raster->node_m * raster->node_m);
  EXPECT_NEAR(raster->at({0.0, 3.0}), std::log(0.25 * mass_nodes / nodes), 1e-3);
}

TEST(PlaceLikelihood, MakesRastersOfTheLikelierFloorsAlone) {
  const Places places;
  const auto near = places.with_rasters(query_of({-60.0F, -80.0F, -60.0F}), 0.0, -4.9);
  EXPECT_NE(near.floors[1].raster, nullptr);
  const auto far = places.with_rasters(query_of({-60.0F, -80.0F, -60.0F}), 0.0, -5.1);
  EXPECT_EQ(far.floors[1].raster, nullptr);
}

TEST(PlaceLikelihood, SaysNothingOfWhatItDoesNotKnow) {
  const Places places;
  Query strange;
  strange.readings = {{core::TransmitterId::wifi(99), -50.0F, 0.0F}};
  EXPECT_EQ(places.with_rasters(strange).floors[0].raster, nullptr);
  EXPECT_EQ(places.with_rasters({}).floors[0].raster, nullptr);
  observation::RadioObservation nothing;
  places.likelihood.add_rasters(query_of(kHeardAt30m), nothing);
  EXPECT_TRUE(nothing.floors.empty());
}

TEST(PlaceLikelihood, ComparesFreshReadingsWithWhatIsExpectedThere) {
  const Places places;
  Query query = query_of({-74.0F, -60.0F});  // Transmitter 1 is 6 dB louder than surveyed.
  query.readings[1].age_s = 3.5F;
  const auto residuals = places.likelihood.residuals(query, FloorId{0}, {30.0, 3.0});
  ASSERT_EQ(residuals.size(), 1U);
  EXPECT_EQ(residuals[0].rssi_dbm, -74.0);
  EXPECT_NEAR(residuals[0].expected_dbm, -80.0, 1.0);
  EXPECT_GE(residuals[0].sigma_db, std::hypot(6.0, 3.0) - 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(places.likelihood.residuals(query, FloorId{0}, {nan, 3.0}).empty());
  EXPECT_TRUE(places.likelihood.residuals(query, FloorId{5}, {30.0, 3.0}).empty());
}

TEST(PlaceLikelihood, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(PlaceLikelihood::Options{}.validate());
  std::vector<PlaceLikelihood::Options> wrong(6);
  wrong[0].candidates = 0;
  wrong[1].distance_scale = 0.0;
  wrong[2].elsewhere_share = 1.0;
  wrong[3].candidates_weight = wrong[3].signal_weight = 0.0;
  wrong[4].signal.node_m = 0.0;
  wrong[5].candidate_sigma_m = std::numeric_limits<double>::quiet_NaN();
  const Places places;
  for (const PlaceLikelihood::Options& options : wrong) {
    const auto refused = PlaceLikelihood::create(places.matcher, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::radio
