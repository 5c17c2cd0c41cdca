// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/dead_reckoning.hpp"

#include <cmath>

namespace waylode::pdr {

core::Result<void> DeadReckoning::Options::validate() const {
  for (const core::Result<void>& part :
       {gravity.validate(), heading.validate(), step.validate(), stride.validate()}) {
    if (!part) return part;
  }
  if (!(step_heading_sigma_rad > 0.0 && step_length_sigma_ratio > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "step sigmas must be positive",
                      "dead_reckoning");
  }
  return {};
}

DeadReckoning::DeadReckoning(const Options& options)
    : options_(options),
      gravity_(options.gravity),
      heading_(options.heading),
      steps_(options.step),
      stride_(options.stride) {}

std::optional<observation::MotionDelta> DeadReckoning::add(const sample::Sample& sample) {
  if (const auto* acceleration = std::get_if<sample::AccelerometerSample>(&sample)) {
    return add_accelerometer(*acceleration);
  }
  if (const auto* rotation = std::get_if<sample::RotationSample>(&sample)) {
    heading_.add(*rotation);
  } else if (const auto* rate = std::get_if<sample::GyroscopeSample>(&sample)) {
    gravity_.add(*rate);
    if (gravity_.up_in_device()) heading_.add(*rate, *gravity_.up_in_device());
  } else if (const auto* field = std::get_if<sample::MagnetometerSample>(&sample)) {
    if (gravity_.up_in_device()) heading_.add(*field, *gravity_.up_in_device());
  }
  return std::nullopt;
}

std::optional<observation::MotionDelta> DeadReckoning::add_accelerometer(
    const sample::AccelerometerSample& sample) {
  gravity_.add(sample);
  if (heading_.heading_rad()) remember_heading(sample.time);
  if (!gravity_.up_in_device()) return std::nullopt;
  const double vertical_mps2 =
      sample.specific_force_mps2.dot(*gravity_.up_in_device()) - kStandardGravity_mps2;
  const std::optional<Step> step = steps_.add(sample.time, vertical_mps2);
  if (!step || !heading_.heading_rad()) return std::nullopt;
  return motion_of(*step, sample.time);
}

observation::MotionDelta DeadReckoning::motion_of(const Step& step, core::DeviceTime told) {
  observation::MotionDelta delta;
  delta.end = step.time;
  delta.begin = step.time - core::from_seconds(step.interval_s);
  delta.length_m = stride_.length_m(step);
  delta.length_sigma_m = options_.step_length_sigma_ratio * delta.length_m;
  // After a pause nobody knows when the step began: an ordinary step's duration is taken.
  constexpr double kOrdinaryStep_s = 0.6;
  const bool after_pause = step.interval_s >= options_.step.longest_interval_s;
  core::Vector2 sum = core::Vector2::Zero();
  for (const Direction& direction : directions_) {
    const double age_s = core::to_seconds(told - direction.time);
    if (!after_pause || age_s <= kOrdinaryStep_s) sum += direction.unit;
  }
  delta.heading_rad = std::atan2(sum.y(), sum.x());
  delta.heading_sigma_rad = options_.step_heading_sigma_rad;
  directions_.clear();
  return delta;
}

void DeadReckoning::remember_heading(core::DeviceTime time) {
  const double heading_rad = *heading_.heading_rad();
  directions_.push_back({time, core::Vector2(std::cos(heading_rad), std::sin(heading_rad))});
  // Twice the longest step holds one that is confirmed late.
  const core::Duration kept = core::from_seconds(2.0 * options_.step.longest_interval_s);
  while (directions_.front().time < time - kept) directions_.pop_front();
}

}  // namespace waylode::pdr
