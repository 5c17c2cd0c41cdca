// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/gravity_filter.hpp"

#include <algorithm>

namespace waylode::pdr {
namespace {

constexpr double kLongestGap_s = 0.5;  // Over a longer gap in the data nothing is integrated.

}  // namespace

core::Result<void> GravityFilter::Options::validate() const {
  if (!(accelerometer_tau_s > 0.0 && accelerometer_tau_s <= 60.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "accelerometer_tau_s must be in (0, 60]",
                      "gravity_filter");
  }
  return {};
}

void GravityFilter::add(const sample::AccelerometerSample& sample) {
  const double magnitude_mps2 = sample.specific_force_mps2.norm();
  constexpr double kFreeFall_mps2 = 1.0;  // Below it the direction is noise.
  if (magnitude_mps2 < kFreeFall_mps2) return;
  const core::Vector3 measured_up = sample.specific_force_mps2 / magnitude_mps2;
  if (!up_in_device_) {
    up_in_device_ = measured_up;
  } else {
    const double dt_s =
        std::clamp(core::to_seconds(sample.time - *last_accelerometer_), 0.0, kLongestGap_s);
    const double gain = dt_s / (options_.accelerometer_tau_s + dt_s);
    up_in_device_ = ((1.0 - gain) * *up_in_device_ + gain * measured_up).normalized();
  }
  last_accelerometer_ = sample.time;
}

void GravityFilter::add(const sample::GyroscopeSample& sample) {
  if (up_in_device_ && last_gyroscope_) {
    const double dt_s = core::to_seconds(sample.time - *last_gyroscope_);
    if (dt_s > 0.0 && dt_s <= kLongestGap_s) {
      // A direction fixed in the world turns against the device's own rotation. To first order
      // only, up would creep away from the axis of a fast turn.
      const double rate_radps = sample.angular_rate_radps.norm();
      if (rate_radps > 0.0) {
        const core::Vector3 axis = sample.angular_rate_radps / rate_radps;
        up_in_device_ = (Eigen::AngleAxisd(-rate_radps * dt_s, axis) * *up_in_device_).normalized();
      }
    }
  }
  last_gyroscope_ = sample.time;
}

}  // namespace waylode::pdr
