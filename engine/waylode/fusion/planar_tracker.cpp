// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/planar_tracker.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::fusion {
namespace {

constexpr int kHeading = 2;
constexpr int kLogScale = 3;
constexpr int kBias = 4;

using MeasurementMatrix = Eigen::Matrix<double, 2, 6>;

core::Vector2 direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

core::Vector2 turned_left(const core::Vector2& vector) { return {-vector.y(), vector.x()}; }

/// A PDR displacement as the state sees it: turned by the heading offset, scaled.
core::Vector2 as_walked(const core::Vector2& pdr_m, const PlanarVector& state) {
  const double scale = std::exp(state(kLogScale));
  const core::Vector2 axis = direction(state(kHeading));
  return scale * (pdr_m.x() * axis + pdr_m.y() * turned_left(axis));
}

PlanarMatrix symmetrised(const PlanarMatrix& matrix) { return 0.5 * (matrix + matrix.transpose()); }

/// How a scan depends on the state: it tells of where the phone was when the signals were in the
/// air.
struct LinearisedScan {
  MeasurementMatrix model = MeasurementMatrix::Zero();
  core::Vector2 innovation_m;
};

LinearisedScan linearise(const PlanarMeasurement& measurement, const core::Vector2& pdr_since_m,
                         const PlanarVector& mean) {
  const core::Vector2 since_m = as_walked(pdr_since_m, mean);
  LinearisedScan scan;
  scan.model.leftCols<2>().setIdentity();
  scan.model.col(kHeading) = -turned_left(since_m);
  scan.model.col(kLogScale) = -since_m;
  scan.model.middleCols<2>(kBias).setIdentity();
  scan.innovation_m = measurement.position_m - (mean.head<2>() - since_m) - mean.segment<2>(kBias);
  return scan;
}

/// The Student-t weight from E[r^T R^-1 r], the residual's expectation under the posterior
/// [Lange1989].
double student_weight(const core::Vector2& residual_m, const core::Matrix2& state_part_m2,
                      const core::Matrix2& noise_m2, double degrees_of_freedom) {
  const Eigen::LDLT<core::Matrix2> solver(noise_m2);
  const double square =
      residual_m.dot(solver.solve(residual_m)) + solver.solve(state_part_m2).trace();
  return (degrees_of_freedom + 2.0) / (degrees_of_freedom + square);
}

}  // namespace

core::Result<void> PlanarTracker::Options::validate() const {
  const bool sound = start_sigma_m > 0.0 && heading_offset_sigma_rad > 0.0 &&
                     log_scale_sigma > 0.0 && heading_offset_walk_rad_per_sqrt_step >= 0.0 &&
                     log_scale_walk_per_sqrt_step >= 0.0 && position_walk_m_per_sqrt_s > 0.0 &&
                     radio_bias_sigma_m > 0.0 && radio_bias_tau_s > 0.0 &&
                     radio_sigma_scale > 0.0 && radio_degrees_of_freedom > 0.0 &&
                     lost_weight_ratio >= 0.0 && lost_weight_ratio < 1.0 && lost_sigma_m >= 0.0;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "sigmas, scales and times must be positive, lost_weight_ratio below 1",
                      "planar_tracker");
  }
  return {};
}

double measurement_weight(const PlanarRecord& record, const PlanarVector& mean,
                          const PlanarMatrix& covariance, double radio_sigma_scale,
                          double degrees_of_freedom) {
  const LinearisedScan scan = linearise(record.measurement, record.pdr_since_m, mean);
  return student_weight(scan.innovation_m, scan.model * covariance * scan.model.transpose(),
                        radio_sigma_scale * radio_sigma_scale * record.measurement.covariance_m2,
                        degrees_of_freedom);
}

PlanarTracker::PlanarTracker(const Options& options, bool keep_history)
    : options_(options), keep_history_(keep_history) {}

