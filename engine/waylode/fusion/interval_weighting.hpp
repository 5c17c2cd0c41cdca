// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "waylode/core/result.hpp"
#include "waylode/fusion/planar_estimate.hpp"

namespace waylode::fusion {

/// How much of the weighted point is magnetic.
enum class WeightingMode : std::uint8_t {
  kInverseVariance,    ///< By the covariances of the two, whatever the time.
  kIntervalsMoreWifi,  ///< By intervals of time; in the last one a second pair with more Wi-Fi.
  kIntervalsMagnetic,  ///< By intervals of time; in the last one the magnetic position alone.
};

/// One point from a Wi-Fi and a magnetic position of the same instant [Zhou2016] 2.1.
class IntervalWeighting {
 public:
  struct Options {
    WeightingMode mode = WeightingMode::kInverseVariance;
    double first_interval_s = 4.0;           ///< "epsilon 1", before it Wi-Fi alone; >= 0.
    double second_interval_s = 40.0;         ///< "epsilon 2", after it the last interval; >= first.
    double magnetic_share_ratio = 0.7;       ///< "u1" between the two; 0 to 1.
    double magnetic_share_late_ratio = 0.5;  ///< Its second value; 0 to 1.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit IntervalWeighting(const Options& options) : options_(options) {}

  /// `since_start` is not negative; positions finite, covariances valid. The outcome is dated like
  /// `wifi`; its covariance takes the two errors for independent.
  PlanarEstimate combine(core::Duration since_start, const PlanarEstimate& magnetic,
                         const PlanarEstimate& wifi) const;
  /// Magnetic share at a time, for the modes by intervals.
  double magnetic_share(core::Duration since_start) const;

 private:
  Options options_;
};

/// The mean of two independent estimates, weighted by their inverse covariances.
PlanarEstimate inverse_variance_mean(const PlanarEstimate& one, const PlanarEstimate& other);

}  // namespace waylode::fusion
