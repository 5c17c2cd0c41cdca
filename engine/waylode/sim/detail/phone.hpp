// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/core/time.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/sim/detail/magnetic_world.hpp"
#include "waylode/sim/detail/random_field.hpp"
#include "waylode/sim/detail/walk.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

inline constexpr double kStandardGravity_mps2 = 9.80665;

/// How the phone is held while its owner walks: attitude and height as functions of the body.
class PhoneHold {
 public:
  PhoneHold(const PhoneOptions& options, core::Rng& rng);
  /// Rotates device vectors (x right, y to the top edge, z out of the screen) into the site frame.
  core::Quaternion site_from_device(const BodyState& body, double t_s) const;
  double height_m() const;
  /// Swing of arm or thigh against the vertical, and its rates; 0 for a phone in front of the body.
  struct Swing {
    double angle_rad = 0.0;
    double rate_radps = 0.0;
    double acceleration_radps2 = 0.0;
  };
  Swing swing(const BodyState& body) const;
  double arm_m() const;  ///< From the joint that swings to the phone.

 private:
  PhoneOptions::Pose pose_;
  double yaw_rad_;
  double pitch_rad_;
  double roll_rad_;
  double sway_rad_;
  double tilt_wander_rad_;
  SmoothNoise yaw_wander_;
  SmoothNoise pitch_wander_;
  SmoothNoise roll_wander_;
};

/// Acceleration of the phone without gravity, in the heading frame (forward, left, up). Averages
/// to what speeding up and turning need: the rest is the gait's waveform, zero over a stride.
core::Vector3 gait_acceleration_mps2(const BodyState& body, double turn_rate_radps,
                                     const PhoneHold& hold);

/// Accelerometer, gyroscope, magnetometer and attitude over a whole walk, appended to `samples`.
/// `epoch` is the device time of t = 0.
void sense_motion(const Walk& walk, const MagneticWorld& world, const MagneticOptions& magnetic,
                  const PhoneOptions& options, core::DeviceTime epoch, core::Rng& rng,
                  std::vector<sample::Sample>& samples);

/// The barometer over a whole walk. `weather_s` is the time of t = 0 in the weather's life.
void sense_air(const Walk& walk, const AirOptions& air, const SmoothNoise& weather,
               double weather_s, const PhoneOptions& options, core::DeviceTime epoch,
               core::Rng& rng, std::vector<sample::Sample>& samples);

}  // namespace waylode::sim::detail
