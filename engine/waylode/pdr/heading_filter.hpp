// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::pdr {

/// Heading of the phone: the gyroscope's turn about the vertical, held to the compass in the long
/// run by a Kalman filter over (heading, gyro bias). Headings are counter-clockwise from (magnetic)
/// east; a constant offset to the walking direction is left to fusion.
class HeadingFilter {
 public:
  struct Options {
    double initial_sigma_rad = 0.3;
    double gyro_noise_rad_per_sqrt_s = 0.01;
    double initial_bias_sigma_radps = 0.01;
    double bias_walk_radps_per_sqrt_s = 0.0003;
    /// Indoors the compass is wrong for seconds at a stretch, so it is asked rarely and trusted
    /// little.
    double compass_interval_s = 0.5;
    double rotation_sigma_rad = 0.8;  ///< Of the phone's rotation vector.
    double magnetometer_sigma_rad =
        1.2;  ///< Of the levelled field, where there is no rotation vector.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit HeadingFilter(const Options& options) : options_(options) {}

  void add(const sample::GyroscopeSample& sample, const core::Vector3& up_in_device);
  void add(const sample::RotationSample& sample);
  void add(const sample::MagnetometerSample& sample, const core::Vector3& up_in_device);

  /// nullopt until a compass has spoken.
  std::optional<double> heading_rad() const { return heading_rad_; }
  double sigma_rad() const;

 private:
  void correct(core::DeviceTime time, double measured_rad, double sigma_rad);

  Options options_;
  std::optional<double> heading_rad_;
  double bias_radps_ = 0.0;
  core::Matrix2 covariance_ = core::Matrix2::Zero();  ///< Of (heading, bias).
  std::optional<core::DeviceTime> last_gyroscope_;
  std::optional<core::DeviceTime> last_correction_;
  bool has_rotation_vector_ = false;
};

/// Heading of the phone's long axis (y), or of its back when the long axis stands upright.
double heading_of_attitude(const core::Quaternion& enu_from_device);

}  // namespace waylode::pdr
