// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::sim::detail {

enum class Correlation : std::uint8_t {
  kExponential,         ///< exp(-d / range)
  kSquaredExponential,  ///< exp(-(d / range)^2)
};

/// A Gaussian random field over the plane with unit variance: a fixed function of the seed, cheap
/// anywhere, by random Fourier features [RahimiRecht2007]: a sum of cosines whose wave vectors are
/// drawn from the spectral density of the correlation.
class RandomField {
 public:
  RandomField(std::uint64_t seed, Correlation correlation, double range_m);
  double at(const core::Vector2& position_m) const;

 private:
  static constexpr std::size_t kFeatures = 96;
  struct Wave {
    core::Vector2 vector_radpm;
    double phase_rad = 0.0;
  };
  std::array<Wave, kFeatures> waves_;
};

/// A smooth random function of time with unit variance; varies over about `time_scale_s`.
class SmoothNoise {
 public:
  SmoothNoise(core::Rng& rng, double time_scale_s);
  double at(double t_s) const;

 private:
  static constexpr std::size_t kWaves = 5;
  struct Wave {
    double rate_radps = 0.0;
    double phase_rad = 0.0;
  };
  std::array<Wave, kWaves> waves_;
};

}  // namespace waylode::sim::detail
