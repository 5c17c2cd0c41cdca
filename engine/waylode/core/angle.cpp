// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/angle.hpp"

#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::core {

double wrap_angle(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

double heading_from_azimuth(double azimuth_rad) { return wrap_angle(kPi / 2.0 - azimuth_rad); }

double azimuth_from_heading(double heading_rad) {
  const double azimuth_rad = wrap_angle(kPi / 2.0 - heading_rad);
  if (azimuth_rad >= 0.0) return azimuth_rad;
  const double positive_rad = azimuth_rad + 2.0 * kPi;
  return positive_rad < 2.0 * kPi ? positive_rad : 0.0;  // The sum may round up to a full turn.
}

std::optional<CircularMean> circular_mean(std::span<const double> angles_rad,
                                          std::span<const double> weights) {
  WAYLODE_ASSERT(weights.empty() || weights.size() == angles_rad.size());
  double sine_sum = 0.0;
  double cosine_sum = 0.0;
  double weight_sum = 0.0;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    const double weight = weights.empty() ? 1.0 : weights[i];
    sine_sum += weight * std::sin(angles_rad[i]);
    cosine_sum += weight * std::cos(angles_rad[i]);
    weight_sum += weight;
  }
  if (weight_sum <= 0.0) return std::nullopt;
  const double resultant_ratio = std::hypot(sine_sum, cosine_sum) / weight_sum;
  constexpr double kCancelledRatio = 1e-9;  // Below this the direction is rounding noise.
  if (resultant_ratio < kCancelledRatio) return std::nullopt;
  return CircularMean{wrap_angle(std::atan2(sine_sum, cosine_sum)), resultant_ratio};
}

}  // namespace waylode::core
