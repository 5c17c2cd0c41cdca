// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/stride_learning.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pipeline {

std::optional<pdr::StrideGains> StrideLearning::add(const observation::MotionDelta& motion) {
  const auto ended = segmenter_.add(motion);
  std::optional<pdr::StrideGains> learnt;
  if (ended) {
    learnt = learn(*ended);
    steps_.clear();
    std::erase_if(places_, [&](const Place& place) { return place.time < motion.begin; });
  }
  steps_.push_back(motion);
  return learnt;
}

void StrideLearning::add(const observation::RadioObservation& observation) {
  const observation::FloorHypothesis& best = observation.floors.front();
  places_.push_back({observation.measured, best.floor,
                     site_->site_from_floor(best.floor, best.position_m),
                     site_->floor(best.floor).site_from_floor.map_covariance(best.covariance_m2)});
}

std::optional<pdr::StrideGains> StrideLearning::learn(const pdr::Displacement& stretch) {
  const auto within = [&](const Place& place) {
    return place.time >= stretch.begin && place.time <= stretch.end;
  };
  const auto first = std::ranges::find_if(places_, within);
  const auto last = std::find_if(places_.rbegin(), places_.rend(), within);
  if (first == places_.end() || last == places_.rend()) return std::nullopt;
  if (first->floor != last->floor) return std::nullopt;

  std::size_t count = 0;
  core::Vector2 way_m = core::Vector2::Zero();
  for (const observation::MotionDelta& step : steps_) {
    if (step.end <= first->time || step.end > last->time || step.stride.swing_root <= 0.0) continue;
    calibrator_.add(step.stride);
    way_m += step.length_m * core::Vector2(std::cos(step.heading_rad), std::sin(step.heading_rad));
    ++count;
  }
  constexpr std::size_t kFewestSteps = 8;  // Over fewer, scans tell nothing.
  if (count < kFewestSteps || !(way_m.norm() > 0.0)) {
    calibrator_.drop_segment();
    return std::nullopt;
  }
  const double turn_rad = site_->floor(first->floor).heading_offset_rad;
  const core::Vector2 along = Eigen::Rotation2Dd(turn_rad) * way_m.normalized();
  const double distance_m = (last->position_m - first->position_m).dot(along);
  const double variance_m2 = along.dot((first->covariance_m2 + last->covariance_m2) * along);
  // A stretch along which the scans went backwards is not told by them.
  if (!(distance_m > 0.0) || !calibrator_.observe(distance_m, std::sqrt(variance_m2))) {
    calibrator_.drop_segment();
    return std::nullopt;
  }
  return calibrator_.gains();
}

}  // namespace waylode::pipeline
