// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/constant_velocity_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {
namespace {

using State = ConstantVelocityFilter::State;
using Covariance = ConstantVelocityFilter::Covariance;

Covariance symmetrised(const Covariance& matrix) { return 0.5 * (matrix + matrix.transpose()); }

struct Gaussian {
  State mean;
  Covariance covariance;
};

// [Zhou2016] eqs. (20) and (21).
Gaussian predicted(const Gaussian& before, core::Duration by, double acceleration_m2ps4) {
  const double dt_s = std::max(0.0, core::to_seconds(by));
  const Covariance transition = constant_velocity_transition(dt_s);
  return {transition * before.mean,
          symmetrised(transition * before.covariance * transition.transpose() +
                      white_acceleration_noise(acceleration_m2ps4, dt_s))};
}

/// [Zhou2016] eqs. (22) to (24), the covariance in Joseph's form. Returns the chi-square.
template <int Rows>
double update(Gaussian& belief, const Eigen::Matrix<double, Rows, 4>& model,
              const Eigen::Matrix<double, Rows, 1>& measured,
              const Eigen::Matrix<double, Rows, Rows>& noise) {
  const Eigen::Matrix<double, Rows, 1> innovation = measured - model * belief.mean;
  const Eigen::LDLT<Eigen::Matrix<double, Rows, Rows>> innovation_covariance(
      model * belief.covariance * model.transpose() + noise);
  const Eigen::Matrix<double, 4, Rows> gain =
      innovation_covariance.solve(model * belief.covariance).transpose();
  const Covariance keep = Covariance::Identity() - gain * model;
  belief.mean += gain * innovation;
  belief.covariance =
      symmetrised(keep * belief.covariance * keep.transpose() + gain * noise * gain.transpose());
  return innovation.dot(innovation_covariance.solve(innovation));
}

}  // namespace

core::Result<void> ConstantVelocityFilter::Options::validate() const {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!is_positive(acceleration_variance_m2ps4) || !is_positive(start_speed_sigma_mps)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "variance and sigma must be positive",
                      "constant_velocity_filter");
  }
  return {};
}

void ConstantVelocityFilter::start(const PlanarEstimate& place) {
  WAYLODE_ASSERT(detail::is_sound(place));
  mean_ << place.position_m, core::Vector2::Zero();
  covariance_.setZero();
  covariance_.topLeftCorner<2, 2>() = place.covariance_m2;
  covariance_.bottomRightCorner<2, 2>() =
      std::pow(options_.start_speed_sigma_mps, 2) * core::Matrix2::Identity();
  time_ = place.time;
  started_ = true;
}

std::optional<double> ConstantVelocityFilter::add(const PlanarEstimate& place) {
  if (!started_ || place.time < time_ || !detail::is_sound(place)) return std::nullopt;
  const Eigen::Matrix<double, 2, 4> model = Eigen::Matrix<double, 2, 4>::Identity();
  Gaussian belief =
      predicted({mean_, covariance_}, place.time - time_, options_.acceleration_variance_m2ps4);
  const double chi_square = update<2>(belief, model, place.position_m, place.covariance_m2);
  accept(place.time, belief.mean, belief.covariance);
  return chi_square;
}

std::optional<double> ConstantVelocityFilter::add(core::DeviceTime time, const State& measured,
                                                  const Covariance& noise) {
  if (!started_ || time < time_ || !measured.allFinite() || !noise.allFinite() ||
      noise.llt().info() != Eigen::Success) {
    return std::nullopt;
  }
  Gaussian belief =
      predicted({mean_, covariance_}, time - time_, options_.acceleration_variance_m2ps4);
  const double chi_square = update<4>(belief, Covariance::Identity(), measured, noise);
  accept(time, belief.mean, belief.covariance);
  return chi_square;
}

void ConstantVelocityFilter::accept(core::DeviceTime time, const State& mean,
                                    const Covariance& covariance) {
  time_ = time;
  mean_ = mean;
  covariance_ = covariance;
}

PlanarEstimate ConstantVelocityFilter::at(core::DeviceTime time) const {
  WAYLODE_ASSERT(started_);
  const Gaussian belief =
      predicted({mean_, covariance_}, time - time_, options_.acceleration_variance_m2ps4);
  return {time, belief.mean.head<2>(), belief.covariance.topLeftCorner<2, 2>()};
}

// [Zhou2016] eq. (25).
Covariance constant_velocity_transition(double dt_s) {
  Covariance result = Covariance::Identity();
  result(0, 2) = result(1, 3) = dt_s;
  return result;
}

Covariance white_acceleration_noise(double variance_m2ps4, double dt_s) {
  Eigen::Matrix<double, 4, 2> effect;
  effect << 0.5 * dt_s * dt_s * core::Matrix2::Identity(), dt_s * core::Matrix2::Identity();
  return variance_m2ps4 * effect * effect.transpose();
}

}  // namespace waylode::fusion
