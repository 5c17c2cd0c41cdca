// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/simulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "test_support.hpp"
#include "waylode/core/angle.hpp"
#include "waylode/sim/ascii_building.hpp"

namespace waylode::sim {
namespace {

using core::Quaternion;
using core::Vector2;
using core::Vector3;

constexpr const char* kHouse =
    "floor F1 level 0 elevation_m 0\n"
    "####################\n"
    "#1......A.........2#\n"
    "#########..#######.#\n"
    "#.^^^..a#..#######.#\n"
    "#.^^^...+..#B....+3#\n"
    "#.^^^...#..#.....#.#\n"
    "####################\n"
    "floor F2 level 1 elevation_m 4\n"
    "####################\n"
    "#1......A.........2#\n"
    "#########..#######.#\n"
    "#.^^^..a#..#######.#\n"
    "#.^^^...+..#B....+3#\n"
    "#.^^^...#..#.....#.#\n"
    "####################\n";

/// A phone without errors, radio without chance.
Scenario quiet_scenario(std::vector<std::string> route) {
  Scenario scenario;
  scenario.seed = 17;
  scenario.building = *parse_ascii_building(kHouse, "house");
  scenario.magnetic.anomaly_sigma_ut = 0.0;
  scenario.magnetic.dipoles_per_100m2 = 0.0;
  scenario.air.weather_sigma_hpa = 0.0;
  Walker walker;
  walker.name = "w";
  walker.route = std::move(route);
  PhoneOptions& phone = walker.phone;
  phone.accelerometer_bias_sigma_mps2 = phone.accelerometer_noise_mps2 = 0.0;
  phone.gyroscope_bias_sigma_degps = phone.gyroscope_noise_degps = 0.0;
  phone.magnetometer_bias_sigma_ut = phone.magnetometer_noise_ut = 0.0;
  phone.attitude_drift_sigma_deg = phone.barometer_noise_hpa = 0.0;
  scenario.walkers = {walker};
  return scenario;
}

SimulatedRecording run(const Scenario& scenario) {
  auto simulation = simulate(scenario);
  EXPECT_TRUE(simulation) << core::to_string(simulation.error());
  return simulation->recordings.front();
}

template <typename T>
std::vector<T> all(const SimulatedRecording& recording) {
  std::vector<T> result;
  for (const sample::Sample& sample : recording.samples) {
    if (const T* value = std::get_if<T>(&sample)) result.push_back(*value);
  }
  return result;
}

double yaw_rad(const Quaternion& enu_from_device) {
  const Vector3 top = enu_from_device * Vector3::UnitY();
  return std::atan2(top.y(), top.x());
}

TEST(Simulate, FeelsGravityUpwardsWhileStanding) {
  for (const auto pose : {PhoneOptions::Pose::kHand, PhoneOptions::Pose::kPocket}) {
    Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
    scenario.walkers[0].phone.pose = pose;
    scenario.walkers[0].gait.stand_before_s = 3.0;
    const SimulatedRecording recording = run(scenario);
    const auto forces = all<sample::AccelerometerSample>(recording);
    const auto attitudes = all<sample::RotationSample>(recording);
    ASSERT_EQ(forces.size(), attitudes.size());
    for (std::size_t i = 0; i < 100; ++i) {
      const Vector3 up = attitudes[i].enu_from_device * forces[i].specific_force_mps2;
      EXPECT_NEAR((up - Vector3(0.0, 0.0, 9.80665)).norm(), 0.0, 1e-9);
    }
  }
}

TEST(Simulate, FeelsGravityUpwardsOnAverageWhileWalking) {
  const SimulatedRecording recording = run(quiet_scenario({"F1/1", "F1/2"}));
  const auto forces = all<sample::AccelerometerSample>(recording);
  const auto attitudes = all<sample::RotationSample>(recording);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < forces.size(); ++i) {
    sum += attitudes[i].enu_from_device * forces[i].specific_force_mps2;
  }
  const Vector3 mean = sum / static_cast<double>(forces.size());
  EXPECT_NEAR((mean - Vector3(0.0, 0.0, 9.80665)).norm(), 0.0, 0.1);
}

TEST(Simulate, TurnsTheGyroscopeByTheAttitude) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2", "F1/3"});
  scenario.magnetic.north_offset_deg = 25.0;
  const SimulatedRecording recording = run(scenario);
  const auto rates = all<sample::GyroscopeSample>(recording);
  const auto attitudes = all<sample::RotationSample>(recording);
  Quaternion integrated = attitudes.front().enu_from_device;
  for (std::size_t i = 1; i < rates.size(); ++i) {
    const double dt_s = core::to_seconds(rates[i].time - rates[i - 1].time);
    const Vector3 turn = rates[i].angular_rate_radps * dt_s;
    if (turn.norm() == 0.0) continue;
    integrated = integrated * Quaternion(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  }
  EXPECT_LT(integrated.angularDistance(attitudes.back().enu_from_device), 1e-6);
  const double truth_turn_rad =
      recording.truth.back().heading_rad - recording.truth.front().heading_rad;
  const double turned_rad = yaw_rad(integrated) - yaw_rad(attitudes.front().enu_from_device);
  // A hand keeps a phone within a few degrees of the walk.
  EXPECT_NEAR(core::wrap_angle(turned_rad - truth_turn_rad), 0.0, 0.2);
}

TEST(Simulate, SeesTheEarthsFieldInItsFrame) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2", "F1/3"});
  scenario.magnetic.intensity_ut = 50.0;
  scenario.magnetic.inclination_deg = 60.0;
  scenario.magnetic.north_offset_deg = -35.0;
  const SimulatedRecording recording = run(scenario);
  const auto fields = all<sample::MagnetometerSample>(recording);
  const auto attitudes = all<sample::RotationSample>(recording);
  // Level part 50 cos 60 deg to magnetic north, which is the attitude's +y.
  const Vector3 expected_ut(0.0, 25.0, -50.0 * std::sqrt(0.75));
  for (std::size_t i = 0; i < fields.size(); i += 37) {
    const Vector3 in_enu_ut = attitudes[i].enu_from_device * fields[i].field_ut;
    EXPECT_NEAR((in_enu_ut - expected_ut).norm(), 0.0, 1e-9);
  }
}

