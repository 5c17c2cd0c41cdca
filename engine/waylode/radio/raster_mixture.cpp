// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/raster_mixture.hpp"

#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::radio {
namespace {

observation::LikelihoodRaster scaled(observation::LikelihoodRaster raster, double weight) {
  for (float& value : raster.log_likelihood) value *= static_cast<float>(weight);
  raster.elsewhere *= static_cast<float>(weight);
  return raster;
}

bool usable(const observation::RadioCandidate& candidate) {
  return candidate.position_m.allFinite() && std::isfinite(candidate.weight) &&
         candidate.weight > 0.0;
}

}  // namespace

core::Result<void> CandidateKernel::validate() const {
  if (!(sigma_m > 0.0 && sigma_m <= 1000.0 && uniform_share > 0.0 && uniform_share <= 1.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "sigma_m must be in (0, 1000], uniform_share in (0, 1]", "candidate kernel");
  }
  return {};
}

observation::LikelihoodRaster rasterise(std::span<const observation::RadioCandidate> candidates,
                                        const CandidateKernel& kernel,
                                        const RasterGeometry& geometry) {
  WAYLODE_ASSERT(kernel.validate().has_value());
  observation::LikelihoodRaster raster{
      geometry.origin_m, geometry.node_m, geometry.columns, geometry.rows, {}, 0.0F};
  raster.elsewhere = static_cast<float>(std::log(kernel.uniform_share));
  raster.log_likelihood.reserve(geometry.nodes());
  const double precision = 0.5 / (kernel.sigma_m * kernel.sigma_m);
  for (std::size_t node = 0; node < geometry.nodes(); ++node) {
    const core::Vector2 place_m = geometry.node_at(node);
    double sum = kernel.uniform_share;
    for (const observation::RadioCandidate& candidate : candidates) {
      if (!usable(candidate)) continue;
      const double square_m2 = (candidate.position_m - place_m).squaredNorm();
      sum += candidate.weight * std::exp(-precision * square_m2);
    }
    raster.log_likelihood.push_back(static_cast<float>(std::log(sum)));
  }
  return raster;
}

observation::LikelihoodRaster combine(const observation::LikelihoodRaster& first,
                                      double first_weight,
                                      const observation::LikelihoodRaster& second,
                                      double second_weight) {
  if (first.empty()) return scaled(second, second_weight);
  observation::LikelihoodRaster sum = scaled(first, first_weight);
  if (second.empty()) return sum;
  for (std::size_t row = 0; row < sum.rows; ++row) {
    for (std::size_t column = 0; column < sum.columns; ++column) {
      sum.log_likelihood[row * sum.columns + column] +=
          static_cast<float>(second_weight * second.at(sum.node_at(row, column)));
    }
  }
  sum.elsewhere += static_cast<float>(second_weight) * second.elsewhere;
  return sum;
}

}  // namespace waylode::radio
