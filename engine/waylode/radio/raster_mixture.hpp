// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/observation/likelihood_raster.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::radio {

/// Where the nodes of a raster are; floor frame.
struct RasterGeometry {
  core::Vector2 origin_m = core::Vector2::Zero();  ///< Of the first node.
  double node_m = 2.0;                             ///< Between nodes, above 0.
  std::size_t columns = 0;                         ///< Along x.
  std::size_t rows = 0;                            ///< Along y.

  core::Vector2 node_at(std::size_t index) const {
    return origin_m + node_m * core::Vector2(static_cast<double>(index % columns),
                                             static_cast<double>(index / columns));
  }
  std::size_t nodes() const { return columns * rows; }
  bool operator==(const RasterGeometry&) const = default;
};

/// Turns surveyed places that resemble a scan into a raster of how well it fits each place.
struct CandidateKernel {
  double sigma_m = 3.0;          ///< Of the kernel about each candidate, above 0.
  double uniform_share = 0.005;  ///< Likelihood of a place that resembles nothing; above 0.

  core::Result<void> validate() const;
  bool operator==(const CandidateKernel&) const = default;
};

/// log(uniform_share + sum of weight * exp(-(d / sigma)^2 / 2)): not normalised, so that many
/// scattered candidates are a weaker statement than few together. Candidates that are not finite
/// are passed over. `kernel` must be valid.
observation::LikelihoodRaster rasterise(std::span<const observation::RadioCandidate> candidates,
                                        const CandidateKernel& kernel,
                                        const RasterGeometry& geometry);

/// first_weight * first + second_weight * second, on the nodes of `first`. The sum of logarithms,
/// not their mixture: two views of one scan. An empty one says nothing: the other as it is, times
/// its weight.
observation::LikelihoodRaster combine(const observation::LikelihoodRaster& first,
                                      double first_weight,
                                      const observation::LikelihoodRaster& second,
                                      double second_weight);

}  // namespace waylode::radio