TEST(Simulate, ReadsThePressureOfTheStoreys) {
  Scenario scenario = quiet_scenario({"F1/1", "F2/1"});
  scenario.air.ground_elevation_m = 100.0;
  scenario.walkers[0].phone.barometer_offset_hpa = 1.5;
  const auto pressures = all<sample::BarometerSample>(run(scenario));
  // Textbook form of the international formula; the phone is 1.1 m above the floor.
  const auto textbook_hpa = [](double elevation_m) {
    return 1013.25 * std::pow(1.0 - 2.25577e-5 * elevation_m, 5.25588);
  };
  EXPECT_NEAR(pressures.front().pressure_hpa, textbook_hpa(101.1) + 1.5, 1e-3);
  EXPECT_NEAR(pressures.back().pressure_hpa, textbook_hpa(105.1) + 1.5, 1e-3);
}

TEST(Simulate, NeverWalksThroughAWall) {
  const auto scenario =
      load_scenario(test::source_root() / "testdata" / "demo" / "demo_scenario.toml");
  ASSERT_TRUE(scenario);
  const auto simulation = simulate(*scenario);
  ASSERT_TRUE(simulation) << core::to_string(simulation.error());
  const auto side = [](const Vector2& a, const Vector2& b, const Vector2& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  };
  for (const SimulatedRecording& recording : simulation->recordings) {
    for (std::size_t i = 1; i < recording.truth.size(); ++i) {
      const TruthState& a = recording.truth[i - 1];
      const TruthState& b = recording.truth[i];
      if (a.floor != b.floor || a.position_m == b.position_m) continue;
      for (const site::Wall& wall : simulation->building.floor(a.floor).plan.walls) {
        const bool splits = (side(wall.from_m, wall.to_m, a.position_m) > 0.0) !=
                            (side(wall.from_m, wall.to_m, b.position_m) > 0.0);
        const bool is_split = (side(a.position_m, b.position_m, wall.from_m) > 0.0) !=
                              (side(a.position_m, b.position_m, wall.to_m) > 0.0);
        ASSERT_FALSE(splits && is_split) << recording.walker << " at " << a.position_m.transpose();
      }
    }
  }
}

