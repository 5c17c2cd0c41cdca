// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pdr/gravity_filter.hpp"
#include "waylode/pdr/heading_filter.hpp"
#include "waylode/pdr/step_detector.hpp"
#include "waylode/pdr/stride_model.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::pdr {

/// Pedestrian dead reckoning: motion-sensor samples in, one MotionDelta per step out, causally.
class DeadReckoning {
 public:
  struct Options {
    GravityFilter::Options gravity;
    HeadingFilter::Options heading;
    StepDetector::Options step;
    StrideModel::Options stride;
    double step_heading_sigma_rad = 0.08;   ///< Sway and drift from one step to the next.
    double step_length_sigma_ratio = 0.10;  ///< Step-to-step variation around the person's mean.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit DeadReckoning(const Options& options);

  /// Samples in order of time; kinds that do not concern it are passed over. A step is told when it
  /// is confirmed, a fraction of a second after its peak. Its heading is the mean since the step
  /// before; of the first after a pause, that of the last moments, not of the standing.
  std::optional<observation::MotionDelta> add(const sample::Sample& sample);

 private:
  std::optional<observation::MotionDelta> add_accelerometer(
      const sample::AccelerometerSample& sample);
  observation::MotionDelta motion_of(const Step& step, core::DeviceTime told);
  void remember_heading(core::DeviceTime time);

  Options options_;
  GravityFilter gravity_;
  HeadingFilter heading_;
  StepDetector steps_;
  StrideModel stride_;
  struct Direction {
    core::DeviceTime time;
    core::Vector2 unit;
  };
  /// Of the phone since the last step was told, as far back as a step may last.
  std::deque<Direction> directions_;
};

}  // namespace waylode::pdr
