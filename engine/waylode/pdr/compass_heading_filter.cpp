// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/compass_heading_filter.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/pdr/magnetic_heading.hpp"

namespace waylode::pdr {
namespace {

constexpr double kLongestGap_s = 0.5;  // A hole in the gyroscope's data is not bridged.

double square(double value) { return value * value; }

/// By how much one of many alike-erring measurements must be doubted more: the sum of their
/// correlations, for errors that forget exponentially.
double correlation_inflation(double apart_s, double correlation_s) {
  if (!(correlation_s > 0.0)) return 1.0;
  const double alike = std::exp(-apart_s / correlation_s);
  return (1.0 + alike) / (1.0 - alike);
}

}  // namespace

core::Result<void> CompassHeadingFilter::Options::validate() const {
  const bool sound = gyro_noise_rad_per_sqrt_s > 0.0 && initial_bias_sigma_radps > 0.0 &&
                     bias_walk_radps_per_sqrt_s >= 0.0 && compass_interval_s > 0.0 &&
                     compass_sigma_rad > 0.0 && correlation_s >= 0.0 && field_ut >= 0.0 &&
                     std::abs(dip_rad) <= core::kPi / 2.0 && field_tolerance_ut > 0.0 &&
                     dip_tolerance_rad > 0.0 && gate_sigmas > 0.0 && lost_after_s > 0.0 &&
                     std::abs(declination_rad) <= core::kPi;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "sigmas, tolerances and intervals must be positive, angles in range",
                      "compass_heading_filter");
  }
  return {};
}

void CompassHeadingFilter::add(const sample::GyroscopeSample& sample,
                               const core::Vector3& up_in_device) {
  if (!sample.angular_rate_radps.allFinite()) return;
  const std::optional<core::DeviceTime> previous = last_gyroscope_;
  last_gyroscope_ = sample.time;
  if (!heading_rad_ || !previous) return;
  const double dt_s = core::to_seconds(sample.time - *previous);
  if (dt_s <= 0.0 || dt_s > kLongestGap_s) return;

  // [Wu2019] eqs. (13), (14), the latter with the time step that its print leaves out. About up a
  // positive rate is counter-clockwise, so here it adds.
  const double rate_radps = sample.angular_rate_radps.dot(up_in_device) - bias_radps_;
  heading_rad_ = core::wrap_angle(*heading_rad_ + rate_radps * dt_s);
  core::Matrix2 transition = core::Matrix2::Identity();
  transition(0, 1) = -dt_s;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  covariance_(0, 0) += square(options_.gyro_noise_rad_per_sqrt_s) * dt_s;
  covariance_(1, 1) += square(options_.bias_walk_radps_per_sqrt_s) * dt_s;
}

void CompassHeadingFilter::add(const sample::MagnetometerSample& sample,
                               const core::Vector3& up_in_device) {
  const LevelledField field = level(calibration_.apply(sample.field_ut), up_in_device);
  const std::optional<double> azimuth_rad = magnetic_azimuth_rad(field);
  const double field_ut = std::hypot(field.horizontal_ut(), field.up_ut);
  if (!azimuth_rad || !std::isfinite(field_ut)) return;
  learn_reference(sample.time, field_ut, field.dip_rad());
  const double measured_rad =
      core::heading_from_azimuth(true_azimuth_rad(*azimuth_rad, options_.declination_rad));
  const double variance_rad2 = compass_variance_rad2(field_ut, field.dip_rad());
  if (heading_rad_) {
    correct(sample.time, measured_rad, variance_rad2);
  } else {
    start(sample.time, measured_rad, variance_rad2);
  }
}

void CompassHeadingFilter::learn_reference(core::DeviceTime time, double field_ut, double dip_rad) {
  if (options_.field_ut > 0.0) {
    reference_ = Reference{options_.field_ut, options_.dip_rad, 1, time};
    return;
  }
  constexpr double kLearning_s = 2.0;
  if (!reference_) reference_ = Reference{.begin = time};
  if (core::to_seconds(time - reference_->begin) > kLearning_s) return;
  ++reference_->count;
  const double share = 1.0 / static_cast<double>(reference_->count);
  reference_->field_ut += share * (field_ut - reference_->field_ut);
  reference_->dip_rad += share * (dip_rad - reference_->dip_rad);
}

double CompassHeadingFilter::compass_variance_rad2(double field_ut, double dip_rad) const {
  const double strength = (field_ut - reference_->field_ut) / options_.field_tolerance_ut;
  const double dip = (dip_rad - reference_->dip_rad) / options_.dip_tolerance_rad;
  return square(options_.compass_sigma_rad) * (1.0 + square(strength) + square(dip));
}

void CompassHeadingFilter::start(core::DeviceTime time, double measured_rad, double variance_rad2) {
  heading_rad_ = core::wrap_angle(measured_rad);
  bias_radps_ = 0.0;
  covariance_ = core::Matrix2::Zero();
  covariance_(0, 0) = variance_rad2;
  covariance_(1, 1) = square(options_.initial_bias_sigma_radps);
  last_asked_ = last_used_ = time;
}

void CompassHeadingFilter::correct(core::DeviceTime time, double measured_rad,
                                   double variance_rad2) {
  const double apart_s = core::to_seconds(time - last_asked_);
  if (apart_s < options_.compass_interval_s) return;
  last_asked_ = time;
  const double innovation_rad = core::wrap_angle(measured_rad - *heading_rad_);
  const double gate_rad = options_.gate_sigmas * std::sqrt(covariance_(0, 0) + variance_rad2);
  if (std::abs(innovation_rad) > gate_rad) {
    if (core::to_seconds(time - last_used_) > options_.lost_after_s) {
      start(time, measured_rad, variance_rad2);
    }
    return;
  }
  last_used_ = time;
  const double doubt_rad2 = variance_rad2 * correlation_inflation(apart_s, options_.correlation_s);
  const core::Vector2 gain = covariance_.col(0) / (covariance_(0, 0) + doubt_rad2);
  heading_rad_ = core::wrap_angle(*heading_rad_ + gain(0) * innovation_rad);
  bias_radps_ += gain(1) * innovation_rad;
  const core::Matrix2 reduction = gain * covariance_.row(0);
  covariance_ -= 0.5 * (reduction + reduction.transpose()).eval();
}

}  // namespace waylode::pdr