TEST(Simulate, RepeatsItselfToTheBit) {
  const Scenario scenario = quiet_scenario({"F1/1", "F2/2", "F1/3"});
  const SimulatedRecording a = run(scenario);
  const SimulatedRecording b = run(scenario);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.truth, b.truth);
  Scenario other = scenario;
  other.seed = 18;
  EXPECT_NE(run(other).samples, a.samples);
}

TEST(Simulate, KeepsWalkersIndependent) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
  const SimulatedRecording alone = run(scenario);
  Walker other = scenario.walkers[0];
  other.name = "other";
  other.route = {"F2/1", "F1/3"};
  scenario.walkers.insert(scenario.walkers.begin(), other);
  const auto together = simulate(scenario);
  ASSERT_TRUE(together);
  EXPECT_EQ(together->recordings[1].samples, alone.samples);
  EXPECT_NE(together->recordings[0].samples, alone.samples);
}

TEST(Simulate, OrdersSamplesAndNeverHearsTheFuture) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2", "F1/3", "F1/2", "F1/1"});
  scenario.walkers[0].phone.scan_miss_ratio = 0.3;
  const SimulatedRecording recording = run(scenario);
  EXPECT_TRUE(std::is_sorted(
      recording.samples.begin(), recording.samples.end(),
      [](const auto& a, const auto& b) { return sample::time_of(a) < sample::time_of(b); }));
  std::size_t stale = 0;
  std::size_t rows = 0;
  for (const sample::WifiScan& scan : all<sample::WifiScan>(recording)) {
    for (const sample::WifiReading& reading : scan.readings) {
      EXPECT_LE(reading.last_seen, scan.time);
      const double age_s = core::to_seconds(scan.time - reading.last_seen);
      EXPECT_LE(age_s, 8.0 + 1e-6);
      ++rows;
      if (age_s > 2.0) ++stale;
    }
  }
  EXPECT_GT(rows, 50U);
  EXPECT_GT(stale, rows / 10);
  EXPECT_LT(stale, rows / 2);
}

TEST(Simulate, HearsLogDistanceThroughThePhonesScale) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
  scenario.radio.shadowing_sigma_db = scenario.radio.temporal_sigma_db = 0.0;
  scenario.radio.body_loss_db = scenario.radio.drift_sigma_db = 0.0;
  scenario.radio.path_loss_exponent = 2.0;
  scenario.radio.dual_band = false;
  scenario.building.transmitters = {{Transmitter::Kind::kWifi, "A", core::FloorId{0}, {8.5, 5.5}}};
  scenario.walkers[0].phone.rssi_offset_db = -5.0;
  scenario.walkers[0].phone.scan_miss_ratio = 0.0;
  scenario.walkers[0].gait.stand_before_s = 20.0;
  const SimulatedRecording recording = run(scenario);
  const auto scans = all<sample::WifiScan>(recording);
  // Standing at (1.5, 5.5), 7 m away and 1.5 m below: -35 - 20 log10(7.159) - 5 = -57.1.
  ASSERT_EQ(scans[4].readings.size(), 1U);
  EXPECT_EQ(scans[4].readings[0].rssi_dbm, -57.0F);
}

