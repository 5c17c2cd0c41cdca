// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "waylode/fusion/particle_filter.hpp"

/// What the tests of particles have in common: all options set, an open floor, Gaussian scans.
namespace waylode::fusion::testing {

/// Heading and scale all but certain, scans free of bias, nobody carried off, no plan.
inline ParticleFilter::Options particle_options() {
  ParticleFilter::Options options;
  options.particles = 2000;
  options.heading_offset_sigma_rad = 1e-6;
  options.heading_offset_walk_rad_per_sqrt_step = 0.0;
  options.log_scale_sigma = 0.0;
  options.log_scale_walk_per_sqrt_step = 0.0;
  options.position_walk_m_per_sqrt_s = 0.01;
  options.radio_bias_sigma_m = 0.0;
  options.radio_bias_tau_s = 30.0;
  options.radio_trust = 1.0;
  options.jump_probability = 0.0;
  options.plan_trust = 0.0;
  options.resample_ratio = 0.5;
  options.base_sigma_m = 1e-6;
  options.sigma_scale = 1.0;
  return options;
}

inline Ground open_ground() { return {}; }

/// Log-likelihood of an isotropic Gaussian at the nodes of 200 m by 200 m. Between them it is
/// linear, which makes the scan's variance hardly greater: nodes of 1 m.
inline observation::LikelihoodRaster gaussian_raster(const core::Vector2& mean_m, double sigma_m) {
  observation::LikelihoodRaster raster;
  raster.origin_m = core::Vector2(-100.0, -100.0);
  raster.node_m = 1.0;
  raster.columns = raster.rows = 201;
  for (std::size_t row = 0; row < raster.rows; ++row) {
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const double off_m = (raster.node_at(row, column) - mean_m).norm() / sigma_m;
      raster.log_likelihood.push_back(static_cast<float>(-0.5 * off_m * off_m));
    }
  }
  raster.elsewhere = -1e5F;
  return raster;
}

inline ScanLikelihood raster_scan(double delivered_s, observation::LikelihoodRaster raster,
                                  double delay_s = 0.0) {
  return {core::device_time_from_seconds(delivered_s - delay_s),
          core::device_time_from_seconds(delivered_s),
          std::make_shared<const observation::LikelihoodRaster>(std::move(raster))};
}

/// The same scan, weighed place by place: each hypothesis as a Gaussian of its own covariance's
/// size.
inline observation::RadioObservation with_rasters(observation::RadioObservation scan) {
  for (observation::FloorHypothesis& hypothesis : scan.floors) {
    const double sigma_m = std::sqrt(hypothesis.covariance_m2(0, 0));
    hypothesis.raster = std::make_shared<const observation::LikelihoodRaster>(
        gaussian_raster(hypothesis.position_m, sigma_m));
  }
  return scan;
}

struct Moments {
  core::Vector2 mean_m = core::Vector2::Zero();
  core::Matrix2 covariance_m2 = core::Matrix2::Zero();
};

inline Moments moments_of(const ParticleFilter& filter) {
  Moments moments;
  const auto& particles = filter.particles();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    moments.mean_m += filter.weights()[i] * particles[i].position_m;
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const core::Vector2 off_m = particles[i].position_m - moments.mean_m;
    moments.covariance_m2 += filter.weights()[i] * off_m * off_m.transpose();
  }
  return moments;
}

}  // namespace waylode::fusion::testing
