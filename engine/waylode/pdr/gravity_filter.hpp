// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::pdr {

inline constexpr double kStandardGravity_mps2 = 9.80665;

/// Which way is up in the device frame: the accelerometer in the long run, the gyroscope between
/// (a complementary filter). Any pose of the phone.
class GravityFilter {
 public:
  struct Options {
    double accelerometer_tau_s = 2.0;  ///< Longer: less walking bounce; shorter: less gyro drift.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit GravityFilter(const Options& options) : options_(options) {}

  void add(const sample::AccelerometerSample& sample);
  void add(const sample::GyroscopeSample& sample);

  /// Unit vector in the device frame; nullopt before the first accelerometer sample.
  const std::optional<core::Vector3>& up_in_device() const { return up_in_device_; }

 private:
  Options options_;
  std::optional<core::Vector3> up_in_device_;
  std::optional<core::DeviceTime> last_accelerometer_;
  std::optional<core::DeviceTime> last_gyroscope_;
};

}  // namespace waylode::pdr
