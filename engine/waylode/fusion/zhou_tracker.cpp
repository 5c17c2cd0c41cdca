// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/zhou_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {
namespace {

/// The constant-velocity filter runs on no longer than a step lasts: who walks on takes steps.
constexpr double kCoast_s = 1.0;

void walk_on(PlanarEstimate& place, const observation::MotionDelta& motion) {
  const double across_m = motion.length_m * motion.heading_sigma_rad;
  place.time = std::max(place.time, motion.end);
  place.position_m += displacement_m(motion);
  place.covariance_m2 += (motion.length_sigma_m * motion.length_sigma_m + across_m * across_m) *
                         core::Matrix2::Identity();
}

PolarVelocity sensed_velocity(const observation::MotionDelta& motion) {
  const double dt_s = core::to_seconds(motion.end - motion.begin);
  return {dt_s > 0.0 ? motion.length_m / dt_s : 0.0, motion.heading_rad};
}

}  // namespace

StepPositionFilter::Options ZhouTracker::Options::filter_defaults() {
  StepPositionFilter::Options options;
  // A compass that starts beside steel is off by more than the hold of the phone.
  options.heading_offset_sigma_rad = 0.3;
  options.heading_offset_walk_rad_per_sqrt_step = 0.03;
  options.position_walk_m_per_sqrt_s = 0.5;
  options.radio_bias_sigma_m = 0.0;
  options.radio_sigma_scale = 1.0;
  // Late scans, the bearer's body and drift err together: neighbours do not show it.
  options.radio_floor_sigma_m = 2.5;
  options.gate = 4.0;
  options.lost_failures = 3;
  options.lost_window = 5;
  options.lost_gate = 9.21;
  return options;
}

core::Result<void> ZhouTracker::Options::validate() const {
  constexpr int kMostScans = 1000;
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const bool sound =
      start_scans >= 1 && start_scans <= kMostScans && std::isfinite(start_within_s) &&
      start_within_s >= 0.0 && correction_ratio > 0.0 && correction_ratio <= 1.0 &&
      is_positive(fused_velocity_s) && is_positive(magnetic_sigma_scale) &&
      std::isfinite(magnetic_floor_sigma_m) && magnetic_floor_sigma_m >= 0.0 && magnetic_gate > 0.0;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "start_scans must be 1 to 1000, correction_ratio above 0 and at most 1, the "
                      "gate, spans and sigma scale positive, the others not negative",
                      "zhou_tracker");
  }
  if (const auto valid = weighting.validate(); !valid) return valid;
  if (const auto valid = blend.validate(); !valid) return valid;
  if (const auto valid = velocity_filter.validate(); !valid) return valid;
  return filter.validate();
}

ZhouTracker::ZhouTracker(const Options& options)
    : options_(options),
      main_(options.filter),
      reference_(options.filter),
      velocity_filter_(options.velocity_filter) {}

void ZhouTracker::start(const PlanarEstimate& place) {
  begin(place);
  start_count_ = options_.start_scans;
  path_.clear();
}

void ZhouTracker::begin(const PlanarEstimate& place) {
  started_at_ = last_radio_ = last_magnetic_ = place.time;
  main_.start(place);
  reference_.start(place);
  velocity_filter_.start(place);
  blended_ = place;
  velocity_ = {};
  wifi_.reset();
  magnetic_.reset();
  weighted_point_.reset();
  weighted_points_.clear();
}

bool ZhouTracker::add(const observation::MotionDelta& motion) {
  if (!started() || !main_.add(motion)) return false;
  reference_.add(motion);
  path_.add(motion);
  walk_on(start_mean_, motion);
  if (wifi_) walk_on(*wifi_, motion);
  if (magnetic_) walk_on(*magnetic_, motion);
  blend_step(motion);
  return true;
}

bool ZhouTracker::add_radio(const PlanarMeasurement& measurement) {
  if (!detail::is_sound(measurement)) return false;
  if (started() && measurement.delivered < last_radio_) return false;
  if (begins_with(measurement)) return true;
  last_radio_ = measurement.delivered;
  const int losses = main_.losses();
  reference_.add(measurement);
  main_.add(measurement);
  if (main_.losses() > losses) main_ = reference_;
  wifi_ = PlanarEstimate{measurement.delivered,
                         measurement.position_m - path_.offset_m(measurement.measured),
                         measurement.covariance_m2};
  correct_blend(measurement.delivered);
  return true;
}

/// The first scans are averaged; their errors persist, so that the covariance stays that of one.
bool ZhouTracker::begins_with(const PlanarMeasurement& measurement) {
  if (!started()) {
    start_mean_ = {measurement.delivered, measurement.position_m, measurement.covariance_m2};
    begin(start_mean_);
    start_count_ = 1;
    wifi_ = start_mean_;
    return true;
  }
  const double since_s = core::to_seconds(measurement.delivered - started_at_);
  if (start_count_ >= options_.start_scans || since_s > options_.start_within_s) return false;
  last_radio_ = measurement.delivered;
  ++start_count_;
  const double share = 1.0 / start_count_;
  const core::Vector2 place_m = measurement.position_m - path_.offset_m(measurement.measured);
  start_mean_.position_m += share * (place_m - start_mean_.position_m);
  start_mean_.covariance_m2 += share * (measurement.covariance_m2 - start_mean_.covariance_m2);
  start_mean_.time = measurement.delivered;
  main_.move_to(start_mean_);
  reference_.move_to(start_mean_);
  velocity_filter_.start(start_mean_);
  blended_ = start_mean_;
  wifi_ = start_mean_;
  return true;
}

