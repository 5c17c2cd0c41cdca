// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/sim/ascii_building.hpp"

namespace waylode::sim {
namespace {

using core::Vector2;
using core::Vector3;

constexpr core::FloorId kGround{0};

/// One transmitter at (0.5, 0.5) on a strip 30 m long, as high as the phone.
Scenario strip() {
  Scenario scenario;
  scenario.seed = 5;
  scenario.building = *parse_ascii_building(
      "floor F1 level 0 elevation_m 0\nA.............................\n", "x");
  scenario.radio.dual_band = false;
  scenario.radio.transmitter_height_m = 1.1;
  scenario.radio.nearest_m = 0.3;
  scenario.radio.shadowing_sigma_db = 0.0;
  scenario.radio.temporal_sigma_db = 0.0;
  scenario.radio.body_loss_db = 0.0;
  scenario.radio.drift_sigma_db = 0.0;
  scenario.radio.detection_threshold_dbm = -110.0;
  scenario.radio.detection_softness_db = 0.01;
  return scenario;
}

World world_of(const Scenario& scenario) {
  auto world = World::make(scenario);
  EXPECT_TRUE(world);
  return *world;
}

TEST(World, FallsFromTheReferenceDistance) {
  Scenario scenario = strip();
  scenario.radio.wifi_power_dbm = -35.0;
  scenario.radio.reference_distance_m = 2.0;
  scenario.radio.path_loss_exponent = 3.5;
  const World world = world_of(scenario);
  const core::TransmitterId id = world.transmitters().front();
  EXPECT_NEAR(*world.mean_rssi_dbm(id, kGround, {2.5, 0.5}), -35.0, 1e-12);
  // 20 m: -35 - 35 lg 10; 0.1 m counts as 0.3 m.
  EXPECT_NEAR(*world.mean_rssi_dbm(id, kGround, {20.5, 0.5}), -70.0, 1e-12);
  EXPECT_NEAR(*world.mean_rssi_dbm(id, kGround, {0.6, 0.5}), -35.0 - 35.0 * std::log10(0.15),
              1e-12);
  EXPECT_FALSE(world.mean_rssi_dbm(core::TransmitterId::column(3), kGround, {2.5, 0.5}));
}

TEST(World, SurveysWithIndependentNoiseInFourDirections) {
  Scenario scenario = strip();
  scenario.radio.temporal_sigma_db = 3.0;
  scenario.radio.temporal_time_s = 60.0;
  scenario.radio.drift_sigma_db = 20.0;
  const World world = world_of(scenario);
  const double mean_dbm = *world.mean_rssi_dbm(world.transmitters().front(), kGround, {9.5, 0.5});
  const auto rows = world.survey_scans(kGround, {9.5, 0.5}, 4000, World::Facing::kFour);
  ASSERT_EQ(rows.size(), 4000U);
  double sum_db = 0.0;
  double square_db2 = 0.0;
  double lagged_db2 = 0.0;
  double last_db = 0.0;
  for (const sample::FingerprintRow& row : rows) {
    ASSERT_EQ(row.readings.size(), 1U);
    const double off_db = row.readings[0].rssi_dbm - mean_dbm;
    sum_db += off_db;
    square_db2 += off_db * off_db;
    lagged_db2 += off_db * last_db;
    last_db = off_db;
  }
  // Standard errors: 0.05 dB, 0.2 dB2 and 0.15 dB2; rounding adds 1/12 dB2.
  EXPECT_NEAR(sum_db / 4000.0, 0.0, 0.2);
  EXPECT_NEAR(square_db2 / 4000.0, 9.0 + 1.0 / 12.0, 0.8);
  EXPECT_NEAR(lagged_db2 / 4000.0, 0.0, 0.6);
}

TEST(World, ShadowsBehindTheBodyOnly) {
  Scenario scenario = strip();
  scenario.radio.body_loss_db = 12.0;
  scenario.radio.body_shadows_behind_only = true;
  scenario.radio.wifi_power_dbm = -40.0;
  scenario.radio.path_loss_exponent = 2.0;
  const World world = world_of(scenario);
  // 10 m away: -60 dBm. Facing +x has the transmitter behind, the other three do not.
  const auto rows = world.survey_scans(kGround, {10.5, 0.5}, 4, World::Facing::kFour);
  EXPECT_EQ(rows[0].readings[0].rssi_dbm, -72.0F);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(rows[i].readings[0].rssi_dbm, -60.0F);
  for (const auto& row : world.survey_scans(kGround, {10.5, 0.5}, 4, World::Facing::kNone)) {
    EXPECT_EQ(row.readings[0].rssi_dbm, -60.0F);
  }
  // 60 degrees off the back: half of it.
  const auto scans = world.standing_scans({kGround, {10.5, 0.5}, core::kPi / 3.0}, 1, 1.0, "w");
  EXPECT_EQ(scans[0].readings[0].rssi_dbm, -66.0F);
}

TEST(World, RemembersFadingAndDriftWhileSomebodyStands) {
  Scenario scenario = strip();
  scenario.radio.temporal_sigma_db = 8.0;
  scenario.radio.temporal_time_s = 1000.0;
  const World world = world_of(scenario);
  const auto scans = world.standing_scans({kGround, {9.5, 0.5}, 0.0}, 3, 0.5, "w");
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[2].time, core::device_time_from_seconds(1.0));
  // Half a second of a thousand changes 8 dB by 0.25 dB or so.
  EXPECT_NEAR(scans[2].readings[0].rssi_dbm, scans[0].readings[0].rssi_dbm, 2.0);
  EXPECT_EQ(scans, world.standing_scans({kGround, {9.5, 0.5}, 0.0}, 3, 0.5, "w"));
  // Others see other fading; alike by chance for so long, never.
  EXPECT_NE(world.standing_scans({kGround, {9.5, 0.5}, 0.0}, 20, 5000.0, "w"),
            world.standing_scans({kGround, {9.5, 0.5}, 0.0}, 20, 5000.0, "v"));
}

TEST(World, DoesNotDependOnTheOrderOfTheSurvey) {
  Scenario scenario = strip();
  scenario.radio.temporal_sigma_db = 3.0;
  const World world = world_of(scenario);
  const auto first = world.survey_scans(kGround, {4.5, 0.5}, 5, World::Facing::kFour);
  (void)world.survey_scans(kGround, {7.5, 0.5}, 5, World::Facing::kFour);
  EXPECT_EQ(first, world_of(scenario).survey_scans(kGround, {4.5, 0.5}, 5, World::Facing::kFour));
}

TEST(World, PutsDipolesAtTheHeightsAsked) {
  Scenario scenario = strip();
  scenario.magnetic.anomaly_sigma_ut = 0.0;
  scenario.magnetic.dipoles_per_floor = 0.0;
  const Vector3 earth_ut = world_of(scenario).field_ut(kGround, {3.0, 0.5}, kHandHeight_m);
  EXPECT_NEAR(earth_ut.norm(), 48.0, 1e-9);
  scenario.magnetic.dipoles_per_floor = 1.0;
  scenario.magnetic.dipole_field_ut = 100.0;
  scenario.magnetic.dipole_weakest_ratio = scenario.magnetic.dipole_strongest_ratio = 1.0;
  scenario.magnetic.dipole_nearest_m = scenario.magnetic.dipole_farthest_m = 2.0;
  const World world = world_of(scenario);
  double strongest_ut = 0.0;
  for (double x_m = 0.0; x_m <= 30.0; x_m += 0.05) {
    const Vector3 off_ut = world.field_ut(kGround, {x_m, 0.5}, kHandHeight_m) - earth_ut;
    strongest_ut = std::max(strongest_ut, off_ut.norm());
  }
  // A dipole of m uT m3 makes between m / r^3 and 2 m / r^3; nearest here is 2 to 2.06 m.
  EXPECT_GT(strongest_ut, 100.0 / std::pow(2.07, 3.0));
  EXPECT_LE(strongest_ut, 200.0 / std::pow(2.0, 3.0) + 1e-9);
}

TEST(World, RefusesAScenarioThatIsNotValid) {
  Scenario scenario = strip();
  scenario.radio.nearest_m = -1.0;
  EXPECT_EQ(World::make(scenario).error().code, core::ErrorCode::kScenarioInvalid);
  EXPECT_EQ(World::make(Scenario{}).error().code, core::ErrorCode::kScenarioInvalid);
}

}  // namespace
}  // namespace waylode::sim