TEST(Simulate, DeliversInstantScansLate) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
  PhoneOptions& phone = scenario.walkers[0].phone;
  phone.scan_sweep_s = phone.scan_cache_s = phone.scan_miss_ratio = 0.0;
  phone.scan_interval_s = 3.0;
  phone.scan_delay_s = 1.5;
  const auto scans = all<sample::WifiScan>(run(scenario));
  ASSERT_GT(scans.size(), 3U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_FALSE(scans[i].readings.empty());
    if (i > 0) {
      EXPECT_NEAR(core::to_seconds(scans[i].time - scans[i - 1].time), 3.0, 1e-6);
    }
    for (const sample::WifiReading& reading : scans[i].readings) {
      EXPECT_NEAR(core::to_seconds(scans[i].time - reading.last_seen), 1.5, 1e-6);
    }
  }
}

TEST(Simulate, HoldsAFlatPhoneLevel) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
  scenario.walkers[0].phone.is_flat = true;
  for (const auto& attitude : all<sample::RotationSample>(run(scenario))) {
    EXPECT_NEAR((attitude.enu_from_device * Vector3::UnitZ() - Vector3::UnitZ()).norm(), 0.0, 1e-9);
  }
  scenario.walkers[0].phone.has_attitude = false;
  EXPECT_TRUE(all<sample::RotationSample>(run(scenario)).empty());
}

TEST(Simulate, TurnsTheMagnetometerInItsPhone) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
  scenario.walkers[0].phone.is_flat = true;
  const auto straight = all<sample::MagnetometerSample>(run(scenario));
  scenario.walkers[0].phone.magnetometer_yaw_sigma_deg = 10.0;
  const auto turned = all<sample::MagnetometerSample>(run(scenario));
  // One angle about the vertical: horizontal and vertical parts stay.
  const auto angle_rad = [](const Vector3& field) { return std::atan2(field.y(), field.x()); };
  const double first_rad =
      core::wrap_angle(angle_rad(turned[0].field_ut) - angle_rad(straight[0].field_ut));
  EXPECT_GT(std::abs(first_rad), 1e-3);
  for (std::size_t i = 0; i < turned.size(); i += 50) {
    EXPECT_NEAR(turned[i].field_ut.z(), straight[i].field_ut.z(), 1e-9);
    EXPECT_NEAR(core::wrap_angle(angle_rad(turned[i].field_ut) - angle_rad(straight[i].field_ut) -
                                 first_rad),
                0.0, 1e-9);
  }
}

TEST(Simulate, TellsTheTruthAtWaypoints) {
  Scenario scenario = quiet_scenario({"F1/1", "F2/2"});
  scenario.walkers[0].truth_interval_s = 1.0;
  const SimulatedRecording recording = run(scenario);
  const auto waypoints = all<sample::WaypointSample>(recording);
  EXPECT_GE(waypoints.size(), recording.truth.size() / 10);
  EXPECT_EQ(waypoints.front().floor, "F1");
  EXPECT_EQ(waypoints.back().floor, "F2");
  const auto same_time =
      std::find_if(recording.truth.begin(), recording.truth.end(),
                   [&](const TruthState& state) { return state.time >= waypoints[20].time; });
  ASSERT_NE(same_time, recording.truth.end());
  EXPECT_LT((same_time->position_m - *waypoints[20].position_m).norm(), 0.3);
}

TEST(Simulate, RefusesOptionsOutOfRange) {
  Scenario scenario = quiet_scenario({"F1/1", "F1/2"});
  scenario.walkers[0].gait.speed_mps = 9.0;
  EXPECT_EQ(simulate(scenario).error().code, core::ErrorCode::kScenarioInvalid);
  scenario.walkers[0].gait.speed_mps = std::nullopt;
  scenario.radio.path_loss_exponent = std::nan("");
  EXPECT_EQ(simulate(scenario).error().code, core::ErrorCode::kScenarioInvalid);
}

}  // namespace
}  // namespace waylode::sim
