// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pdr/stride_model.hpp"

namespace waylode::pdr {

/// Learns a person's stride from distances that something else has measured, as [Wu2019] and
/// [Zhao2019] do with radio fixes: recursive least squares on segments, held to a prior, for the
/// two quantities are so alike that free gains would run away.
class StrideCalibrator {
 public:
  enum class Unknown {
    kGains,  ///< Both gains of StrideModel::Model::kImproved.
    kScale,  ///< One factor on any model's lengths.
  };

  struct Options {
    Unknown unknown = Unknown::kGains;
    StrideGains prior{};              ///< Where it starts.
    double mean_gain_sigma = 0.03;    ///< Doubt of prior.mean_gain; > 0.
    double swing_gain_sigma = 0.05;   ///< Doubt of prior.swing_gain; > 0.
    double scale_sigma_ratio = 0.08;  ///< Doubt of prior.scale_ratio; > 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit StrideCalibrator(const Options& options);

  /// A step of the open segment.
  void add(const observation::StrideFeatures& features);
  /// For kScale with another model than kImproved: the step's length before any correction.
  void add_length(double unscaled_m);

  /// The open segment was `distance_m` long along the way walked, give or take `sigma_m`; opens the
  /// next. Fails, and drops the segment, if it had no step or the numbers make no sense.
  core::Result<void> observe(double distance_m, double sigma_m);
  /// Drops the open segment, as after a turn that makes its ends useless.
  void drop_segment();

  const StrideGains& gains() const { return gains_; }
  /// Of (mean_gain, swing_gain); of the scale, squared, in its first element for kScale.
  const core::Matrix2& covariance() const { return covariance_; }

 private:
  Options options_;
  StrideGains gains_;
  core::Matrix2 covariance_ = core::Matrix2::Zero();
  core::Vector2 segment_ = core::Vector2::Zero();  ///< Sums of (mean |a| T, swing root).
  double length_m_ = 0.0;                          ///< Sum of lengths told by add_length.
  std::size_t count_ = 0;
};

}  // namespace waylode::pdr
