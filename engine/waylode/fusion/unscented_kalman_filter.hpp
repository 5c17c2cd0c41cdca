// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/sigma_points.hpp"

namespace waylode::fusion {

/// What an update found.
struct UnscentedUpdate {
  double normalized_innovation_squared = 0.0;  ///< As measured, before any inflation.
  double noise_inflation = 1.0;                ///< Factor that R was given; 1 within the gate.
};

/// An unscented Kalman filter with additive noise [Wu2019] eqs. (15)-(20), sigma points redrawn
/// before each update. Every function that is passed in is pure. Components that are angles need
/// residual functions that wrap; the default residual is the plain difference.
///
/// Deviations from the central point are summed, not deviations from the mean: algebraically the
/// same, but free of the cancellation that a small alpha brings, and never indefinite.
template <int States>
class UnscentedKalmanFilter {
 public:
  using State = Eigen::Matrix<double, States, 1>;
  using Covariance = Eigen::Matrix<double, States, States>;
  template <int Rows>
  using Measurement = Eigen::Matrix<double, Rows, 1>;
  template <int Rows>
  using Noise = Eigen::Matrix<double, Rows, Rows>;

  /// `spread` is valid for States; the mean is finite, the covariance symmetric positive definite.
  UnscentedKalmanFilter(const SigmaSpread& spread, const State& mean, const Covariance& covariance)
      : spread_(spread), mean_(mean), covariance_(covariance) {
    WAYLODE_ASSERT(spread.validate(States).has_value() && is_usable(mean, covariance));
  }

  const State& mean() const { return mean_; }
  const Covariance& covariance() const { return covariance_; }

  /// Moves the state by `transition` (State to State) and adds `noise`, symmetric and positive
  /// semidefinite. False, and nothing changes, when the outcome would not be usable.
  template <typename Transition, typename Residual = std::minus<State>>
  bool predict(const Transition& transition, const Covariance& noise,
               const Residual& residual = {}) {
    const Transformed<States> moved = transform<States>(transition, residual);
    const Covariance covariance = symmetrised<States>(moved.covariance + noise);
    if (!is_usable(moved.mean, covariance)) return false;
    mean_ = moved.mean;
    covariance_ = covariance;
    return true;
  }

  /// Corrects by `measured`, which is `model` (State to Measurement) of the state plus noise of
  /// covariance `noise`, positive definite. Beyond `gate`, the chi-square of the innovation that is
  /// still believed, the noise is inflated by their quotient. nullopt, and nothing changes, when
  /// the measurement is not finite or the outcome would not be usable.
  template <int Rows, typename Model, typename Residual = std::minus<Measurement<Rows>>>
  std::optional<UnscentedUpdate> update(const Measurement<Rows>& measured, const Model& model,
                                        const Noise<Rows>& noise,
                                        double gate = std::numeric_limits<double>::infinity(),
                                        const Residual& residual = {}) {
    if (!measured.allFinite() || !noise.allFinite()) return std::nullopt;
    const Transformed<Rows> expected = transform<Rows>(model, residual);
    const Measurement<Rows> innovation = residual(measured, expected.mean);
    Noise<Rows> innovation_covariance = symmetrised<Rows>(expected.covariance + noise);
    UnscentedUpdate result;
    result.normalized_innovation_squared =
        innovation.dot(innovation_covariance.ldlt().solve(innovation));
    if (result.normalized_innovation_squared > gate) {
      result.noise_inflation = result.normalized_innovation_squared / gate;
      innovation_covariance += (result.noise_inflation - 1.0) * noise;
    }
    const Eigen::Matrix<double, Rows, States> gain_transposed = innovation_covariance.ldlt().solve(
        Eigen::Matrix<double, Rows, States>(expected.cross_covariance.transpose()));
    const Eigen::Matrix<double, States, Rows> gain = gain_transposed.transpose();
    const State mean = mean_ + gain * innovation;
    Covariance covariance =
        symmetrised<States>(covariance_ - gain * innovation_covariance * gain.transpose());
    // Rounding can leave a hair below zero where the measurement is far sharper than the state.
    if (covariance.llt().info() != Eigen::Success) {
      covariance.diagonal() += kRounding * covariance_.diagonal();
    }
    if (!is_usable(mean, covariance)) return std::nullopt;
    mean_ = mean;
    covariance_ = covariance;
    return result;
  }

 private:
  static constexpr double kRounding = 1e-12;

  /// A Gaussian through a function.
  template <int Rows>
  struct Transformed {
    Measurement<Rows> mean;
    Noise<Rows> covariance;
    Eigen::Matrix<double, States, Rows> cross_covariance;
  };

  template <int Rows>
  static Noise<Rows> symmetrised(const Noise<Rows>& matrix) {
    return 0.5 * (matrix + matrix.transpose());
  }

  static bool is_usable(const State& mean, const Covariance& covariance) {
    return mean.allFinite() && covariance.allFinite() && covariance.llt().info() == Eigen::Success;
  }

  template <int Rows, typename Function, typename Residual>
  Transformed<Rows> transform(const Function& function, const Residual& residual) const {
    const SigmaWeights weights = sigma_weights(spread_, States);
    const Covariance root =
        std::sqrt(0.5 / weights.other) * Covariance(covariance_.llt().matrixL());
    const Measurement<Rows> central = function(mean_);
    Transformed<Rows> result;
    result.mean.setZero();
    result.covariance.setZero();
    result.cross_covariance.setZero();
    for (int i = 0; i < States; ++i) {
      const State offset = root.col(i);
      const Measurement<Rows> above = residual(function(State(mean_ + offset)), central);
      const Measurement<Rows> below = residual(function(State(mean_ - offset)), central);
      result.mean += weights.other * (above + below);
      result.covariance += weights.other * (above * above.transpose() + below * below.transpose());
      result.cross_covariance += weights.other * offset * (above - below).transpose();
    }
    // sum Wc (y_i - mean)(y_i - mean)^T = sum_(i>0) W (y_i - y_0)(y_i - y_0)^T + (beta - alpha^2)
    // (mean - y_0)(mean - y_0)^T, since the mean weights sum to one.
    result.covariance +=
        (spread_.beta - spread_.alpha * spread_.alpha) * result.mean * result.mean.transpose();
    result.mean += central;
    return result;
  }

  SigmaSpread spread_;
  State mean_;
  Covariance covariance_;
};

}  // namespace waylode::fusion
