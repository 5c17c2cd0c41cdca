// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/interval_weighting.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {
namespace {

core::Matrix2 symmetrised(const core::Matrix2& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

core::Result<void> IntervalWeighting::Options::validate() const {
  const auto is_ratio = [](double value) { return value >= 0.0 && value <= 1.0; };
  const bool sound = first_interval_s >= 0.0 && std::isfinite(second_interval_s) &&
                     second_interval_s >= first_interval_s && is_ratio(magnetic_share_ratio) &&
                     is_ratio(magnetic_share_late_ratio);
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "intervals must not be negative and must follow one another, shares 0 to 1",
                      "interval_weighting");
  }
  return {};
}

// [Zhou2016] 2.1.
double IntervalWeighting::magnetic_share(core::Duration since_start) const {
  const double since_s = core::to_seconds(since_start);
  if (since_s < options_.first_interval_s) return 0.0;
  if (since_s < options_.second_interval_s) return options_.magnetic_share_ratio;
  return options_.mode == WeightingMode::kIntervalsMagnetic ? 1.0
                                                            : options_.magnetic_share_late_ratio;
}

PlanarEstimate IntervalWeighting::combine(core::Duration since_start,
                                          const PlanarEstimate& magnetic,
                                          const PlanarEstimate& wifi) const {
  WAYLODE_ASSERT(detail::is_sound(magnetic) && detail::is_sound(wifi));
  if (options_.mode == WeightingMode::kInverseVariance)
    return inverse_variance_mean(wifi, magnetic);
  const double share = magnetic_share(since_start);
  return {
      wifi.time, share * magnetic.position_m + (1.0 - share) * wifi.position_m,
      share * share * magnetic.covariance_m2 + (1.0 - share) * (1.0 - share) * wifi.covariance_m2};
}

PlanarEstimate inverse_variance_mean(const PlanarEstimate& one, const PlanarEstimate& other) {
  // P1 (P1 + P2)^-1: the other's share.
  const core::Matrix2 sum_m2 = one.covariance_m2 + other.covariance_m2;
  const core::Matrix2 share = sum_m2.ldlt().solve(one.covariance_m2).transpose();
  return {one.time, one.position_m + share * (other.position_m - one.position_m),
          symmetrised(share * other.covariance_m2)};
}

}  // namespace waylode::fusion
