// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/phone.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/sim/detail/air.hpp"

namespace waylode::sim::detail {

namespace {

using core::Quaternion;
using core::Vector3;

Vector3 draw_vector(core::Rng& rng, double sigma) {
  const double x = rng.normal(0.0, sigma);
  const double y = rng.normal(0.0, sigma);
  const double z = rng.normal(0.0, sigma);
  return {x, y, z};
}

Quaternion about_up(double angle_rad) {
  return Quaternion(Eigen::AngleAxisd(angle_rad, Vector3::UnitZ()));
}

/// What the phone's calibration leaves; fixed for one recording.
struct Biases {
  Vector3 accelerometer_mps2;
  Vector3 gyroscope_radps;
  Vector3 magnetometer_ut;
  Quaternion magnetometer_turn = Quaternion::Identity();
};

Biases draw_biases(const PhoneOptions& options, core::Rng& rng) {
  Biases biases;
  biases.accelerometer_mps2 = draw_vector(rng, options.accelerometer_bias_sigma_mps2);
  biases.gyroscope_radps =
      draw_vector(rng, core::radians_from_degrees(options.gyroscope_bias_sigma_degps));
  biases.magnetometer_ut = draw_vector(rng, options.magnetometer_bias_sigma_ut);
  if (options.magnetometer_yaw_sigma_deg > 0.0) {
    biases.magnetometer_turn =
        about_up(core::radians_from_degrees(rng.normal(0.0, options.magnetometer_yaw_sigma_deg)));
  }
  return biases;
}

Vector3 mean_rate_radps(const Quaternion& before, const Quaternion& after, double dt_s) {
  const Eigen::AngleAxisd turn(before.conjugate() * after);
  return turn.axis() * (core::wrap_angle(turn.angle()) / dt_s);
}

/// Yaw error of the phone's own attitude: slow drift, and field disturbances that creep in.
class AttitudeError {
 public:
  AttitudeError(const PhoneOptions& options, core::Rng& rng)
      : drift_(rng, 60.0),
        drift_rad_(core::radians_from_degrees(options.attitude_drift_sigma_deg)),
        magnetic_ratio_(options.attitude_magnetic_ratio) {}

  double update(double t_s, double dt_s, const Vector3& field_ut, const Vector3& earth_ut) {
    const double turned_rad = core::wrap_angle(std::atan2(field_ut.y(), field_ut.x()) -
                                               std::atan2(earth_ut.y(), earth_ut.x()));
    constexpr double kCreep_s = 4.0;
    magnetic_rad_ += std::min(1.0, dt_s / kCreep_s) * (turned_rad - magnetic_rad_);
    // A phone whose north is turned counter-clockwise believes itself turned clockwise.
    return drift_rad_ * drift_.at(t_s) - magnetic_ratio_ * magnetic_rad_;
  }

 private:
  SmoothNoise drift_;
  double drift_rad_;
  double magnetic_ratio_;
  double magnetic_rad_ = 0.0;
};

}  // namespace

void sense_motion(const Walk& walk, const MagneticWorld& world, const MagneticOptions& magnetic,
                  const PhoneOptions& options, core::DeviceTime epoch, core::Rng& rng,
                  std::vector<sample::Sample>& samples) {
  const PhoneHold hold(options, rng);
  const Biases biases = draw_biases(options, rng);
  AttitudeError attitude_error(options, rng);
  const double gyroscope_noise_radps = core::radians_from_degrees(options.gyroscope_noise_degps);
  const double north_offset_rad = core::radians_from_degrees(magnetic.north_offset_deg);
  const double dt_s = 1.0 / options.imu_rate_hz;
  const auto count = static_cast<std::int64_t>(std::floor(walk.duration_s() / dt_s));
  double last_heading_rad = walk.at(0.0).heading_rad;
  Quaternion last_attitude = hold.site_from_device(walk.at(0.0), 0.0);
  samples.reserve(samples.size() + static_cast<std::size_t>(4 * count));
  for (std::int64_t i = 1; i <= count; ++i) {
    const double t_s = static_cast<double>(i) * dt_s;
    const core::DeviceTime time = epoch + core::from_seconds(t_s);
    const BodyState body = walk.at(t_s);
    const Quaternion site_from_device = hold.site_from_device(body, t_s);
    const double turn_rate_radps = (body.heading_rad - last_heading_rad) / dt_s;
    const Vector3 in_heading_mps2 = gait_acceleration_mps2(body, turn_rate_radps, hold);
    const Vector3 force_mps2 =
        about_up(body.heading_rad) * in_heading_mps2 + kStandardGravity_mps2 * Vector3::UnitZ();
    const Vector3 field_ut = world.at(body.floor, body.position_m, hold.height_m());
    const Quaternion device_from_site = site_from_device.conjugate();
    samples.push_back(sample::AccelerometerSample{
        time, device_from_site * force_mps2 + biases.accelerometer_mps2 +
                  draw_vector(rng, options.accelerometer_noise_mps2)});
    samples.push_back(sample::GyroscopeSample{
        time, mean_rate_radps(last_attitude, site_from_device, dt_s) + biases.gyroscope_radps +
                  draw_vector(rng, gyroscope_noise_radps)});
    samples.push_back(sample::MagnetometerSample{
        time,
        biases.magnetometer_turn * (device_from_site * field_ut) + biases.magnetometer_ut +
            draw_vector(rng, options.magnetometer_noise_ut),
        3});
    last_heading_rad = body.heading_rad;
    last_attitude = site_from_device;
    if (!options.has_attitude) continue;
    const double error_rad = attitude_error.update(t_s, dt_s, field_ut, world.earth_ut());
    samples.push_back(sample::RotationSample{
        time, (about_up(error_rad - north_offset_rad) * site_from_device).normalized()});
  }
}

void sense_air(const Walk& walk, const AirOptions& air, const SmoothNoise& weather,
               double weather_s, const PhoneOptions& options, core::DeviceTime epoch,
               core::Rng& rng, std::vector<sample::Sample>& samples) {
  if (options.barometer_rate_hz <= 0.0) return;
  constexpr double kPhoneHeight_m = 1.1;
  const double dt_s = 1.0 / options.barometer_rate_hz;
  const auto count = static_cast<std::int64_t>(std::floor(walk.duration_s() / dt_s));
  for (std::int64_t i = 1; i <= count; ++i) {
    const double t_s = static_cast<double>(i) * dt_s;
    const double elevation_m = air.ground_elevation_m + walk.at(t_s).elevation_m + kPhoneHeight_m;
    const double true_hpa = pressure_hpa(elevation_m, air.sea_level_hpa) +
                            air.weather_sigma_hpa * weather.at(weather_s + t_s);
    samples.push_back(sample::BarometerSample{
        epoch + core::from_seconds(t_s),
        true_hpa + options.barometer_offset_hpa + rng.normal(0.0, options.barometer_noise_hpa)});
  }
}

}  // namespace waylode::sim::detail
