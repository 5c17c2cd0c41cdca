// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "waylode/observation/observation.hpp"
#include "waylode/pdr/displacement_segmenter.hpp"
#include "waylode/pdr/stride_calibrator.hpp"
#include "waylode/site/site.hpp"

namespace waylode::pipeline {

/// Corrects the gains of the improved stride on line from what scans say of the way [Wu2019] 2.3:
/// along each straight stretch, the distance between the places of its first and its last scan,
/// taken along the steps' direction, against the steps between. A scan's place alone counts, not
/// what fusion made of it, which has the steps in it already.
class StrideLearning {
 public:
  StrideLearning(const site::Site& site, const pdr::StrideCalibrator::Options& options)
      : site_(&site), calibrator_(options) {}

  /// A step. The corrected gains when a stretch has ended that told something.
  std::optional<pdr::StrideGains> add(const observation::MotionDelta& motion);
  /// A scan's place; the floor most likely by this scan alone counts.
  void add(const observation::RadioObservation& observation);

  const pdr::StrideGains& gains() const { return calibrator_.gains(); }

 private:
  struct Place {
    core::DeviceTime time;
    core::FloorId floor;
    core::Vector2 position_m = core::Vector2::Zero();         ///< Site frame.
    core::Matrix2 covariance_m2 = core::Matrix2::Identity();  ///< Site frame.
  };
  std::optional<pdr::StrideGains> learn(const pdr::Displacement& stretch);

  const site::Site* site_;
  pdr::StrideCalibrator calibrator_;
  pdr::DisplacementSegmenter segmenter_{pdr::DisplacementSegmenter::Options()};
  std::vector<observation::MotionDelta> steps_;  ///< Of the open stretch, and one of the next.
  std::vector<Place> places_;
};

}  // namespace waylode::pipeline
