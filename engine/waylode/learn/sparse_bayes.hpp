// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "waylode/core/result.hpp"

namespace waylode::learn {

/// What linear weights under Gaussian noise and a zero-mean Gaussian prior of precision alpha_i
/// each are, given the targets. [Tipping2001] eq. (11)-(13)
struct SparseBayesPosterior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd gamma;      ///< How far the data determine each weight, in [0, 1].
  double log_evidence = 0.0;  ///< log N(z | 0, sigma^2 I + Phi A^-1 Phi^T).
};

/// Of targets z = design * weights + noise. `precisions` has one positive entry per column of
/// `design`, noise_variance > 0, everything is finite and matches (asserted).
SparseBayesPosterior sparse_bayes_posterior(const Eigen::MatrixXd& design,
                                            const Eigen::VectorXd& targets,
                                            const Eigen::VectorXd& precisions,
                                            double noise_variance);

/// Weights whose precisions and noise maximise the evidence. Columns that the evidence does
/// without, as their precision grows beyond all bounds, are left out.
struct SparseBayesFit {
  struct Options {
    std::size_t max_iterations = 5'000;  ///< At least 1; cheap once columns are few.
    double tolerance = 1e-2;             ///< Stop when no log alpha moves by more; in (0, 1].
    /// Columns are left out when alpha exceeds this, where the column has a largest magnitude of 1
    /// and the targets a mean square of 1. In (1, 1e12].
    double prune_above = 1e6;
    /// All alphas to begin with, in the same scale; in [1e-9, 1e3]. Much below 1, noise is fitted
    /// first and the many columns that takes are not all let go: weights less sparse, sigma too
    /// small.
    double start_precision = 1.0;
    /// Noise variance to begin with, as a share of the targets' mean square; in (0, 10].
    double start_noise_ratio = 0.1;
    /// The noise's sigma never falls below, in the targets' unit; in [1e-9, 1e9].
    double min_noise_sigma = 1e-6;
    /// Where the noise is known, in the square of the targets' unit: not estimated then. Counts
    /// as no less than 1e-10 of the targets' mean square.
    std::optional<double> noise_variance = std::nullopt;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  std::vector<Eigen::Index> columns;  ///< Of the design, ascending: those kept.
  Eigen::VectorXd precisions;         ///< alpha, one per column kept, as are the next.
  double noise_variance = 0.0;
  SparseBayesPosterior posterior;  ///< For just these precisions and noise.
  std::size_t iterations = 0;
  bool converged = false;  ///< Within max_iterations.
  /// Of the precisions each iteration began with: mostly rising, which the updates do not promise.
  std::vector<double> log_evidences;
};

/// kInvalidOptions for options, kInvalidArgument for no rows, sizes that do not match, values that
/// are not finite or beyond 1e50. Targets that are all zero need no column.
core::Result<SparseBayesFit> fit_sparse_bayes(const Eigen::MatrixXd& design,
                                              const Eigen::VectorXd& targets,
                                              const SparseBayesFit::Options& options);

}  // namespace waylode::learn
