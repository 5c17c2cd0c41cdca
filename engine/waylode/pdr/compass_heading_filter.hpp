// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/pdr/magnetometer_calibration.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::pdr {

/// Heading from the gyroscope and the raw compass, by a Kalman filter over (heading, gyro bias) as
/// [Wu2019] 2.4 sketches it: the turn about the vertical predicts, the levelled field corrects, the
/// less the more it departs from the earth's in strength or dip. Headings are counter-clockwise
/// from true east, which turns the signs of the paper's azimuths round.
class CompassHeadingFilter {
 public:
  struct Options {
    double gyro_noise_rad_per_sqrt_s = 0.01;
    double initial_bias_sigma_radps = 0.01;
    double bias_walk_radps_per_sqrt_s = 0.0003;
    double compass_interval_s = 0.1;  ///< The compass is asked at most this often.
    double compass_sigma_rad = 0.35;  ///< Of one compass heading in an undisturbed field.
    /// A building's field errs alike over some steps: how long, >= 0. One heading of many within
    /// that time counts for little.
    double correlation_s = 1.0;
    double field_ut = 0.0;            ///< The earth's; 0: the mean of the first two seconds.
    double dip_rad = 0.0;             ///< The earth's; used where field_ut is set.
    double field_tolerance_ut = 3.0;  ///< This far off, the compass counts half; > 0.
    double dip_tolerance_rad = 0.1;   ///< The same for the dip.
    double gate_sigmas = 3.0;         ///< Headings further off than this are not used; > 0.
    double lost_after_s = 10.0;       ///< After so long without a usable one, starts afresh.
    double declination_rad = 0.0;     ///< Magnetic north, east of true north.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit CompassHeadingFilter(const Options& options) : options_(options) {}

  void set_calibration(const MagnetometerCalibration& calibration) { calibration_ = calibration; }

  /// Samples in order of time, `up_in_device` a unit vector. What is not finite is passed over.
  void add(const sample::GyroscopeSample& sample, const core::Vector3& up_in_device);
  void add(const sample::MagnetometerSample& sample, const core::Vector3& up_in_device);

  /// nullopt until a usable compass heading has come.
  std::optional<double> heading_rad() const { return heading_rad_; }
  double bias_radps() const { return bias_radps_; }
  /// Of (heading, bias).
  const core::Matrix2& covariance() const { return covariance_; }

 private:
  struct Reference {
    double field_ut = 0.0;
    double dip_rad = 0.0;
    std::size_t count = 0;
    core::DeviceTime begin;
  };
  void learn_reference(core::DeviceTime time, double field_ut, double dip_rad);
  double compass_variance_rad2(double field_ut, double dip_rad) const;
  void start(core::DeviceTime time, double measured_rad, double variance_rad2);
  void correct(core::DeviceTime time, double measured_rad, double variance_rad2);

  Options options_;
  MagnetometerCalibration calibration_;
  std::optional<double> heading_rad_;
  double bias_radps_ = 0.0;
  core::Matrix2 covariance_ = core::Matrix2::Zero();
  std::optional<Reference> reference_;
  std::optional<core::DeviceTime> last_gyroscope_;
  core::DeviceTime last_asked_;
  core::DeviceTime last_used_;
};

}  // namespace waylode::pdr
