// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/effective_distance.hpp"

#include <cmath>

#include "waylode/pdr/calibrate_thresholds.hpp"
#include "waylode/pdr/extremum_step_detector.hpp"
#include "waylode/pdr/gravity_filter.hpp"

namespace waylode::experiment {
namespace {

/// Linear acceleration: along up, and along the phone's long axis laid level.
struct Linear {
  core::DeviceTime time;
  double vertical_mps2 = 0.0;
  double forward_mps2 = 0.0;
};

std::vector<Linear> linear_acceleration(std::span<const sample::Sample> walk) {
  pdr::GravityFilter gravity{pdr::GravityFilter::Options()};
  std::vector<Linear> values;
  for (const sample::Sample& sample : walk) {
    if (const auto* rate = std::get_if<sample::GyroscopeSample>(&sample)) gravity.add(*rate);
    const auto* force = std::get_if<sample::AccelerometerSample>(&sample);
    if (force == nullptr) continue;
    gravity.add(*force);
    if (!gravity.up_in_device()) continue;
    const core::Vector3 up = *gravity.up_in_device();
    const core::Vector3 ahead = core::Vector3::UnitY() - up.y() * up;
    const double level = ahead.norm();
    values.push_back({force->time, force->specific_force_mps2.dot(up) - pdr::kStandardGravity_mps2,
                      level > 0.0 ? force->specific_force_mps2.dot(ahead) / level : 0.0});
  }
  return values;
}

/// The signal that the thresholds apply to.
std::vector<double> filtered_signal(std::span<const sample::Sample> walk,
                                    const pdr::ExtremumStepDetector::Options& options) {
  pdr::ExtremumStepDetector::Filter filter(options.decimator);
  std::vector<double> values;
  for (const Linear& linear : linear_acceleration(walk)) {
    if (const auto value = filter.add(linear.time, linear.vertical_mps2)) {
      values.push_back(value->value);
    }
  }
  return values;
}

}  // namespace

core::Result<PersonalSetting> calibrate_person(std::span<const sample::Sample> walk,
                                               std::size_t step_count, double length_m,
                                               double height_m) {
  PersonalSetting setting;
  pdr::DeadReckoning::Options& options = setting.options;
  options.detector = pdr::DeadReckoning::Detector::kExtrema;
  options.heading_source = pdr::DeadReckoning::HeadingSource::kCompass;
  options.stride.model = pdr::StrideModel::Model::kChen;
  options.stride.height_m = height_m;
  const auto thresholds =
      pdr::calibrate_thresholds(filtered_signal(walk, options.extrema), step_count);
  if (!thresholds) return tl::unexpected(thresholds.error());
  setting.calibration_ok = thresholds->calibration_ok;
  if (thresholds->peak_threshold_mps2 > thresholds->trough_threshold_mps2) {
    options.extrema.peak_threshold_mps2 = thresholds->peak_threshold_mps2;
    options.extrema.trough_threshold_mps2 = thresholds->trough_threshold_mps2;
  }
  // On the steps that are found, so that those lost at start and stop are made up for.
  const double told_m = walked_m(walked_steps(walk, options));
  if (!(told_m > 0.0)) {
    return core::fail(core::ErrorCode::kLogLacksRecords,
                      "no step was found in the calibration walk; walk farther", "calibration");
  }
  options.stride.person_ratio *= length_m / told_m;
  return setting;
}

std::vector<observation::MotionDelta> walked_steps(std::span<const sample::Sample> walk,
                                                   const pdr::DeadReckoning::Options& options) {
  pdr::DeadReckoning reckoning(options);
  std::vector<observation::MotionDelta> steps;
  for (const sample::Sample& sample : walk) {
    if (const auto motion = reckoning.add(sample)) steps.push_back(*motion);
  }
  return steps;
}

double walked_m(std::span<const observation::MotionDelta> steps) {
  double sum_m = 0.0;
  for (const observation::MotionDelta& step : steps) sum_m += step.length_m;
  return sum_m;
}

double integrated_m(std::span<const sample::Sample> walk) {
  const std::vector<Linear> values = linear_acceleration(walk);
  if (values.size() < 2) return 0.0;
  double mean_mps2 = 0.0;
  for (const Linear& value : values) mean_mps2 += value.forward_mps2;
  mean_mps2 /= static_cast<double>(values.size());
  double speed_mps = 0.0;
  double way_m = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double dt_s = core::to_seconds(values[i].time - values[i - 1].time);
    speed_mps += (values[i].forward_mps2 - mean_mps2) * dt_s;
    way_m += std::abs(speed_mps) * dt_s;
  }
  return way_m;
}

}  // namespace waylode::experiment
