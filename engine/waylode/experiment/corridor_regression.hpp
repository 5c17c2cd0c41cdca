// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/experiment/bootstrap.hpp"
#include "waylode/experiment/outcome.hpp"

namespace waylode::experiment {

/// Places in a corridor learnt from the strengths of eight access points [Zhao2019] 3.2: 16.15 m
/// by 3.7 m, four points on either long side 4 m apart, 48 reference places a metre apart.
struct CorridorRegression {
  struct Options {
    double reference_m = 2.0;       ///< d0.
    double reference_dbm = -35.0;   ///< P(d0); matching does not depend on it.
    double exponent = 2.0;          ///< n in (0, 10].
    double noise_sigma_db = 2.0;    ///< Of every reading, surveyed or asked for; in [0, 30].
    std::size_t scans = 1;          ///< Averaged at every reference place, 1 to 1000.
    std::size_t queries = 150;      ///< Per draw, uniform over the corridor, 1 to 100'000.
    std::uint64_t first_seed = 21;  ///< Rates and costs were chosen on seeds 1 to 20.
    std::size_t draws = 100;        ///< Seeds from the first on, 1 to 10'000.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// Samples are rows; places in metres from a corner, x along the corridor.
  struct Draw {
    Eigen::MatrixXd survey_dbm;
    Eigen::MatrixXd survey_m;
    Eigen::MatrixXd query_dbm;
    Eigen::MatrixXd query_m;
  };

  /// One way of positioning; a unit is a draw.
  struct Method {
    std::string name;
    std::vector<Unit> errors_m{};  ///< Distances to the truth.
    /// Where the method tells its sigma: error over sigma, magnitudes, of x and y.
    std::vector<Unit> errors_in_sigmas{};
    std::vector<Unit> sigmas_m{};  ///< Of x and y.
  };

  std::vector<Method> methods;
};

/// The survey and the queries of a seed. The options are valid (asserted).
CorridorRegression::Draw draw_corridor(const CorridorRegression::Options& options,
                                       std::uint64_t seed);

/// All methods on the same draws. kInvalidOptions, or what a learner refuses.
core::Result<CorridorRegression> compare_positioning(const CorridorRegression::Options& options);

/// The comparison beside the paper, with error curves.
core::Result<Outcome> corridor_regression_outcome(const CorridorRegression::Options& options);

}  // namespace waylode::experiment
