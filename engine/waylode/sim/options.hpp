// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace waylode::sim {

/// Height above the floor at which a phone in the hand measures the magnetic field.
inline constexpr double kHandHeight_m = 1.2;

/// How somebody walks. Absent values are drawn from the walker's name.
struct GaitOptions {
  double height_m = 1.72;           ///< Of the person, 1.2 to 2.2.
  std::optional<double> speed_mps;  ///< Mean on the flat, 0.7 to 2.0; absent: from a drawn cadence.
  /// Personal factor on the step length law; absent: drawn, mean 1, sigma 6 %.
  std::optional<double> step_scale_ratio;
  /// Weinberg's constant that links bounce and step length; absent: drawn, 0.42 +- 0.025.
  std::optional<double> bounce_constant;
  std::optional<double> cadence_hz;  ///< Mean, 1.2 to 2.6; absent: drawn. `speed_mps` wins over it.
  double step_sigma_ratio = 0.05;    ///< Noise of single step lengths, 0 to 0.3.
  double cadence_sigma_ratio = 0.03;  ///< Noise of single step durations, 0 to 0.2.
  double stand_before_s = 2.0;        ///< Standing still at the start, 0 to 600; also at the end.
  double pause_probability = 0.0;     ///< Of standing a while at a named place passed, 0 to 1.
  double pause_s = 4.0;               ///< Mean length of those pauses, 0 to 600.
  double u_turn_probability = 0.0;    ///< Per leg, of going back a few metres on the way, 0 to 1.
  double bounce_sigma_ratio = 0.0;    ///< Noise of the logarithm of single steps' bounce, 0 to 0.5.
  double end_step_ratio = 0.7;  ///< First and last step of a stroke against the others, 0.3 to 1.
  bool straight_ways = false;   ///< Straight from place to place, whatever stands in between.
  /// Stops to take a photo, per walk, 0 to 20: the whole steps that fit into 3 to 6 s at 1.5 Hz, in
  /// place, while the body turns 50 to 110 degrees and back. At places drawn from the walker's
  /// name, as are the dodges.
  double photo_stops = 0.0;
  /// Giving way to somebody, per walk, 0 to 20: the same in 1 to 2 s by 25 to 60 degrees.
  double dodges = 0.0;
};

/// What is carried and how. Absent values are drawn from the walker's name.
struct PhoneOptions {
  enum class Pose : std::uint8_t { kHand, kPocket, kSwinging };
  std::string model = "simulated";
  Pose pose = Pose::kHand;
  double imu_rate_hz = 50.0;  ///< Accelerometer, gyroscope, magnetometer, attitude; 10 to 500.
  double barometer_rate_hz = 10.0;        ///< 0 for a phone without one; to 50.
  std::optional<double> hold_offset_deg;  ///< Phone's yaw against the walk; absent: 5 deg sigma.
  double accelerometer_bias_sigma_mps2 = 0.05;
  double accelerometer_noise_mps2 = 0.08;  ///< Per sample, one sigma.
  double gyroscope_bias_sigma_degps = 0.3;
  double gyroscope_noise_degps = 0.3;
  double magnetometer_bias_sigma_ut = 1.5;  ///< What the phone's calibration leaves.
  double magnetometer_noise_ut = 0.5;
  bool has_attitude = true;               ///< Reports its own attitude.
  double attitude_drift_sigma_deg = 3.0;  ///< Slow yaw error of the phone's own attitude.
  double attitude_magnetic_ratio = 0.3;   ///< Share of a field disturbance that turns it, 0 to 1.
  double sway_deg = 3.0;                  ///< Of the body with every stride.
  bool is_flat = false;                   ///< Held level, screen up, without the hand's own tilts.
  /// Yaw between the magnetometer's axes and the phone's, of one phone against another.
  double magnetometer_yaw_sigma_deg = 0.0;
  double barometer_offset_hpa = 0.0;
  double barometer_noise_hpa = 0.02;
  double rssi_offset_db = 0.0;    ///< Against the reference phone.
  double rssi_gain_ratio = 1.0;   ///< Slope around -60 dBm, 0.5 to 1.5.
  double scan_interval_s = 2.0;   ///< Between Wi-Fi deliveries, 0.5 to 300 (throttled: 30).
  double scan_miss_ratio = 0.08;  ///< Of audible access points a sweep misses, 0 to 1.
  double scan_cache_s = 8.0;      ///< Missed ones are repeated from the cache while this young.
  double scan_sweep_s = 1.8;      ///< A scan's sweep over the channels, 0 (an instant) to 10.
  double scan_delay_s = 0.0;      ///< From the end of the sweep to the delivery, 0 to 30.
};

