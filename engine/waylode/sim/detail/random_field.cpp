// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/random_field.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::sim::detail {

namespace {

core::Vector2 draw_wave_vector(core::Rng& rng, Correlation correlation, double range_m) {
  if (correlation == Correlation::kSquaredExponential) {
    const double sigma_radpm = std::sqrt(2.0) / range_m;
    const double x = rng.normal(0.0, sigma_radpm);
    const double y = rng.normal(0.0, sigma_radpm);
    return {x, y};
  }
  // In the plane exp(-d/range) has the density (1 + (k range)^2)^(-3/2), whose radial distribution
  // function 1 - (1 + (k range)^2)^(-1/2) inverts in closed form.
  const double rest = 1.0 - rng.uniform();
  const double magnitude_radpm = std::sqrt(1.0 / (rest * rest) - 1.0) / range_m;
  const double direction_rad = rng.uniform(0.0, 2.0 * core::kPi);
  return {magnitude_radpm * std::cos(direction_rad), magnitude_radpm * std::sin(direction_rad)};
}

}  // namespace

RandomField::RandomField(std::uint64_t seed, Correlation correlation, double range_m) {
  core::Rng rng(seed);
  for (Wave& wave : waves_) {
    wave.vector_radpm = draw_wave_vector(rng, correlation, range_m);
    wave.phase_rad = rng.uniform(0.0, 2.0 * core::kPi);
  }
}

double RandomField::at(const core::Vector2& position_m) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum += std::cos(wave.vector_radpm.dot(position_m) + wave.phase_rad);
  }
  return sum * std::sqrt(2.0 / static_cast<double>(kFeatures));
}

SmoothNoise::SmoothNoise(core::Rng& rng, double time_scale_s) {
  for (Wave& wave : waves_) {
    wave.rate_radps = rng.uniform(0.3, 1.7) / time_scale_s;
    wave.phase_rad = rng.uniform(0.0, 2.0 * core::kPi);
  }
}

double SmoothNoise::at(double t_s) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.rate_radps * t_s + wave.phase_rad);
  return sum * std::sqrt(2.0 / static_cast<double>(kWaves));
}

}  // namespace waylode::sim::detail