void PlanarTracker::start(core::DeviceTime time, const core::Vector2& position_m, double sigma_m) {
  state_.time = time;
  state_.mean.setZero();
  state_.mean.head<2>() = position_m;
  PlanarVector variance;
  variance << sigma_m * sigma_m, sigma_m * sigma_m, std::pow(options_.heading_offset_sigma_rad, 2),
      std::pow(options_.log_scale_sigma, 2), std::pow(options_.radio_bias_sigma_m, 2),
      std::pow(options_.radio_bias_sigma_m, 2);
  state_.covariance = variance.asDiagonal();
  path_ = {{time, core::Vector2::Zero()}};
  last_motion_.reset();
  mean_weight_ = 1.0;
  started_ = true;
}

void PlanarTracker::add(const observation::MotionDelta& motion) {
  if (!started_) return;
  const core::Vector2 pdr_m = motion.length_m * direction(motion.heading_rad);
  const core::Vector2 walked_m = as_walked(pdr_m, state_.mean);

  PlanarMatrix transition = PlanarMatrix::Identity();
  transition.block<2, 1>(0, kHeading) = turned_left(walked_m);
  transition.block<2, 1>(0, kLogScale) = walked_m;

  PlanarMatrix noise = PlanarMatrix::Zero();
  const core::Vector2 along = walked_m.normalized();
  const core::Vector2 across = turned_left(along);
  const double across_sigma_m = walked_m.norm() * motion.heading_sigma_rad;
  noise.topLeftCorner<2, 2>() =
      motion.length_sigma_m * motion.length_sigma_m * along * along.transpose() +
      across_sigma_m * across_sigma_m * across * across.transpose();
  noise(kHeading, kHeading) = std::pow(options_.heading_offset_walk_rad_per_sqrt_step, 2);
  noise(kLogScale, kLogScale) = std::pow(options_.log_scale_walk_per_sqrt_step, 2);

  PlanarVector moved = PlanarVector::Zero();
  moved.head<2>() = walked_m;
  let_time_pass(motion.end, transition, noise, moved);

  if (path_.back().time < motion.begin) path_.push_back({motion.begin, path_.back().path_m});
  path_.push_back({std::max(path_.back().time, motion.end), path_.back().path_m + pdr_m});
  constexpr double kPathMemory_s = 30.0;
  while (path_.front().time < motion.end - core::from_seconds(kPathMemory_s)) path_.pop_front();
  last_motion_ = motion;
}

double PlanarTracker::add(const PlanarMeasurement& measurement, std::optional<double> weight) {
  if (!started_) start(measurement.delivered, measurement.position_m, options_.start_sigma_m);
  let_time_pass(measurement.delivered, PlanarMatrix::Identity(), PlanarMatrix::Zero(),
                PlanarVector::Zero());

  const core::Vector2 pdr_since_m = path_.back().path_m - path_at(measurement.measured);
  if (keep_history_) records_.push_back({measurement, pdr_since_m, history_.size()});
  const auto [model, innovation_m] = linearise(measurement, pdr_since_m, state_.mean);
  const core::Matrix2 noise_m2 =
      options_.radio_sigma_scale * options_.radio_sigma_scale * measurement.covariance_m2;

  // Variational Student-t update: the weight and the posterior in turn.
  constexpr int kRounds = 5;
  double used_weight = weight.value_or(1.0);
  Eigen::Matrix<double, 6, 2> gain;
  for (int round = 0; round < kRounds; ++round) {
    const core::Matrix2 innovation_m2 =
        model * state_.covariance * model.transpose() + noise_m2 / used_weight;
    gain = innovation_m2.ldlt().solve(model * state_.covariance).transpose();
    if (weight) break;
    const core::Vector2 residual_m = innovation_m - model * (gain * innovation_m);
    const core::Matrix2 state_part_m2 =
        model * (state_.covariance - gain * model * state_.covariance) * model.transpose();
    used_weight =
        student_weight(residual_m, state_part_m2, noise_m2, options_.radio_degrees_of_freedom);
  }

  // Joseph's form keeps the covariance positive definite.
  const PlanarMatrix keep = PlanarMatrix::Identity() - gain * model;
  state_.mean += gain * innovation_m;
  state_.covariance = symmetrised(keep * state_.covariance * keep.transpose() +
                                  gain * (noise_m2 / used_weight) * gain.transpose());
  if (!weight) watch_for_loss(used_weight);
  return used_weight;
}

