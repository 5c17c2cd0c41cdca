// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pdr/adaptive_peak_detector.hpp"
#include "waylode/pdr/cadence_step_detector.hpp"
#include "waylode/pdr/compass_heading_filter.hpp"
#include "waylode/pdr/extremum_step_detector.hpp"
#include "waylode/pdr/gaussian_peak_detector.hpp"
#include "waylode/pdr/gravity_filter.hpp"
#include "waylode/pdr/heading_filter.hpp"
#include "waylode/pdr/step_detector.hpp"
#include "waylode/pdr/step_validity.hpp"
#include "waylode/pdr/stride_model.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::pdr {

/// Pedestrian dead reckoning: motion-sensor samples in, one MotionDelta per step out, causally.
class DeadReckoning {
 public:
  enum class Detector {
    kThreshold,      ///< StepDetector.
    kCadence,        ///< CadenceStepDetector.
    kAdaptivePeaks,  ///< AdaptivePeakDetector.
    kGaussianPeaks,  ///< GaussianPeakDetector.
    kExtrema,        ///< ExtremumStepDetector.
  };
  /// Whether steps in place are found out; they cost the wait of StepValidity's window.
  enum class Validity { kOff, kLiteral, kThreeWay, kExcursion };
  enum class HeadingSource {
    kRotationVector,  ///< HeadingFilter: the phone's attitude, else the levelled field.
    kCompass,         ///< CompassHeadingFilter: the raw field alone.
  };

  struct Options {
    GravityFilter::Options gravity;
    HeadingFilter::Options heading;
    StepDetector::Options step;
    StrideModel::Options stride;
    double step_heading_sigma_rad = 0.08;   ///< Sway and drift from one step to the next.
    double step_length_sigma_ratio = 0.10;  ///< Step-to-step variation around the person's mean.
    Detector detector = Detector::kThreshold;
    Validity validity = Validity::kOff;
    HeadingSource heading_source = HeadingSource::kRotationVector;
    CadenceStepDetector::Options cadence;
    AdaptivePeakDetector::Options adaptive_peaks;
    GaussianPeakDetector::Options gaussian_peaks;
    ExtremumStepDetector::Options extrema;
    StepValidity::Options step_validity;  ///< Its rule is taken from `validity`.
    CompassHeadingFilter::Options compass;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit DeadReckoning(const Options& options);

  /// Samples in order of time; kinds that do not concern it, and values that are
  /// not finite, are passed over. A step is told when it
  /// is confirmed, a fraction of a second after its peak. Its heading is the mean since the step
  /// before; of the first after a pause, that of the last moments, not of the standing. A step in
  /// place has no length.
  std::optional<observation::MotionDelta> add(const sample::Sample& sample);

  /// What a StrideCalibrator has learnt; for the steps to come.
  void set_stride_gains(const StrideGains& gains) { stride_.set_gains(gains); }
  /// For the compass alone.
  void set_magnetometer_calibration(const MagnetometerCalibration& calibration) {
    compass_.set_calibration(calibration);
  }

  const std::optional<core::Vector3>& up_in_device() const { return gravity_.up_in_device(); }
  std::optional<double> heading_rad() const;

 private:
  struct Direction {
    core::DeviceTime time;
    core::Vector2 unit;
    bool is_told = false;  ///< As part of an earlier step.
  };
  std::optional<observation::MotionDelta> add_accelerometer(
      const sample::AccelerometerSample& sample);
  std::optional<StepValidity::Judged> next_step(const StepInput& input);
  observation::MotionDelta motion_of(const Step& step, core::DeviceTime told);
  double length_m(const Step& step);
  double mean_heading_rad(const Step& step, core::DeviceTime told);
  bool is_after_pause(const Step& step) const;
  void remember_heading(core::DeviceTime time, double heading_rad);

  Options options_;
  GravityFilter gravity_;
  HeadingFilter heading_;
  CompassHeadingFilter compass_;
  double longest_interval_s_;  ///< Of the detector in use.
  std::unique_ptr<StepSource> steps_;
  StepValidity validity_;
  StrideModel stride_;
  std::optional<double> last_interval_s_;
  std::deque<Direction> directions_;  ///< Of the phone, as far back as a step may have been.
};

}  // namespace waylode::pdr
