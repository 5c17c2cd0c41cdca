// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdint>

#include "waylode/core/rng.hpp"
#include "waylode/fusion/planar_tracker.hpp"

/// The planar tracker's model written a second time, plainly, for tests: functions to compare
/// with, and walks drawn from it.
namespace waylode::fusion::testing {

inline core::DeviceTime at_s(double seconds) { return core::device_time_from_seconds(seconds); }

/// Every option is set here, so that no test hangs on a default. Radio errors are Gaussian for all
/// practical purposes, nobody is ever lost.
inline PlanarTracker::Options gaussian_options() {
  PlanarTracker::Options options;
  options.start_sigma_m = 20.0;
  options.heading_offset_sigma_rad = 0.1;
  options.log_scale_sigma = 0.05;
  options.heading_offset_walk_rad_per_sqrt_step = 0.01;
  options.log_scale_walk_per_sqrt_step = 0.003;
  options.position_walk_m_per_sqrt_s = 0.2;
  options.radio_bias_sigma_m = 3.0;
  options.radio_bias_tau_s = 15.0;
  options.radio_sigma_scale = 1.0;
  options.radio_degrees_of_freedom = 1e15;
  options.lost_weight_ratio = 0.0;
  options.lost_sigma_m = 15.0;
  return options;
}

/// The same with doubt: scans far off are mistrusted, many of them in a row mean "lost".
inline PlanarTracker::Options robust_options() {
  PlanarTracker::Options options = gaussian_options();
  options.radio_degrees_of_freedom = 4.0;
  options.lost_weight_ratio = 0.25;
  return options;
}

inline core::Matrix2 rotation(double angle_rad) {
  core::Matrix2 matrix;
  matrix << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  return matrix;
}

inline observation::MotionDelta step_of(double begin_s, double end_s, double length_m,
                                        double heading_rad, double length_sigma_m = 0.05,
                                        double heading_sigma_rad = 0.04) {
  return {at_s(begin_s), at_s(end_s), length_m, heading_rad, length_sigma_m, heading_sigma_rad};
}

inline PlanarMeasurement scan_of(double delivered_s, const core::Vector2& position_m,
                                 double sigma_m, double delay_s = 0.0) {
  return {at_s(delivered_s - delay_s), at_s(delivered_s), position_m,
          sigma_m * sigma_m * core::Matrix2::Identity()};
}

/// Displacement `pdr_m` turned and scaled by the state.
inline core::Vector2 walked(const core::Vector2& pdr_m, const PlanarVector& state) {
  return std::exp(state(3)) * rotation(state(2)) * pdr_m;
}

/// Where a step takes the state; `bias_kept` is the share of the radio bias that survives it.
inline PlanarVector moved(const PlanarVector& state, const core::Vector2& pdr_m, double bias_kept) {
  PlanarVector result = state;
  result.head<2>() += walked(pdr_m, state);
  result.tail<2>() *= bias_kept;
  return result;
}

/// What a scan reads that tells of `pdr_since_m` ago.
inline core::Vector2 scanned(const PlanarVector& state, const core::Vector2& pdr_since_m) {
  return state.head<2>() - walked(pdr_since_m, state) + state.tail<2>();
}

/// Central differences of `function` around `at`.
template <int kRows, typename Function>
Eigen::Matrix<double, kRows, 6> numeric_jacobian(const Function& function, const PlanarVector& at) {
  constexpr double kStep = 1e-5;
  Eigen::Matrix<double, kRows, 6> jacobian;
  for (int i = 0; i < 6; ++i) {
    const PlanarVector nudge = kStep * PlanarVector::Unit(i);
    jacobian.col(i) = (function(at + nudge) - function(at - nudge)) / (2.0 * kStep);
  }
  return jacobian;
}

/// A walk drawn from the model: start, heading offset, scale and bias at random, every step and
/// scan with the noise the tracker assumes. Steps last 0.5 s; the way is a square of 12 m.
class ModelWalk {
 public:
  static constexpr double kStep_s = 0.5;

  ModelWalk(const PlanarTracker::Options& options, std::uint64_t seed)
      : options_(options), rng_(seed) {
    truth_ << normal(options.start_sigma_m), normal(options.start_sigma_m),
        normal(options.heading_offset_sigma_rad), normal(options.log_scale_sigma),
        normal(options.radio_bias_sigma_m), normal(options.radio_bias_sigma_m);
    scan_noise_m2_ << 9.0, 3.0, 3.0, 16.0;
  }

  /// Takes a step and tells what the phone made of it.
  observation::MotionDelta step() {
    const double heading_rad = 0.4 + 0.5 * std::acos(-1.0) * static_cast<double>(count_ / 16 % 4);
    const observation::MotionDelta told =
        step_of(now_s(), now_s() + kStep_s, 0.75, heading_rad, 0.06, 0.05);
    ++count_;
    const core::Vector2 pdr_m = rotation(heading_rad) * core::Vector2(told.length_m, 0.0);
    const core::Vector2 way_m = walked(pdr_m, truth_);
    const core::Vector2 along = way_m.normalized();
    const core::Vector2 across(-along.y(), along.x());
    const double kept = std::exp(-kStep_s / options_.radio_bias_tau_s);
    const double walk_m = options_.position_walk_m_per_sqrt_s * std::sqrt(kStep_s);
    const double bias_m = options_.radio_bias_sigma_m * std::sqrt(1.0 - kept * kept);
    truth_ = moved(truth_, pdr_m, kept);
    truth_.head<2>() += normal(told.length_sigma_m) * along +
                        normal(told.heading_sigma_rad * way_m.norm()) * across +
                        core::Vector2(normal(walk_m), normal(walk_m));
    truth_(2) += normal(options_.heading_offset_walk_rad_per_sqrt_step);
    truth_(3) += normal(options_.log_scale_walk_per_sqrt_step);
    truth_.tail<2>() += core::Vector2(normal(bias_m), normal(bias_m));
    return told;
  }

  /// A scan of this instant.
  PlanarMeasurement scan() {
    const core::Matrix2 root = scan_noise_m2_.llt().matrixL();
    const core::Vector2 noise_m = root * core::Vector2(rng_.normal(), rng_.normal());
    return {at_s(now_s()), at_s(now_s()), scanned(truth_, core::Vector2::Zero()) + noise_m,
            scan_noise_m2_};
  }

  double now_s() const { return kStep_s * static_cast<double>(count_); }
  const PlanarVector& truth() const { return truth_; }

 private:
  double normal(double sigma) { return rng_.normal(0.0, sigma); }

  PlanarTracker::Options options_;
  core::Rng rng_;
  core::Matrix2 scan_noise_m2_;
  PlanarVector truth_;
  int count_ = 0;
};

}  // namespace waylode::fusion::testing
