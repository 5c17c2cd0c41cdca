// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

// Name and range of every option, said once for the checks and for the scenario file.
// `visit(key, member, lowest, highest)` for numbers, given or not; `visit(key, member)` for flags
// and words. `Options` is the options' type, const or not.

template <typename Options, typename Visitor>
void visit_gait(Options& options, Visitor&& visit) {
  visit("height_m", options.height_m, 1.2, 2.2);
  visit("speed_mps", options.speed_mps, 0.7, 2.0);
  visit("step_scale_ratio", options.step_scale_ratio, 0.7, 1.3);
  visit("bounce_constant", options.bounce_constant, 0.3, 0.6);
  visit("cadence_hz", options.cadence_hz, 1.2, 2.6);
  visit("step_sigma_ratio", options.step_sigma_ratio, 0.0, 0.3);
  visit("cadence_sigma_ratio", options.cadence_sigma_ratio, 0.0, 0.2);
  visit("stand_before_s", options.stand_before_s, 0.0, 600.0);
  visit("pause_probability", options.pause_probability, 0.0, 1.0);
  visit("pause_s", options.pause_s, 0.0, 600.0);
  visit("u_turn_probability", options.u_turn_probability, 0.0, 1.0);
  visit("bounce_sigma_ratio", options.bounce_sigma_ratio, 0.0, 0.5);
  visit("end_step_ratio", options.end_step_ratio, 0.3, 1.0);
  visit("straight_ways", options.straight_ways);
  visit("photo_stops", options.photo_stops, 0.0, 20.0);
  visit("dodges", options.dodges, 0.0, 20.0);
}

template <typename Options, typename Visitor>
void visit_phone(Options& options, Visitor&& visit) {
  visit("model", options.model);
  visit("pose", options.pose);
  visit("imu_rate_hz", options.imu_rate_hz, 10.0, 500.0);
  visit("barometer_rate_hz", options.barometer_rate_hz, 0.0, 50.0);
  visit("hold_offset_deg", options.hold_offset_deg, -180.0, 180.0);
  visit("accelerometer_bias_sigma_mps2", options.accelerometer_bias_sigma_mps2, 0.0, 2.0);
  visit("accelerometer_noise_mps2", options.accelerometer_noise_mps2, 0.0, 5.0);
  visit("gyroscope_bias_sigma_degps", options.gyroscope_bias_sigma_degps, 0.0, 20.0);
  visit("gyroscope_noise_degps", options.gyroscope_noise_degps, 0.0, 20.0);
  visit("magnetometer_bias_sigma_ut", options.magnetometer_bias_sigma_ut, 0.0, 200.0);
  visit("magnetometer_noise_ut", options.magnetometer_noise_ut, 0.0, 50.0);
  visit("has_attitude", options.has_attitude);
  visit("attitude_drift_sigma_deg", options.attitude_drift_sigma_deg, 0.0, 90.0);
  visit("attitude_magnetic_ratio", options.attitude_magnetic_ratio, 0.0, 1.0);
  visit("sway_deg", options.sway_deg, 0.0, 30.0);
  visit("is_flat", options.is_flat);
  visit("magnetometer_yaw_sigma_deg", options.magnetometer_yaw_sigma_deg, 0.0, 45.0);
  visit("barometer_offset_hpa", options.barometer_offset_hpa, -10.0, 10.0);
  visit("barometer_noise_hpa", options.barometer_noise_hpa, 0.0, 5.0);
  visit("rssi_offset_db", options.rssi_offset_db, -30.0, 30.0);
  visit("rssi_gain_ratio", options.rssi_gain_ratio, 0.5, 1.5);
  visit("scan_interval_s", options.scan_interval_s, 0.5, 300.0);
  visit("scan_miss_ratio", options.scan_miss_ratio, 0.0, 1.0);
  visit("scan_cache_s", options.scan_cache_s, 0.0, 600.0);
  visit("scan_sweep_s", options.scan_sweep_s, 0.0, 10.0);
  visit("scan_delay_s", options.scan_delay_s, 0.0, 30.0);
}