PlanarState PlanarTracker::at(core::DeviceTime time) const {
  PlanarState result = state_;
  result.time = time;
  const double waited_s = std::max(0.0, core::to_seconds(time - state_.time));
  result.covariance.topLeftCorner<2, 2>() +=
      std::pow(options_.position_walk_m_per_sqrt_s, 2) * waited_s * core::Matrix2::Identity();
  if (!last_motion_) return result;
  // A step is known only after its peak; until the next one is due the walker goes on as before.
  const double step_s = core::to_seconds(last_motion_->end - last_motion_->begin);
  const double since_s = core::to_seconds(time - last_motion_->end);
  if (since_s <= 0.0 || since_s > 2.0 * step_s) return result;
  const core::Vector2 step_m =
      as_walked(last_motion_->length_m * direction(last_motion_->heading_rad), state_.mean);
  result.mean.head<2>() += std::min(1.0, since_s / step_s) * step_m;
  return result;
}

void PlanarTracker::forget_before(core::DeviceTime time) {
  while (!history_.empty() && history_.front().predicted.time < time) history_.pop_front();
}

void PlanarTracker::let_time_pass(core::DeviceTime time, PlanarMatrix transition,
                                  PlanarMatrix noise, const PlanarVector& moved) {
  const core::DeviceTime reached = std::max(state_.time, time);
  const double dt_s = core::to_seconds(reached - state_.time);
  const double kept = std::exp(-dt_s / options_.radio_bias_tau_s);
  transition(kBias, kBias) = transition(kBias + 1, kBias + 1) = kept;
  const double bias_m2 = std::pow(options_.radio_bias_sigma_m, 2) * (1.0 - kept * kept);
  noise(kBias, kBias) = noise(kBias + 1, kBias + 1) = bias_m2;
  noise.topLeftCorner<2, 2>() +=
      std::pow(options_.position_walk_m_per_sqrt_s, 2) * dt_s * core::Matrix2::Identity();

  PlanarState predicted;
  predicted.time = reached;
  predicted.mean = state_.mean + moved;
  predicted.mean.segment<2>(kBias) *= kept;
  predicted.covariance =
      symmetrised(transition * state_.covariance * transition.transpose() + noise);
  if (keep_history_) history_.push_back({state_, transition, predicted});
  state_ = predicted;
}

core::Vector2 PlanarTracker::path_at(core::DeviceTime time) const {
  if (time >= path_.back().time) return path_.back().path_m;
  const auto after = std::ranges::lower_bound(path_, time, {}, &PathPoint::time);
  if (after == path_.begin()) return path_.front().path_m;
  const auto before = std::prev(after);
  const double span_s = core::to_seconds(after->time - before->time);
  const double share = span_s > 0.0 ? core::to_seconds(time - before->time) / span_s : 1.0;
  return before->path_m + share * (after->path_m - before->path_m);
}

void PlanarTracker::watch_for_loss(double weight) {
  constexpr double kNewest = 0.2;  // Share of the newest scan: about five scans of memory.
  mean_weight_ += kNewest * (std::min(1.0, weight) - mean_weight_);
  if (mean_weight_ >= options_.lost_weight_ratio) return;
  mean_weight_ = 1.0;
  PlanarMatrix noise = PlanarMatrix::Zero();
  noise.topLeftCorner<2, 2>() =
      options_.lost_sigma_m * options_.lost_sigma_m * core::Matrix2::Identity();
  noise(kHeading, kHeading) = std::pow(options_.heading_offset_sigma_rad, 2);
  let_time_pass(state_.time, PlanarMatrix::Identity(), noise, PlanarVector::Zero());
}

}  // namespace waylode::fusion
