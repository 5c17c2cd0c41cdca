// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/stride_calibrator.hpp"

#include <cmath>

namespace waylode::pdr {
namespace {

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

}  // namespace

core::Result<void> StrideCalibrator::Options::validate() const {
  if (!(is_positive(mean_gain_sigma) && is_positive(swing_gain_sigma) &&
        is_positive(scale_sigma_ratio) && is_positive(prior.scale_ratio) &&
        std::isfinite(prior.mean_gain) && std::isfinite(prior.swing_gain))) {
    return core::fail(core::ErrorCode::kInvalidOptions, "sigmas and scale_ratio must be positive",
                      "stride_calibrator");
  }
  return {};
}

StrideCalibrator::StrideCalibrator(const Options& options)
    : options_(options), gains_(options.prior) {
  const bool is_scale = options.unknown == Unknown::kScale;
  covariance_(0, 0) = std::pow(is_scale ? options.scale_sigma_ratio : options.mean_gain_sigma, 2);
  covariance_(1, 1) = is_scale ? 0.0 : std::pow(options.swing_gain_sigma, 2);
}

void StrideCalibrator::add(const observation::StrideFeatures& features) {
  if (!std::isfinite(features.mean_abs_time_mps) || !std::isfinite(features.swing_root)) return;
  segment_ += core::Vector2(features.mean_abs_time_mps, features.swing_root);
  ++count_;
}

void StrideCalibrator::add_length(double unscaled_m) {
  if (!std::isfinite(unscaled_m)) return;
  length_m_ += unscaled_m;
  ++count_;
}

core::Result<void> StrideCalibrator::observe(double distance_m, double sigma_m) {
  const bool is_scale = options_.unknown == Unknown::kScale;
  const double unscaled_m =
      length_m_ + options_.prior.mean_gain * segment_(0) + options_.prior.swing_gain * segment_(1);
  const core::Vector2 regressor = is_scale ? core::Vector2(unscaled_m, 0.0) : segment_;
  const bool is_empty = count_ == 0 || regressor.norm() == 0.0;
  drop_segment();
  if (is_empty || !(distance_m >= 0.0) || !std::isfinite(distance_m) || !is_positive(sigma_m)) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "a segment needs steps, a distance and a positive sigma",
                      "stride_calibrator");
  }
  // [Wu2019] eq. (9), corrected on line: one measurement of recursive least squares. The prior's
  // covariance is the ridge.
  const double predicted_m =
      is_scale ? gains_.scale_ratio * unscaled_m
               : regressor.dot(core::Vector2(gains_.mean_gain, gains_.swing_gain)) *
                     options_.prior.scale_ratio;
  const core::Vector2 slope =
      is_scale ? regressor : core::Vector2(regressor * options_.prior.scale_ratio);
  const core::Vector2 cross = covariance_ * slope;
  const core::Vector2 gain = cross / (slope.dot(cross) + sigma_m * sigma_m);
  const core::Vector2 correction = gain * (distance_m - predicted_m);
  if (is_scale) {
    gains_.scale_ratio += correction(0);
  } else {
    gains_.mean_gain += correction(0);
    gains_.swing_gain += correction(1);
  }
  const core::Matrix2 reduction = gain * cross.transpose();
  covariance_ -= 0.5 * (reduction + reduction.transpose()).eval();
  return {};
}

void StrideCalibrator::drop_segment() {
  segment_.setZero();
  length_m_ = 0.0;
  count_ = 0;
}

}  // namespace waylode::pdr
