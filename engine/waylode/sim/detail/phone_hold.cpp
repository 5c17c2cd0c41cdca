// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/sim/detail/phone.hpp"

namespace waylode::sim::detail {

namespace {

using core::kPi;
using core::Quaternion;
using core::Vector3;

double draw_offset_rad(const PhoneOptions& options, core::Rng& rng) {
  constexpr double kHoldSigma_deg = 5.0;
  const double drawn_deg = rng.normal(0.0, kHoldSigma_deg);
  return core::radians_from_degrees(options.hold_offset_deg.value_or(drawn_deg));
}

double mean_pitch_rad(PhoneOptions::Pose pose, core::Rng& rng) {
  const double own_rad = rng.normal(0.0, 0.08);
  if (pose == PhoneOptions::Pose::kHand) return 0.45 + own_rad;
  if (pose == PhoneOptions::Pose::kPocket) return 1.5 + own_rad;
  return -0.4 + own_rad;
}

/// Zero-mean wave of one step with its crest just after the heel strike.
double raw_bounce(double ratio) {
  const double angle_rad = 2.0 * kPi * (ratio - 0.12);
  return std::cos(angle_rad) + 0.3 * std::cos(2.0 * angle_rad) + 0.1 * std::cos(3.0 * angle_rad);
}

/// Highest minus lowest of raw_bounce, which rises with the cosine: 1.4 at the crest, -0.8
/// opposite.
constexpr double kRawBounceRange = 2.2;

}  // namespace

PhoneHold::PhoneHold(const PhoneOptions& options, core::Rng& rng)
    : pose_(options.pose),
      yaw_rad_(draw_offset_rad(options, rng)),
      pitch_rad_(mean_pitch_rad(options.pose, rng)),
      roll_rad_(rng.normal(0.0, 0.05)),
      sway_rad_(core::radians_from_degrees(options.sway_deg)),
      tilt_wander_rad_(0.03),
      yaw_wander_(rng, 20.0),
      pitch_wander_(rng, 8.0),
      roll_wander_(rng, 8.0) {
  if (options.is_flat) pitch_rad_ = roll_rad_ = tilt_wander_rad_ = 0.0;
}

Quaternion PhoneHold::site_from_device(const BodyState& body, double t_s) const {
  constexpr double kYawWander_rad = 0.035;
  const double sway_rad = sway_rad_ * std::sin(kPi * body.step_phase);
  const double yaw_rad =
      body.heading_rad + yaw_rad_ + sway_rad + kYawWander_rad * yaw_wander_.at(t_s);
  const double pitch_rad =
      pitch_rad_ + tilt_wander_rad_ * pitch_wander_.at(t_s) + swing(body).angle_rad;
  const double roll_rad = roll_rad_ + tilt_wander_rad_ * roll_wander_.at(t_s);
  // The top edge looks along the heading.
  return Quaternion(Eigen::AngleAxisd(yaw_rad - kPi / 2.0, Vector3::UnitZ()) *
                    Eigen::AngleAxisd(pitch_rad, Vector3::UnitX()) *
                    Eigen::AngleAxisd(roll_rad, Vector3::UnitY()));
}

double PhoneHold::height_m() const {
  if (pose_ == PhoneOptions::Pose::kHand) return kHandHeight_m;
  return pose_ == PhoneOptions::Pose::kPocket ? 0.85 : 0.75;
}

double PhoneHold::arm_m() const {
  if (pose_ == PhoneOptions::Pose::kHand) return 0.0;
  return pose_ == PhoneOptions::Pose::kPocket ? 0.15 : 0.6;
}

PhoneHold::Swing PhoneHold::swing(const BodyState& body) const {
  if (pose_ == PhoneOptions::Pose::kHand) return {};
  const double amplitude_rad = pose_ == PhoneOptions::Pose::kPocket ? 0.35 : 0.4;
  const double rate_radps = kPi * body.cadence_hz;
  const double angle_rad = amplitude_rad * std::sin(kPi * body.step_phase);
  return {angle_rad, amplitude_rad * rate_radps * std::cos(kPi * body.step_phase),
          -rate_radps * rate_radps * angle_rad};
}

Vector3 gait_acceleration_mps2(const BodyState& body, double turn_rate_radps,
                               const PhoneHold& hold) {
  if (body.cadence_hz == 0.0) return Vector3::Zero();
  const double ratio = body.step_phase - std::floor(body.step_phase);
  if (body.is_in_place) {
    // Soft, without a heel strike.
    return {0.0, 0.0, 0.5 * body.bounce_mps2 * std::cos(2.0 * kPi * (ratio - 0.12))};
  }
  const double half_mps2 = body.bounce_mps2 / kRawBounceRange;
  Vector3 sum_mps2(
      0.45 * half_mps2 * std::sin(2.0 * kPi * (ratio - 0.05)),
      0.22 * half_mps2 * std::sin(kPi * body.step_phase) * std::cos(kPi * body.step_phase * 2.0),
      half_mps2 * raw_bounce(ratio));
  sum_mps2.y() += body.speed_mps * turn_rate_radps;
  const double from_rest_mps2 =
      body.speed_mps * body.cadence_hz * (1.0 - std::cos(2.0 * kPi * ratio));
  if (body.is_first_step) sum_mps2.x() += from_rest_mps2;
  if (body.is_last_step) sum_mps2.x() -= from_rest_mps2;
  const PhoneHold::Swing swing = hold.swing(body);
  const double tangential_mps2 = hold.arm_m() * swing.acceleration_radps2;
  const double central_mps2 = hold.arm_m() * swing.rate_radps * swing.rate_radps;
  sum_mps2.x() +=
      tangential_mps2 * std::cos(swing.angle_rad) - central_mps2 * std::sin(swing.angle_rad);
  sum_mps2.z() +=
      tangential_mps2 * std::sin(swing.angle_rad) + central_mps2 * std::cos(swing.angle_rad);
  return sum_mps2;
}

}  // namespace waylode::sim::detail