bool ZhouTracker::add_magnetic(const PlanarEstimate& place) {
  if (!started() || !detail::is_sound(place) || place.time < last_magnetic_) return false;
  last_magnetic_ = place.time;
  PlanarMeasurement measurement{place.time, std::max(place.time, last_radio_), place.position_m,
                                place.covariance_m2};
  measurement.covariance_m2 *= std::pow(options_.magnetic_sigma_scale, 2);
  measurement.covariance_m2 +=
      std::pow(options_.magnetic_floor_sigma_m, 2) * core::Matrix2::Identity();
  magnetic_.reset();
  if (contradicts_wifi(measurement)) return false;
  magnetic_ = place;
  magnetic_->position_m -= path_.offset_m(place.time);
  correct_blend(place.time);
  return main_.add_unbiased(measurement).has_value();
}

bool ZhouTracker::contradicts_wifi(const PlanarMeasurement& magnetic) const {
  const core::Vector2 expected_m =
      reference_.filter().mean().head<2>() + reference_.walked_offset_m(magnetic.measured);
  const core::Matrix2 expected_m2 =
      reference_.at(std::max(magnetic.delivered, reference_.time())).covariance_m2;
  return core::squared_mahalanobis(magnetic.position_m - expected_m,
                                   expected_m2 + magnetic.covariance_m2) > options_.magnetic_gate;
}

// [Zhou2016] eqs. (14) to (17).
void ZhouTracker::blend_step(const observation::MotionDelta& motion) {
  const PolarVelocity sensed = sensed_velocity(motion);
  if (velocity_.speed_mps == 0.0) velocity_ = sensed;
  velocity_ = options_.robust_filter
                  ? sensed
                  : VelocityBlend(options_.blend).blend(velocity_, fused_velocity(), sensed);
  const core::Vector2 before_m = blended_.position_m;
  walk_on(blended_, motion);
  blended_.position_m = moved_m(before_m, velocity_, motion.end - motion.begin);
  velocity_filter_.add(blended_);
}

PolarVelocity ZhouTracker::fused_velocity() const {
  if (weighted_points_.size() < 2) return velocity_;
  const PlanarEstimate& first = weighted_points_.front();
  const PlanarEstimate& last = weighted_points_.back();
  const double dt_s = core::to_seconds(last.time - first.time);
  if (dt_s <= 0.0) return velocity_;
  const core::Vector2 way_m = last.position_m - first.position_m;
  return {way_m.norm() / dt_s, std::atan2(way_m.y(), way_m.x())};
}

/// The weighted point of the newest Wi-Fi and magnetic position, both walked on, pulls the track.
void ZhouTracker::correct_blend(core::DeviceTime time) {
  const auto& only = wifi_ ? wifi_ : magnetic_;
  weighted_point_ =
      wifi_ && magnetic_
          ? IntervalWeighting(options_.weighting).combine(time - started_at_, *magnetic_, *wifi_)
          : *only;
  weighted_point_->time = time;
  weighted_points_.push_back(*weighted_point_);
  const core::DeviceTime oldest = time - core::from_seconds(options_.fused_velocity_s);
  while (weighted_points_.front().time < oldest) weighted_points_.pop_front();

  const double share = options_.correction_ratio;
  const double rest = 1.0 - share;
  blended_.time = std::max(blended_.time, time);
  blended_.position_m += share * (weighted_point_->position_m - blended_.position_m);
  blended_.covariance_m2 =
      rest * rest * blended_.covariance_m2 + share * share * weighted_point_->covariance_m2;
  PlanarEstimate now = blended_;
  now.position_m += path_.offset_m(now.time);
  velocity_filter_.add(now);
}

PlanarEstimate ZhouTracker::at(core::DeviceTime time) const {
  WAYLODE_ASSERT(started());
  if (options_.robust_filter) return main_.at(time);
  const core::DeviceTime newest = options_.filter_blend ? velocity_filter_.time() : blended_.time;
  const core::DeviceTime coasted = std::min(time, newest + core::from_seconds(kCoast_s));
  PlanarEstimate result = options_.filter_blend ? velocity_filter_.at(coasted) : blended_;
  if (!options_.filter_blend) result.position_m += path_.offset_m(time);
  result.time = time;
  const double waited_s = std::max(0.0, core::to_seconds(time - newest));
  result.covariance_m2 += std::pow(options_.filter.position_walk_m_per_sqrt_s, 2) * waited_s *
                          core::Matrix2::Identity();
  return result;
}

}  // namespace waylode::fusion