template <typename Options, typename Visitor>
void visit_radio(Options& options, Visitor&& visit) {
  visit("wifi_power_dbm", options.wifi_power_dbm, -90.0, 0.0);
  visit("bluetooth_power_dbm", options.bluetooth_power_dbm, -100.0, 0.0);
  visit("reference_distance_m", options.reference_distance_m, 0.1, 10.0);
  visit("nearest_m", options.nearest_m, 0.1, 10.0);
  visit("transmitter_height_m", options.transmitter_height_m, 0.0, 10.0);
  visit("band_5ghz_loss_db", options.band_5ghz_loss_db, -20.0, 40.0);
  visit("dual_band", options.dual_band);
  visit("path_loss_exponent", options.path_loss_exponent, 1.0, 6.0);
  visit("wall_loss_db", options.wall_loss_db, 0.0, 40.0);
  visit("wall_loss_cap_db", options.wall_loss_cap_db, 0.0, 200.0);
  visit("floor_loss_db", options.floor_loss_db, 0.0, 100.0);
  visit("shadowing_sigma_db", options.shadowing_sigma_db, 0.0, 20.0);
  visit("shadowing_range_m", options.shadowing_range_m, 0.5, 50.0);
  visit("shadowing_is_smooth", options.shadowing_is_smooth);
  visit("temporal_sigma_db", options.temporal_sigma_db, 0.0, 20.0);
  visit("temporal_time_s", options.temporal_time_s, 0.1, 3600.0);
  visit("bluetooth_noise_db", options.bluetooth_noise_db, 0.0, 20.0);
  visit("body_loss_db", options.body_loss_db, 0.0, 30.0);
  visit("body_shadows_behind_only", options.body_shadows_behind_only);
  visit("drift_sigma_db", options.drift_sigma_db, 0.0, 30.0);
  visit("detection_threshold_dbm", options.detection_threshold_dbm, -110.0, -30.0);
  visit("detection_softness_db", options.detection_softness_db, 0.01, 20.0);
  visit("advertisement_rate_hz", options.advertisement_rate_hz, 0.1, 10.0);
}

template <typename Options, typename Visitor>
void visit_magnetic(Options& options, Visitor&& visit) {
  visit("intensity_ut", options.intensity_ut, 20.0, 70.0);
  visit("inclination_deg", options.inclination_deg, -90.0, 90.0);
  visit("north_offset_deg", options.north_offset_deg, -180.0, 180.0);
  visit("anomaly_sigma_ut", options.anomaly_sigma_ut, 0.0, 100.0);
  visit("anomaly_range_m", options.anomaly_range_m, 0.5, 50.0);
  visit("dipoles_per_100m2", options.dipoles_per_100m2, 0.0, 20.0);
  visit("dipole_field_ut", options.dipole_field_ut, 0.0, 500.0);
  visit("dipoles_per_floor", options.dipoles_per_floor, 0.0, 500.0);
  visit("dipole_weakest_ratio", options.dipole_weakest_ratio, 0.0, 10.0);
  visit("dipole_strongest_ratio", options.dipole_strongest_ratio, options.dipole_weakest_ratio,
        10.0);
  visit("dipole_nearest_m", options.dipole_nearest_m, 0.5, 10.0);
  visit("dipole_farthest_m", options.dipole_farthest_m, options.dipole_nearest_m.value_or(0.5),
        10.0);
  visit("dipole_margin_m", options.dipole_margin_m, 0.0, 20.0);
}

template <typename Options, typename Visitor>
void visit_air(Options& options, Visitor&& visit) {
  visit("sea_level_hpa", options.sea_level_hpa, 900.0, 1100.0);
  visit("ground_elevation_m", options.ground_elevation_m, -500.0, 6000.0);
  visit("weather_sigma_hpa", options.weather_sigma_hpa, 0.0, 20.0);
}

}  // namespace waylode::sim::detail
