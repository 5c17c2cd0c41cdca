// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/fusion/planar_estimate.hpp"

namespace waylode::fusion {

/// A Kalman filter of place and velocity, pushed by white acceleration [Zhou2016] eqs. (18)-(26).
/// Measured are positions, or positions and velocities. The errors of measurements must not repeat
/// one another: behind a smoother the filter's covariance promises too much.
class ConstantVelocityFilter {
 public:
  using State = Eigen::Vector4d;  ///< x, y in m, their rates in m/s.
  using Covariance = Eigen::Matrix4d;
  struct Options {
    double acceleration_variance_m2ps4 = 0.5;  ///< Per axis, constant between measurements; > 0.
    double start_speed_sigma_mps = 1.0;        ///< Per axis, before anything is measured; > 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit ConstantVelocityFilter(const Options& options) : options_(options) {}

  /// Begins anew, velocity unknown. Position finite, covariance valid.
  void start(const PlanarEstimate& place);
  bool started() const { return started_; }

  /// The innovation's chi-square: two degrees of freedom for a position, four for both. nullopt,
  /// and nothing changes: nothing started, before the last event, not finite, covariance not
  /// positive definite.
  std::optional<double> add(const PlanarEstimate& place);
  std::optional<double> add(core::DeviceTime time, const State& measured, const Covariance& noise);

  /// Carried to `time` (not before the last event). Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  core::DeviceTime time() const { return time_; }
  const State& mean() const { return mean_; }
  const Covariance& covariance() const { return covariance_; }

 private:
  void accept(core::DeviceTime time, const State& mean, const Covariance& covariance);

  Options options_;
  bool started_ = false;
  core::DeviceTime time_;
  State mean_ = State::Zero();
  Covariance covariance_ = Covariance::Identity();
};

/// "A" of [Zhou2016] eq. (25).
ConstantVelocityFilter::Covariance constant_velocity_transition(double dt_s);
/// "Q": what an acceleration of this variance, constant over dt_s, adds.
ConstantVelocityFilter::Covariance white_acceleration_noise(double variance_m2ps4, double dt_s);

}  // namespace waylode::fusion
