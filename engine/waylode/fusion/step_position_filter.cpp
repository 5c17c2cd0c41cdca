// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/step_position_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {
namespace {

constexpr int kHeading = 2;
constexpr int kLogScale = 3;
constexpr int kBias = 4;
/// Options may say "exactly known"; a Cholesky factor needs a little doubt.
constexpr double kLeastSigma = 1e-6;

using State = StepPositionFilter::Filter::State;
using Covariance = StepPositionFilter::Filter::Covariance;

double variance_of(double sigma) { return std::pow(std::max(sigma, kLeastSigma), 2); }

core::Vector2 turned_left(const core::Vector2& vector) { return {-vector.y(), vector.x()}; }

/// A PDR displacement as the state sees it: turned by the heading offset, scaled.
core::Vector2 as_walked(const core::Vector2& pdr_m, const State& state) {
  const double cosine = std::cos(state(kHeading));
  const double sine = std::sin(state(kHeading));
  return std::exp(state(kLogScale)) * core::Vector2(cosine * pdr_m.x() - sine * pdr_m.y(),
                                                    sine * pdr_m.x() + cosine * pdr_m.y());
}

/// [Wu2019] eq. (5) as a transition, the radio bias decaying meanwhile.
State moved(const State& state, const core::Vector2& pdr_m, double bias_kept) {
  State result = state;
  result.head<2>() += as_walked(pdr_m, state);
  result.tail<2>() *= bias_kept;
  return result;
}

/// What a scan reads that was in the air when the walker was `pdr_m` from the state's place.
core::Vector2 expected_position_m(const State& state, const core::Vector2& pdr_m, bool biased) {
  const core::Vector2 place_m = state.head<2>() + as_walked(pdr_m, state);
  return biased ? core::Vector2(place_m + state.segment<2>(kBias)) : place_m;
}

/// What the steps' own sigmas add, along and across the way.
core::Matrix2 step_noise_m2(const observation::MotionDelta& motion, const core::Vector2& walked_m) {
  const double length_m = walked_m.norm();
  if (length_m <= 0.0) {
    return motion.length_sigma_m * motion.length_sigma_m * core::Matrix2::Identity();
  }
  const core::Vector2 along = walked_m / length_m;
  const core::Vector2 across = turned_left(along);
  const double across_sigma_m = length_m * motion.heading_sigma_rad;
  return motion.length_sigma_m * motion.length_sigma_m * along * along.transpose() +
         across_sigma_m * across_sigma_m * across * across.transpose();
}

/// What time alone adds; and how much of the bias survives it.
struct Passage {
  double bias_kept = 1.0;
  Covariance noise = Covariance::Zero();
};

Passage passage(double dt_s, const StepPositionFilter::Options& options) {
  Passage result;
  result.bias_kept = std::exp(-dt_s / options.radio_bias_tau_s);
  const double bias_m2 =
      variance_of(options.radio_bias_sigma_m) * (1.0 - result.bias_kept * result.bias_kept);
  result.noise(kBias, kBias) = result.noise(kBias + 1, kBias + 1) = bias_m2;
  result.noise.topLeftCorner<2, 2>() =
      std::pow(options.position_walk_m_per_sqrt_s, 2) * dt_s * core::Matrix2::Identity();
  return result;
}

StepPositionFilter::Filter carried(StepPositionFilter::Filter filter, core::Duration by,
                                   const StepPositionFilter::Options& options) {
  if (by <= core::Duration::zero()) return filter;
  const Passage time = passage(core::to_seconds(by), options);
  filter.predict(
      [&](const State& state) { return moved(state, core::Vector2::Zero(), time.bias_kept); },
      time.noise);
  return filter;
}

}  // namespace

