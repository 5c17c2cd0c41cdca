// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/learn/regression.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::radio {

/// Learns, floor by floor and coordinate by coordinate, the place from the RSSI of the floor's most
/// telling transmitters: [Zhao2019] 1. The regressor's own sigma and the scan's noise, carried
/// through it, become the covariance. The nearest points vote for the floor where there are
/// several. Ignores the prior.
class RegressionPositioner final : public Positioner {
 public:
  enum class Kind : std::uint8_t { kRelevanceVectors, kSupportVectors };

  struct Options {
    Kind kind = Kind::kRelevanceVectors;
    /// The spline is normalised, for it drowns the other kernels with many transmitters.
    learn::RelevanceVectorRegression::Options relevance{
        .kernel = {.gauss_rate = 1.0, .laplace_rate = 1.0, .normalise_spline = true}, .fit = {}};
    learn::SupportVectorRegression::Options support{};
    learn::InputScaler::Options scaler{};
    std::size_t max_transmitters = 200;  ///< Per floor, those that vary the most; 1 to 1000.
    /// The kernels' rates are for so many transmitters; with more, squared distances grow, and the
    /// rates shrink in proportion. Above 0.
    double rate_transmitters = 16.0;
    /// Per floor; where there are more, neighbours are merged on a coarser and coarser grid until
    /// they are as few. Training takes the cube of it; 5 to 2000.
    std::size_t max_points = 300;
    std::size_t floor_neighbours = 5;  ///< Nearest points that vote for the floor; 1 to 1000.
    /// Noise of a single scan's readings, at least 0. Its effect on the place adds to the
    /// covariance: a map of averaged readings teaches the regressor nothing of it, whose own sigma
    /// is then some three times too small.
    double scan_sigma_db = 3.0;
    /// Sigma per axis where the regressor knows none; added to the residual of training.
    double unknown_sigma_m = 2.0;
    double min_sigma_m = 0.5;  ///< No regressor is believed to be better; above 0.
    double margin_m = 2.0;     ///< How far outside the box of the points a place may lie; from 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// kMapMissing for a map without points, or what training fails with. `map` must outlive this.
  static core::Result<RegressionPositioner> create(const ReferenceMap& map, const Options& options);

  std::optional<Positioning> estimate(const Query& query, std::optional<core::FloorId> known_floor,
                                      const std::optional<core::Belief>& prior) const override;

  /// Vectors that the models of all floors keep.
  std::size_t vector_count() const;

 private:
  struct FloorModel {
    core::FloorId floor;
    std::vector<std::uint32_t> transmitters;  ///< Columns of an input.
    core::Bounds2 bounds_m;                   ///< Of its points, margin included.
    core::Vector2 mean_m = core::Vector2::Zero();
    core::Matrix2 scatter_m2 = core::Matrix2::Zero();
    /// Of training, where the regressor knows no sigma.
    core::Vector2 residual_m = core::Vector2::Zero();
    /// None where too few points are all there is: then their mean and scatter answer.
    std::optional<learn::Regression> regression;
  };

  RegressionPositioner(const ReferenceMap& map, const Options& options)
      : map_(&map), options_(options) {}

  core::Result<FloorModel> learn_floor(const ReferenceMap::FloorRange& range) const;
  std::optional<observation::FloorHypothesis> locate(const FloorModel& model,
                                                     const ReferenceQuery& heard) const;

  const ReferenceMap* map_;
  Options options_;
  std::vector<FloorModel> models_;
};

}  // namespace waylode::radio
