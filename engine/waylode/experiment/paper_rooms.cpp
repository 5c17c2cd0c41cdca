// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/paper_rooms.hpp"

#include <algorithm>
#include <utility>

#include "waylode/core/rng.hpp"
#include "waylode/experiment/detail/room_builder.hpp"

namespace waylode::experiment {

namespace {

using core::Rng;
using core::Vector2;
using detail::RoomPlan;

/// Somebody unknown: all that the methods must cope with.
sim::GaitOptions draw_gait(Rng& rng) {
  sim::GaitOptions gait;
  gait.height_m = std::clamp(rng.normal(1.72, 0.08), 1.5, 1.95);
  gait.step_scale_ratio = std::clamp(rng.normal(1.0, 0.06), 0.85, 1.15);
  gait.cadence_hz = std::clamp(rng.normal(1.8, 0.1), 1.5, 2.1);
  gait.bounce_constant = std::clamp(rng.normal(0.42, 0.025), 0.35, 0.5);
  gait.bounce_sigma_ratio = 0.06;
  gait.end_step_ratio = 1.0;
  gait.stand_before_s = 1.5;
  gait.straight_ways = true;
  return gait;
}

/// A phone held level in front of the body: accelerometer, gyroscope and magnetometer at 100 Hz.
sim::PhoneOptions draw_phone(Rng& rng, double hold_sigma_deg, double gyroscope_bias_sigma_degps) {
  sim::PhoneOptions phone;
  phone.imu_rate_hz = 100.0;
  phone.barometer_rate_hz = 0.0;
  phone.is_flat = true;
  phone.has_attitude = false;
  phone.hold_offset_deg = rng.normal(0.0, hold_sigma_deg);
  phone.accelerometer_bias_sigma_mps2 = 0.0;
  phone.accelerometer_noise_mps2 = 0.35;
  phone.gyroscope_bias_sigma_degps = gyroscope_bias_sigma_degps;
  phone.gyroscope_noise_degps = 0.3;
  phone.magnetometer_bias_sigma_ut = 0.0;
  phone.magnetometer_yaw_sigma_deg = 3.0;
  phone.scan_miss_ratio = 0.0;
  phone.scan_cache_s = 0.0;
  phone.scan_sweep_s = 0.0;
  return phone;
}

/// One band, no walls, everything above -95 dBm heard, loss by the body from behind only.
sim::RadioOptions plain_radio() {
  sim::RadioOptions radio;
  radio.dual_band = false;
  radio.nearest_m = 0.3;
  radio.transmitter_height_m = 1.1;
  radio.wall_loss_db = 0.0;
  radio.body_shadows_behind_only = true;
  radio.detection_threshold_dbm = -95.0;
  radio.detection_softness_db = 0.01;
  return radio;
}

/// The Earth's field of the papers' region and steel above and below the phone.
sim::MagneticOptions steel(double dipoles, double weakest_ut, double strongest_ut) {
  sim::MagneticOptions magnetic;
  magnetic.intensity_ut = 49.58;     // 33 uT level,
  magnetic.inclination_deg = 48.27;  // 37 uT down.
  magnetic.anomaly_sigma_ut = 0.0;
  magnetic.dipoles_per_floor = dipoles;
  magnetic.dipole_field_ut = 100.0;
  magnetic.dipole_weakest_ratio = weakest_ut / magnetic.dipole_field_ut;
  magnetic.dipole_strongest_ratio = strongest_ut / magnetic.dipole_field_ut;
  magnetic.dipole_nearest_m = 1.2;
  magnetic.dipole_farthest_m = 2.8;
  magnetic.dipole_margin_m = 1.0;
  return magnetic;
}

site::Ring box(double width_m, double depth_m) {
  return {{0.0, 0.0}, {width_m, 0.0}, {width_m, depth_m}, {0.0, depth_m}};
}

core::Result<PaperRoom> build(const RoomPlan& plan, sim::Scenario scenario, sim::GaitOptions gait,
                              sim::PhoneOptions phone, std::uint64_t seed) {
  auto building = detail::make_building(plan);
  if (!building) return tl::unexpected(std::move(building.error()));
  scenario.name = plan.name;
  scenario.seed = seed;
  scenario.building = std::move(*building);
  sim::Walker walker;
  walker.name = "walker";
  walker.route = detail::route_names(plan);
  walker.gait = std::move(gait);
  walker.phone = std::move(phone);
  walker.tap_waypoints = false;
  scenario.walkers = {std::move(walker)};
  return detail::build_room(plan, scenario);
}

sim::RadioOptions wu_radio(WuPreset preset) {
  sim::RadioOptions radio = plain_radio();
  radio.wifi_power_dbm = -40.0;
  radio.path_loss_exponent = preset == WuPreset::kI ? 3.5 : 3.0;
  radio.shadowing_sigma_db = 3.0;
  radio.shadowing_range_m = preset == WuPreset::kI ? 3.0 : 2.5;
  radio.temporal_time_s = 3.0;
  radio.temporal_sigma_db = 3.0;
  radio.body_loss_db = 3.0;
  radio.drift_sigma_db = 1.0;
  if (preset == WuPreset::kI) {
    radio.temporal_sigma_db = radio.body_loss_db = 1.0;
    radio.drift_sigma_db = 0.5;
  } else if (preset == WuPreset::kC) {
    // The mean of a hundred independent scans in all directions.
    radio.temporal_sigma_db = 0.3;
    radio.temporal_time_s = 0.1;
    radio.body_loss_db = 0.0;
  } else if (preset == WuPreset::kD) {
    radio.temporal_sigma_db = radio.body_loss_db = 4.0;
    radio.drift_sigma_db = 2.0;
  }
  return radio;
}

std::vector<Vector2> square_corridor_grid() {
  std::vector<Vector2> grid_m;
  for (int column = 0; column < 12; ++column) {
    for (int row = 0; row < 12; ++row) {
      if (column <= 1 || column >= 10 || row >= 10) grid_m.emplace_back(column + 0.5, row + 0.5);
    }
  }
  return grid_m;
}

}  // namespace

core::Result<PaperRoom> wu_room(WuPreset preset, std::uint64_t seed) {
  Rng rng(seed ^ 0x5775'2019ULL);
  RoomPlan plan;
  plan.name = "wu";
  plan.outline_m = box(16.0, 15.8);
  plan.access_points_m = {{1.0, 1.0}, {15.0, 2.0}, {8.0, 15.0}};
  for (int column = 0; column < 16; ++column) {
    for (int row = 0; row < 16; ++row) plan.grid_m.emplace_back(column + 0.5, row + 0.5);
  }
  plan.route_m = {{2.0, 2.0}, {14.0, 2.0}, {14.0, 13.8}, {2.0, 13.8}, {2.0, 3.0}};
  plan.scans_per_instance = 10;  // A hundred per point.
  plan.facing = sim::World::Facing::kNone;
  plan.magnetic_line_m = plan.route_m;
  sim::Scenario scenario;
  scenario.radio = wu_radio(preset);
  scenario.magnetic = steel(14.0, 20.0, 120.0);
  const sim::GaitOptions gait = draw_gait(rng);
  sim::PhoneOptions phone = draw_phone(rng, 4.0, 0.3);
  phone.scan_interval_s = 1.0;
  return build(plan, std::move(scenario), gait, phone, seed);
}

core::Result<PaperRoom> zhou_corridor(ZhouPreset preset, std::uint64_t seed) {
  Rng rng(seed ^ 0x5A68'2016ULL);
  const bool is_hard = preset == ZhouPreset::kH;
  RoomPlan plan;
  plan.name = "zhou";
  plan.outline_m = box(30.0, 3.0);
  plan.access_points_m = {{3.0, 1.5}, {11.0, 1.5}, {19.0, 1.5}, {27.0, 1.5}};
  for (int column = 0; column < 30; ++column) {
    for (const double y_m : {0.75, 2.25}) plan.grid_m.emplace_back(column + 0.5, y_m);
  }
  plan.route_m = {{8.0, 1.5}, {28.0, 1.5}, {3.0, 1.5}};
  if (is_hard) plan.route_m = {{8.0, 1.9}, {28.0, 1.9}, {28.0, 1.1}, {3.0, 1.1}};
  plan.magnetic_line_m = {{0.0, 1.5}, {30.0, 1.5}};
  plan.magnetic_spacing_m = is_hard ? 1.0 : 0.2;
  plan.start_scans = 6;
  sim::Scenario scenario;
  scenario.radio = plain_radio();
  scenario.radio.wifi_power_dbm = -38.0;
  scenario.radio.transmitter_height_m = 2.6;
  scenario.radio.path_loss_exponent = 2.5;
  scenario.radio.shadowing_sigma_db = 3.0;
  scenario.radio.shadowing_range_m = 2.0;
  scenario.radio.temporal_sigma_db = scenario.radio.body_loss_db = 4.0;
  scenario.radio.temporal_time_s = 3.0;
  scenario.radio.drift_sigma_db = 2.0;
  scenario.magnetic = steel(24.0, 20.0, 120.0);
  const sim::GaitOptions gait = draw_gait(rng);
  sim::PhoneOptions phone = draw_phone(rng, 5.0, 0.5);
  phone.scan_interval_s = 3.0;
  phone.scan_delay_s = 1.5;
  if (is_hard) phone.magnetometer_bias_sigma_ut = 3.0;
  return build(plan, std::move(scenario), gait, phone, seed);
}

core::Result<PaperRoom> zhao_square(ZhaoPreset preset, std::uint64_t seed) {
  Rng rng(seed ^ 0x5A68'2019ULL);
  const bool is_harsh = preset != ZhaoPreset::kNormal;
  RoomPlan plan;
  plan.name = "zhao";
  plan.outline_m = {{0.0, 0.0}, {2.2, 0.0},  {2.2, 9.8},   {9.8, 9.8},
                    {9.8, 0.0}, {12.0, 0.0}, {12.0, 12.0}, {0.0, 12.0}};
  for (int i = 0; i < (is_harsh ? 6 : 8); ++i) {
    const double x_m = rng.uniform(-2.0, 14.0);
    plan.access_points_m.emplace_back(x_m, rng.uniform(-2.0, 14.0));
  }
  plan.grid_m = square_corridor_grid();
  plan.route_m = {{1.0, 1.0}, {1.0, 11.0}, {11.0, 11.0}, {11.0, 1.0}};
  plan.magnetic_line_m = plan.route_m;
  plan.start_scans = 5;
  plan.start_interval_s = 0.3;
  sim::Scenario scenario;
  scenario.radio = plain_radio();
  scenario.radio.reference_distance_m = 2.0;
  scenario.radio.wifi_power_dbm = -35.0;
  scenario.radio.path_loss_exponent = is_harsh ? 2.5 : 3.0;
  scenario.radio.shadowing_sigma_db = 3.0;
  scenario.radio.shadowing_range_m = 2.0;
  scenario.radio.temporal_sigma_db = is_harsh ? 5.0 : 4.0;
  scenario.radio.temporal_time_s = 3.0;
  scenario.radio.body_loss_db = 3.0;
  scenario.radio.drift_sigma_db = is_harsh ? 3.0 : 1.5;
  scenario.magnetic = steel(14.0, 20.0, 120.0);
  const sim::GaitOptions gait = draw_gait(rng);
  sim::PhoneOptions phone = draw_phone(rng, 4.0, 0.5);
  phone.scan_interval_s = preset == ZhaoPreset::kHarshSlowScans ? 3.0 : 0.5;
  return build(plan, std::move(scenario), gait, phone, seed);
}

core::Result<PaperWalk> zhong_walk(ZhongKind kind, std::uint64_t seed) {
  Rng rng(seed ^ 0x5A68'2017ULL);
  RoomPlan plan;
  plan.name = "zhong";
  plan.outline_m = box(24.0, 19.0);
  plan.route_m = {{2.0, 2.0}, {22.0, 2.0}, {22.0, 17.0}, {7.0, 17.0}};
  if (kind == ZhongKind::kTurnsBack) std::ranges::reverse(plan.route_m);
  if (kind == ZhongKind::kStraight) {
    plan.outline_m = box(54.0, 4.0);
    plan.route_m = {{2.0, 2.0}, {52.0, 2.0}};
  }
  sim::Scenario scenario;
  scenario.radio = plain_radio();
  scenario.magnetic = steel(12.0, 20.0, 90.0);
  sim::GaitOptions gait = draw_gait(rng);
  sim::PhoneOptions phone = draw_phone(rng, 4.0, 0.3);
  // More would hide steps from the paper's literal rule, which ripples mislead.
  phone.accelerometer_noise_mps2 = 0.26;

  // The same seed and walker: the same person and phone.
  RoomPlan straight = plan;
  straight.outline_m = box(34.0, 10.0);
  straight.route_m = {{2.0, 5.0}, {32.0, 5.0}};
  sim::Scenario quiet = scenario;
  quiet.magnetic = steel(6.0, 10.0, 40.0);
  auto calibration = build(straight, quiet, gait, phone, seed);
  if (!calibration) return tl::unexpected(std::move(calibration.error()));

  if (kind == ZhongKind::kPhoto) gait.photo_stops = 3.0;
  if (kind == ZhongKind::kCrowd) gait.dodges = 4.0;
  auto walked = build(plan, scenario, gait, phone, seed);
  if (!walked) return tl::unexpected(std::move(walked.error()));
  PaperWalk result;
  result.scenario = std::move(walked->scenario);
  result.height_m = gait.height_m;
  result.calibration = std::move(calibration->walk);
  result.calibration_steps = result.calibration.steps.size();
  result.walk = std::move(walked->walk);
  result.route_m = plan.route_m;
  for (const sim::StepTruth& step : result.calibration.steps) {
    result.calibration_length_m += step.length_m;
  }
  for (const sim::StepTruth& step : result.walk.steps) result.length_m += step.length_m;
  return result;
}

}  // namespace waylode::experiment