core::Result<void> StepPositionFilter::Options::validate() const {
  const auto is_size = [](double value) { return std::isfinite(value) && value >= 0.0; };
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (const auto valid = spread.validate(kStates); !valid) return valid;
  const bool sound = is_size(heading_offset_sigma_rad) && is_size(log_scale_sigma) &&
                     is_size(heading_offset_walk_rad_per_sqrt_step) &&
                     is_size(log_scale_walk_per_sqrt_step) &&
                     is_positive(position_walk_m_per_sqrt_s) && is_size(radio_bias_sigma_m) &&
                     is_positive(radio_bias_tau_s) && is_positive(radio_sigma_scale) &&
                     is_size(radio_floor_sigma_m) && gate > 0.0;
  constexpr int kLongestWindow = 100;
  const bool loss_sound = lost_failures >= 0 && lost_window >= lost_failures &&
                          lost_window <= kLongestWindow && lost_gate > 0.0 &&
                          is_positive(lost_heading_sigma_rad);
  if (!sound || !loss_sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "sigmas must not be negative; position walk, bias time, sigma scale and gate "
                      "must be positive; lost_window at least lost_failures",
                      "step_position_filter");
  }
  return {};
}

StepPositionFilter::StepPositionFilter(const Options& options) : options_(options) {}

void StepPositionFilter::start(const PlanarEstimate& place) {
  begin(place, options_.heading_offset_sigma_rad);
  time_ = last_delivery_ = place.time;
  path_.clear();
}

void StepPositionFilter::begin(const PlanarEstimate& place, double heading_sigma_rad) {
  WAYLODE_ASSERT(detail::is_sound(place));
  State mean = State::Zero();
  mean.head<2>() = place.position_m;
  State variances;
  variances << 1.0, 1.0, variance_of(heading_sigma_rad), variance_of(options_.log_scale_sigma),
      variance_of(options_.radio_bias_sigma_m), variance_of(options_.radio_bias_sigma_m);
  Covariance covariance = variances.asDiagonal();
  covariance.topLeftCorner<2, 2>() = place.covariance_m2;
  filter_.emplace(options_.spread, mean, covariance);
  doubts_.clear();
}

void StepPositionFilter::move_to(const PlanarEstimate& place) {
  WAYLODE_ASSERT(detail::is_sound(place));
  if (!filter_) return start(place);
  State mean = filter_->mean();
  mean.head<2>() = place.position_m;
  Covariance covariance = Covariance::Zero();
  covariance.topLeftCorner<2, 2>() = place.covariance_m2;
  covariance.bottomRightCorner<4, 4>() = filter_->covariance().bottomRightCorner<4, 4>();
  filter_.emplace(options_.spread, mean, covariance);
  time_ = std::max(time_, place.time);
}

bool StepPositionFilter::add(const observation::MotionDelta& motion) {
  if (!filter_ || !detail::is_sound(motion) || !path_.is_in_order(motion.end)) return false;
  const core::DeviceTime reached = std::max(time_, motion.end);
  Passage time = passage(core::to_seconds(reached - time_), options_);
  const core::Vector2 pdr_m = displacement_m(motion);
  time.noise.topLeftCorner<2, 2>() += step_noise_m2(motion, as_walked(pdr_m, filter_->mean()));
  time.noise(kHeading, kHeading) = std::pow(options_.heading_offset_walk_rad_per_sqrt_step, 2);
  time.noise(kLogScale, kLogScale) = std::pow(options_.log_scale_walk_per_sqrt_step, 2);
  const bool used = filter_->predict(
      [&](const State& state) { return moved(state, pdr_m, time.bias_kept); }, time.noise);
  if (!used) return false;
  time_ = reached;
  path_.add(motion);
  return true;
}

std::optional<UnscentedUpdate> StepPositionFilter::add(const PlanarMeasurement& measurement) {
  return update(measurement, /*biased=*/true);
}

std::optional<UnscentedUpdate> StepPositionFilter::add_unbiased(
    const PlanarMeasurement& measurement) {
  return update(measurement, /*biased=*/false);
}

