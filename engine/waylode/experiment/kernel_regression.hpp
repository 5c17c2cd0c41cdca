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
#include "waylode/learn/regression.hpp"

namespace waylode::experiment {

/// How well kernels learn signal strength over distance from noisy samples [Zhao2019] 3.1, fig. 5
/// to 7.
struct KernelRegression {
  struct Options {
    std::size_t samples = 200;  ///< 2 to 2000, at distances uniform between the next two.
    double nearest_m = 1.0;
    double farthest_m = 40.0;
    double reference_m = 2.0;       ///< d0.
    double reference_dbm = -35.0;   ///< P(d0).
    double exponent = 3.5;          ///< n.
    double noise_sigma_db = 2.0;    ///< "Of strength 4": a variance of 4 gives the paper's figures.
    std::uint64_t first_seed = 21;  ///< Rates and costs were chosen on seeds 1 to 20.
    std::size_t draws = 100;        ///< Seeds from the first on, 1 to 10'000.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  struct Draw {
    Eigen::VectorXd distance_m;
    Eigen::VectorXd truth_dbm;
    Eigen::VectorXd measured_dbm;
  };

  /// One way of learning; a unit is a draw.
  struct Method {
    std::string name;
    learn::Regression::Options learning;
    std::vector<Unit> measured_errors_db{};  ///< Magnitudes, of every sample.
    std::vector<Unit> true_errors_db{};      ///< Against the curve without noise.
    std::vector<Unit> largest_errors_db{};   ///< To the samples; one value per draw.
    std::vector<Unit> vectors{};             ///< How many are kept; one value per draw.
    Eigen::VectorXd first_curve_dbm{};       ///< Of the first draw.
  };

  Draw first_draw;
  std::vector<Method> methods;
};

/// The samples of a seed. The options are valid (asserted).
KernelRegression::Draw draw_path_loss(const KernelRegression::Options& options, std::uint64_t seed);

/// All methods on the same draws. kInvalidOptions, or what a learner refuses.
core::Result<KernelRegression> compare_kernels(const KernelRegression::Options& options);

/// The comparison beside the paper, with the first draw's curves.
core::Result<Outcome> kernel_regression_outcome(const KernelRegression::Options& options);

}  // namespace waylode::experiment
