// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/heading_filter.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

constexpr double kLongestGap_s = 0.5;  // A hole in the gyroscope's data is not bridged.

}  // namespace

core::Result<void> HeadingFilter::Options::validate() const {
  const bool positive = initial_sigma_rad > 0.0 && gyro_noise_rad_per_sqrt_s > 0.0 &&
                        initial_bias_sigma_radps > 0.0 && bias_walk_radps_per_sqrt_s >= 0.0 &&
                        compass_interval_s >= 0.0 && rotation_sigma_rad > 0.0 &&
                        magnetometer_sigma_rad > 0.0;
  if (!positive) {
    return core::fail(core::ErrorCode::kInvalidOptions, "sigmas must be positive",
                      "heading_filter");
  }
  return {};
}

double heading_of_attitude(const core::Quaternion& enu_from_device) {
  const core::Vector3 long_axis = enu_from_device * core::Vector3::UnitY();
  constexpr double kUpright = 0.9;  // Sine of the tilt beyond which the long axis names no heading.
  if (std::abs(long_axis.z()) <= kUpright) return std::atan2(long_axis.y(), long_axis.x());
  const core::Vector3 back = enu_from_device * -core::Vector3::UnitZ();
  return std::atan2(back.y(), back.x());
}

double HeadingFilter::sigma_rad() const { return std::sqrt(covariance_(0, 0)); }

void HeadingFilter::add(const sample::GyroscopeSample& sample, const core::Vector3& up_in_device) {
  const std::optional<core::DeviceTime> previous = last_gyroscope_;
  last_gyroscope_ = sample.time;
  if (!heading_rad_ || !previous) return;
  const double dt_s = core::to_seconds(sample.time - *previous);
  if (dt_s <= 0.0 || dt_s > kLongestGap_s) return;

  // [Wu2019] eqs. (13), (14): turn rate about the vertical, less the drift. Counter-clockwise.
  const double rate_radps = sample.angular_rate_radps.dot(up_in_device) - bias_radps_;
  heading_rad_ = core::wrap_angle(*heading_rad_ + rate_radps * dt_s);
  core::Matrix2 transition = core::Matrix2::Identity();
  transition(0, 1) = -dt_s;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  covariance_(0, 0) += std::pow(options_.gyro_noise_rad_per_sqrt_s, 2) * dt_s;
  covariance_(1, 1) += std::pow(options_.bias_walk_radps_per_sqrt_s, 2) * dt_s;
}

void HeadingFilter::add(const sample::RotationSample& sample) {
  has_rotation_vector_ = true;
  correct(sample.time, heading_of_attitude(sample.enu_from_device), options_.rotation_sigma_rad);
}

void HeadingFilter::add(const sample::MagnetometerSample& sample,
                        const core::Vector3& up_in_device) {
  if (has_rotation_vector_) return;
  const core::Vector3 east = sample.field_ut.cross(up_in_device);
  constexpr double kWeakestHorizontal_ut = 5.0;  // Less, and the direction is the building's.
  if (east.norm() < kWeakestHorizontal_ut) return;
  core::Quaternion enu_from_device;
  Eigen::Matrix3d rows;
  rows.row(0) = east.normalized();
  rows.row(1) = up_in_device.cross(east.normalized());
  rows.row(2) = up_in_device;
  enu_from_device = core::Quaternion(rows);
  correct(sample.time, heading_of_attitude(enu_from_device), options_.magnetometer_sigma_rad);
}

void HeadingFilter::correct(core::DeviceTime time, double measured_rad, double sigma_rad) {
  if (!heading_rad_) {
    heading_rad_ = measured_rad;
    covariance_ = core::Matrix2::Zero();
    covariance_(0, 0) = std::pow(options_.initial_sigma_rad, 2);
    covariance_(1, 1) = std::pow(options_.initial_bias_sigma_radps, 2);
    last_correction_ = time;
    return;
  }
  if (core::to_seconds(time - *last_correction_) < options_.compass_interval_s) return;
  last_correction_ = time;
  const double innovation_rad = core::wrap_angle(measured_rad - *heading_rad_);
  const double innovation_variance = covariance_(0, 0) + sigma_rad * sigma_rad;
  const core::Vector2 gain = covariance_.col(0) / innovation_variance;
  heading_rad_ = core::wrap_angle(*heading_rad_ + gain(0) * innovation_rad);
  bias_radps_ += gain(1) * innovation_rad;
  const core::Matrix2 reduction = gain * covariance_.row(0);
  covariance_ -= 0.5 * (reduction + reduction.transpose()).eval();
}

}  // namespace waylode::pdr