std::optional<UnscentedUpdate> StepPositionFilter::update(const PlanarMeasurement& measurement,
                                                          bool biased) {
  if (!detail::is_sound(measurement)) return std::nullopt;
  const core::Matrix2 noise = biased ? noise_m2(measurement) : measurement.covariance_m2;
  if (!filter_) {
    start({measurement.delivered, measurement.position_m, noise});
    return UnscentedUpdate{};
  }
  if (measurement.delivered < last_delivery_) return std::nullopt;
  Filter filter = carried(*filter_, measurement.delivered - time_, options_);
  const core::Vector2 offset_m = path_.offset_m(measurement.measured);
  const auto update = filter.update<2>(
      measurement.position_m,
      [&](const State& state) { return expected_position_m(state, offset_m, biased); }, noise,
      options_.gate);
  if (!update) return std::nullopt;
  filter_ = filter;
  last_delivery_ = measurement.delivered;
  time_ = std::max(time_, measurement.delivered);
  if (biased && is_lost(update->normalized_innovation_squared)) {
    // The heading was wrong, too: how far the way since leads is known, whereto is not.
    const core::Matrix2 offset_m2 = offset_m.squaredNorm() * core::Matrix2::Identity();
    begin({time_, measurement.position_m - offset_m, noise + offset_m2},
          options_.lost_heading_sigma_rad);
    ++losses_;
  }
  return update;
}

bool StepPositionFilter::is_lost(double chi_square) {
  if (options_.lost_failures == 0) return false;
  doubts_.push_back(chi_square > options_.lost_gate);
  if (doubts_.size() > static_cast<std::size_t>(options_.lost_window)) doubts_.pop_front();
  return std::ranges::count(doubts_, true) >= options_.lost_failures;
}

StepPositionFilter::Surprise StepPositionFilter::surprise(
    const PlanarMeasurement& measurement) const {
  WAYLODE_ASSERT(filter_ && detail::is_sound(measurement));
  const Filter filter = carried(*filter_, measurement.delivered - time_, options_);
  const core::Vector2 offset_m = path_.offset_m(measurement.measured);
  const core::Vector2 innovation_m =
      measurement.position_m - expected_position_m(filter.mean(), offset_m, true);
  // Of place and bias alone: the few steps since the scan add nothing that matters.
  Eigen::Matrix<double, 2, kStates> model = Eigen::Matrix<double, 2, kStates>::Zero();
  model.leftCols<2>().setIdentity();
  model.rightCols<2>().setIdentity();
  const core::Matrix2 innovation_m2 =
      model * filter.covariance() * model.transpose() + noise_m2(measurement);
  return {core::squared_mahalanobis(innovation_m, innovation_m2),
          std::log(innovation_m2.determinant())};
}

core::Matrix2 StepPositionFilter::noise_m2(const PlanarMeasurement& measurement) const {
  return std::pow(options_.radio_sigma_scale, 2) * measurement.covariance_m2 +
         std::pow(options_.radio_floor_sigma_m, 2) * core::Matrix2::Identity();
}

PlanarEstimate StepPositionFilter::at(core::DeviceTime time) const {
  WAYLODE_ASSERT(filter_);
  const Filter filter = carried(*filter_, time - time_, options_);
  return {time, filter.mean().head<2>() + as_walked(path_.offset_m(time), filter.mean()),
          filter.covariance().topLeftCorner<2, 2>()};
}

core::Vector2 StepPositionFilter::walked_offset_m(core::DeviceTime time) const {
  WAYLODE_ASSERT(filter_);
  return as_walked(path_.offset_m(time), filter_->mean());
}

double StepPositionFilter::heading_offset_rad() const { return filter_->mean()(kHeading); }

double StepPositionFilter::heading_offset_sigma_rad() const {
  return std::sqrt(filter_->covariance()(kHeading, kHeading));
}

double StepPositionFilter::step_scale() const { return std::exp(filter_->mean()(kLogScale)); }

double StepPositionFilter::log_scale_sigma() const {
  return std::sqrt(filter_->covariance()(kLogScale, kLogScale));
}

}  // namespace waylode::fusion