/// How radio spreads in the building. Log-distance loss, walls, floors, shadowing, time, bodies.
struct RadioOptions {
  double wifi_power_dbm = -35.0;       ///< Received at `reference_distance_m`, at 2.4 GHz.
  double bluetooth_power_dbm = -59.0;  ///< The same from a beacon.
  double reference_distance_m = 1.0;   ///< Where those powers are received, 0.1 to 10.
  double nearest_m = 1.0;              ///< Nearer than this the power rises no more, 0.1 to 10.
  double transmitter_height_m = 2.6;   ///< Above the floor, 0 to 10; phones are carried at 1.1 m.
  double band_5ghz_loss_db = 6.0;      ///< Extra for the 5 GHz half of an access point.
  bool dual_band = true;               ///< Access points have a 2.4 and a 5 GHz address.
  double path_loss_exponent = 2.2;     ///< 1 to 6.
  double wall_loss_db = 3.0;           ///< Per wall crossed.
  double wall_loss_cap_db = 15.0;      ///< Of all walls together.
  double floor_loss_db = 16.0;         ///< Per slab.
  double shadowing_sigma_db = 4.0;
  double shadowing_range_m = 3.0;    ///< Correlation falls to 1/e in this distance, 0.5 to 50.
  bool shadowing_is_smooth = false;  ///< exp(-(d/range)^2) instead of exp(-d/range).
  double temporal_sigma_db = 2.5;    ///< Slow fading, first-order autoregressive.
  double temporal_time_s = 3.5;      ///< Its correlation time.
  double bluetooth_noise_db = 3.0;   ///< Per advertisement, besides.
  double body_loss_db = 4.0;         ///< Mean loss with the body right in between.
  /// Loss max(0, -cos) of the angle between heading and transmitter, so none from ahead and abeam,
  /// in place of (1 - cos) / 2.
  bool body_shadows_behind_only = false;
  double drift_sigma_db = 1.0;             ///< Per address, between the survey and everybody else.
  double detection_threshold_dbm = -92.0;  ///< Heard half of the time.
  double detection_softness_db = 1.5;      ///< Logistic scale, above 0.
  double advertisement_rate_hz = 3.0;      ///< Heard per beacon, 0.1 to 10.
};

/// The Earth's field and what the building does to it.
struct MagneticOptions {
  double intensity_ut = 48.0;     ///< 20 to 70.
  double inclination_deg = 60.0;  ///< Downwards positive.
  /// Magnetic north is this far counter-clockwise from the floors' +y.
  double north_offset_deg = 0.0;
  double anomaly_sigma_ut = 4.0;            ///< Smooth part, per axis.
  double anomaly_range_m = 3.0;             ///< Its correlation length, 0.5 to 50.
  double dipoles_per_100m2 = 1.0;           ///< Steel in walls and floors, 0 to 20.
  std::optional<double> dipoles_per_floor;  ///< Their number, 0 to 500; absent: by the area.
  double dipole_field_ut = 25.0;            ///< One metre away, on the equator of the dipole.
  double dipole_weakest_ratio = 0.3;        ///< Dipoles are this times `dipole_field_ut`, 0 to 10,
  double dipole_strongest_ratio = 1.5;  ///< to this times, evenly; not below the weakest, to 10.
  /// How far above or below a phone in the hand they are, 0.5 to 10; absent: in floor and ceiling.
  std::optional<double> dipole_nearest_m;
  std::optional<double> dipole_farthest_m;  ///< Given when dipole_nearest_m is, and not below it.
  double dipole_margin_m = 0.0;  ///< So far beyond the floor's bounds they lie too, 0 to 20.
};

struct AirOptions {
  double sea_level_hpa = 1013.25;    ///< 900 to 1100.
  double ground_elevation_m = 20.0;  ///< Of floor elevation 0 above the sea.
  double weather_sigma_hpa = 0.15;   ///< Slow drift, minutes.
};

}  // namespace waylode::sim
