// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/covariance.hpp"
#include "waylode/fusion/testing/particle_model.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Vector2;
using testing::at_s;
using testing::gaussian_raster;
using testing::moments_of;
using testing::open_ground;
using testing::particle_options;
using testing::raster_scan;
using testing::step_of;

/// Squared Mahalanobis distances of the truth at the end of walks drawn from the filter's model.
std::vector<double> squared_errors(double bias_sigma_m) {
  constexpr int kRuns = 200;
  ParticleFilter::Options options = particle_options();
  options.particles = 1500;
  options.heading_offset_sigma_rad = 0.1;
  options.log_scale_sigma = 0.05;
  options.position_walk_m_per_sqrt_s = 0.3;
  options.radio_bias_sigma_m = bias_sigma_m;
  options.radio_bias_tau_s = 10.0;
  std::vector<double> squares;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    core::Rng rng(5000 + run);
    const auto draw = [&rng](double sigma) {
      return Vector2(rng.normal(0.0, sigma), rng.normal(0.0, sigma));
    };
    ParticleFilter filter(options, 900 + run, /*keep_history=*/false);
    filter.start(at_s(0.0), Vector2::Zero(), 3.0);
    Particle truth{draw(3.0), rng.normal(0.0, 0.1), rng.normal(0.0, 0.05), draw(bias_sigma_m)};
    const double kept = std::exp(-1.0 / 10.0);
    for (int i = 1; i <= 12; ++i) {
      const double heading_rad = 0.4 * i;
      const double walked_rad = heading_rad + rng.normal(0.0, 0.04);
      const double length_m = rng.normal(1.4, 0.05);
      truth.position_m += draw(0.3) + truth.walked_m(length_m * Vector2(std::cos(walked_rad),
                                                                        std::sin(walked_rad)));
      truth.radio_bias_m =
          kept * truth.radio_bias_m + draw(bias_sigma_m * std::sqrt(1.0 - kept * kept));
      filter.add(step_of(i - 1.0, i, 1.4, heading_rad), open_ground());
      if (i % 3 != 0) continue;
      const Vector2 heard_m = truth.position_m + truth.radio_bias_m + draw(3.0);
      filter.add(raster_scan(i, gaussian_raster(heard_m, 3.0)), open_ground());
    }
    const auto moments = moments_of(filter);
    squares.push_back(
        core::squared_mahalanobis(truth.position_m - moments.mean_m, moments.covariance_m2));
  }
  return squares;
}

TEST(ParticleFilterConsistency, StatesItsErrorHonestlyWithAndWithoutBias) {
  for (const double bias_sigma_m : {0.0, 3.0}) {
    double sum = 0.0;
    int within_68 = 0;
    int within_95 = 0;
    for (const double square : squared_errors(bias_sigma_m)) {
      sum += square;
      if (square < -2.0 * std::log(1.0 - 0.68)) ++within_68;
      if (square < -2.0 * std::log(1.0 - 0.95)) ++within_95;
    }
    // Chi-square with 400 degrees of freedom, divided by 200 runs, 99.9 % within.
    EXPECT_GT(sum / 200.0, 1.567) << bias_sigma_m;
    EXPECT_LT(sum / 200.0, 2.499) << bias_sigma_m;
    // Binomial, 200 draws, 3.3 sigma.
    EXPECT_NEAR(within_68, 136, 22) << bias_sigma_m;
    EXPECT_NEAR(within_95, 190, 10) << bias_sigma_m;
  }
}

}  // namespace
}  // namespace waylode::fusion
