// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/magnetic/biased_field_state.hpp"
#include "waylode/magnetic/features.hpp"
#include "waylode/site/magnetic_map.hpp"

namespace waylode::magnetic {

/// How likely one reading of the field is at any place of a floor, for particles. A raster drawn
/// once; looking up costs four nodes and two logarithms. Immutable: shared by sessions.
///
/// Likelihoods are ratios: against a reading of the floor at large. Where nothing was surveyed the
/// ratio is one, so that unknown ground is neither rewarded nor punished.
class FieldLikelihood {
 public:
  struct Options {
    double node_m = 0.5;          ///< Between raster nodes. At least 0.05.
    double kernel_m = 1.0;        ///< Sigma of the weight of a surveyed point by its distance.
    double reach_m = 3.0;         ///< Points farther off than this say nothing. At least node_m.
    double trust_points = 1.0;    ///< So much kernel weight is half known ground. Positive.
    double field_sigma_ut = 5.0;  ///< Reading against map at one place, per part. Positive.
    double bias_sigma_ut = 2.0;   ///< The phone's own constant part on a walk. 0: none.
    double cap_sigmas = 3.0;      ///< A reading farther off counts as this far off. Positive.
    double correlation_m = 2.5;   ///< Readings within this much of walking are one. Positive.
    double weight_ratio = 0.5;    ///< Power of a whole reading. Above 0, at most 1.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  FieldLikelihood() = default;  ///< Knows nothing anywhere: always 0.
  /// `points`: of one floor, as MagneticMap::on_floor() gives them. `options` must be valid.
  FieldLikelihood(std::span<const site::MagneticPoint> points, const Options& options);

  bool empty() const { return nodes_.empty(); }

  /// Everywhere: off surveyed ground the floor's mean and spread, as for no finite position.
  FieldExpectation expected_at(const core::Vector2& position_m) const;

  /// For one whole independent reading, of a phone whose bias is not followed: it widens the
  /// reading. 0: as likely as anywhere, so too for a field that is not finite.
  double log_likelihood(const LevelField& measured, const core::Vector2& position_m) const;

  /// The bias before the first reading.
  BiasedFieldState start() const;
  /// Of a reading `walked_m` after the last one that was weighed, weighed down by how much they
  /// repeat each other; the guess's own bias is integrated out and learns. 0 for no walking, for a
  /// field that is not finite and on an empty floor.
  double update(BiasedFieldState& bias, const LevelField& measured, const core::Vector2& position_m,
                double walked_m) const;

 private:
  struct Node {
    Eigen::Vector2f mean_ut = Eigen::Vector2f::Zero();
    Eigen::Vector2f variance_ut2 = Eigen::Vector2f::Zero();
  };

  void lay_out(std::span<const site::MagneticPoint> points);
  void draw(std::span<const site::MagneticPoint> points);

  Options options_;
  FieldExpectation floor_;  ///< The floor at large.
  core::Vector2 min_m_ = core::Vector2::Zero();
  double node_m_ = 0.0;
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<Node> nodes_;  ///< Row by row.
};

}  // namespace waylode::magnetic
