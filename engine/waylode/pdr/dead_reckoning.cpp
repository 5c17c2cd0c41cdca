// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/dead_reckoning.hpp"

#include <cmath>

namespace waylode::pdr {
namespace {

using Detector = DeadReckoning::Detector;

// After a pause nobody knows when the step began: an ordinary step's duration is taken.
constexpr double kOrdinaryStep_s = 0.6;

std::unique_ptr<StepSource> make_detector(const DeadReckoning::Options& options) {
  switch (options.detector) {
    case Detector::kThreshold:
      return std::make_unique<StepDetector>(options.step);
    case Detector::kCadence:
      return std::make_unique<CadenceStepDetector>(options.cadence);
    case Detector::kAdaptivePeaks:
      return std::make_unique<AdaptivePeakDetector>(options.adaptive_peaks);
    case Detector::kGaussianPeaks:
      return std::make_unique<GaussianPeakDetector>(options.gaussian_peaks);
    case Detector::kExtrema:
      return std::make_unique<ExtremumStepDetector>(options.extrema);
  }
  return std::make_unique<StepDetector>(options.step);
}

double longest_interval_s(const DeadReckoning::Options& options) {
  switch (options.detector) {
    case Detector::kThreshold:
      return options.step.longest_interval_s;
    case Detector::kCadence:
      return options.cadence.pause_s;
    case Detector::kAdaptivePeaks:
      return options.adaptive_peaks.longest_interval_s;
    case Detector::kGaussianPeaks:
      return options.gaussian_peaks.longest_interval_s;
    case Detector::kExtrema:
      return options.extrema.longest_interval_s;
  }
  return options.step.longest_interval_s;
}

StepValidity::Options validity_options(const DeadReckoning::Options& options) {
  StepValidity::Options validity = options.step_validity;
  switch (options.validity) {
    case DeadReckoning::Validity::kLiteral:
      validity.rule = StepValidity::Rule::kLiteral;
      break;
    case DeadReckoning::Validity::kExcursion:
      validity.rule = StepValidity::Rule::kExcursion;
      break;
    case DeadReckoning::Validity::kOff:
    case DeadReckoning::Validity::kThreeWay:
      validity.rule = StepValidity::Rule::kThreeWay;
      break;
  }
  return validity;
}

/// A filter that has taken in what is no number never gets rid of it.
bool is_finite(const sample::Sample& sample) {
  if (const auto* acceleration = std::get_if<sample::AccelerometerSample>(&sample)) {
    return acceleration->specific_force_mps2.allFinite();
  }
  if (const auto* rate = std::get_if<sample::GyroscopeSample>(&sample)) {
    return rate->angular_rate_radps.allFinite();
  }
  if (const auto* field = std::get_if<sample::MagnetometerSample>(&sample)) {
    return field->field_ut.allFinite();
  }
  if (const auto* rotation = std::get_if<sample::RotationSample>(&sample)) {
    return rotation->enu_from_device.coeffs().allFinite();
  }
  return true;
}

}  // namespace

core::Result<void> DeadReckoning::Options::validate() const {
  for (const core::Result<void>& part :
       {gravity.validate(), heading.validate(), step.validate(), stride.validate(),
        cadence.validate(), adaptive_peaks.validate(), gaussian_peaks.validate(),
        extrema.validate(), step_validity.validate(), compass.validate()}) {
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
      compass_(options.compass),
      longest_interval_s_(longest_interval_s(options)),
      steps_(make_detector(options)),
      validity_(validity_options(options)),
      stride_(options.stride) {}

std::optional<double> DeadReckoning::heading_rad() const {
  return options_.heading_source == HeadingSource::kCompass ? compass_.heading_rad()
                                                            : heading_.heading_rad();
}

std::optional<observation::MotionDelta> DeadReckoning::add(const sample::Sample& sample) {
  if (!is_finite(sample)) return std::nullopt;
  if (const auto* acceleration = std::get_if<sample::AccelerometerSample>(&sample)) {
    return add_accelerometer(*acceleration);
  }
  const bool is_compass = options_.heading_source == HeadingSource::kCompass;
  const std::optional<core::Vector3>& up = gravity_.up_in_device();
  if (const auto* rotation = std::get_if<sample::RotationSample>(&sample)) {
    if (!is_compass) heading_.add(*rotation);
  } else if (const auto* rate = std::get_if<sample::GyroscopeSample>(&sample)) {
    gravity_.add(*rate);
    if (up && is_compass) compass_.add(*rate, *up);
    if (up && !is_compass) heading_.add(*rate, *up);
  } else if (const auto* field = std::get_if<sample::MagnetometerSample>(&sample)) {
    if (up && is_compass) compass_.add(*field, *up);
    if (up && !is_compass) heading_.add(*field, *up);
  }
  return std::nullopt;
}

std::optional<observation::MotionDelta> DeadReckoning::add_accelerometer(
    const sample::AccelerometerSample& sample) {
  gravity_.add(sample);
  const std::optional<double> heading_rad = this->heading_rad();
  if (heading_rad) remember_heading(sample.time, *heading_rad);
  if (!gravity_.up_in_device()) return std::nullopt;
  const double vertical_mps2 =
      sample.specific_force_mps2.dot(*gravity_.up_in_device()) - kStandardGravity_mps2;
  const double norm_mps2 = sample.specific_force_mps2.norm() - kStandardGravity_mps2;
  const auto judged = next_step({sample.time, vertical_mps2, norm_mps2});
  if (!judged || !heading_rad) return std::nullopt;
  observation::MotionDelta delta = motion_of(judged->step, sample.time);
  if (judged->verdict == StepValidity::Verdict::kInPlace) {
    delta.length_m = 0.0;
    delta.stride = {};
  }
  return delta;
}

std::optional<StepValidity::Judged> DeadReckoning::next_step(const StepInput& input) {
  const std::optional<Step> step = steps_->add(input);
  if (options_.validity == Validity::kOff) {
    return step ? std::optional(StepValidity::Judged{.step = *step}) : std::nullopt;
  }
  if (step) validity_.add_step(*step);
  return validity_.take(input.time);
}

observation::MotionDelta DeadReckoning::motion_of(const Step& step, core::DeviceTime told) {
  observation::MotionDelta delta;
  delta.end = step.time;
  delta.begin = step.time - core::from_seconds(step.interval_s);
  delta.length_m = length_m(step);
  delta.length_sigma_m = options_.step_length_sigma_ratio * delta.length_m;
  delta.heading_rad = mean_heading_rad(step, told);
  delta.heading_sigma_rad = options_.step_heading_sigma_rad;
  Step ordinary = step;
  if (is_after_pause(step)) ordinary.interval_s = kOrdinaryStep_s;
  delta.stride = stride_features(ordinary);
  return delta;
}

double DeadReckoning::length_m(const Step& step) {
  const bool after_pause = is_after_pause(step);
  Step measured = step;
  if (after_pause && options_.stride.model != StrideModel::Model::kThreeTerm) {
    measured.interval_s = kOrdinaryStep_s;
  }
  if (after_pause) last_interval_s_.reset();
  const double length_m = stride_.length_m(measured, last_interval_s_);
  last_interval_s_ = measured.interval_s;
  return length_m;
}

double DeadReckoning::mean_heading_rad(const Step& step, core::DeviceTime told) {
  // A step told at once is that of the directions since the one before was told. One told late, in
  // the wait of StepValidity or with the first of a walk, has its own time.
  const bool may_be_late =
      options_.detector != Detector::kThreshold || options_.validity != Validity::kOff;
  const bool is_late = may_be_late && core::to_seconds(told - step.time) > kOrdinaryStep_s;
  const core::DeviceTime end = is_late ? step.time : told;
  const double span_s = is_after_pause(step)
                            ? kOrdinaryStep_s
                            : (is_late ? step.interval_s : 2.0 * longest_interval_s_);
  const core::DeviceTime begin = end - core::from_seconds(span_s);
  core::Vector2 sum = core::Vector2::Zero();
  for (Direction& direction : directions_) {
    const bool is_its_own = direction.time >= begin && direction.time <= end;
    if (is_its_own && (is_late || !direction.is_told)) sum += direction.unit;
    direction.is_told = true;
  }
  if (sum == core::Vector2::Zero()) sum = directions_.back().unit;
  return std::atan2(sum.y(), sum.x());
}

bool DeadReckoning::is_after_pause(const Step& step) const {
  return step.interval_s >= longest_interval_s_;
}

void DeadReckoning::remember_heading(core::DeviceTime time, double heading_rad) {
  directions_.push_back({time, core::Vector2(std::cos(heading_rad), std::sin(heading_rad)), false});
  // Twice the longest step holds one that is confirmed late, and the validity's wait one more.
  const double wait_s = options_.validity == Validity::kExcursion
                            ? options_.step_validity.excursion.longest_s
                            : 2.0 * options_.step_validity.half_window_s;
  const double kept_s = 2.0 * longest_interval_s_ + wait_s;
  while (directions_.front().time < time - core::from_seconds(kept_s)) directions_.pop_front();
  if (options_.validity != Validity::kOff) validity_.add_heading(time, heading_rad);
}

}  // namespace waylode::pdr
