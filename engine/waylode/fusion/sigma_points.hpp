// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"

namespace waylode::fusion {

/// How far the sigma points of an unscented transform lie from the mean, and how the central one
/// counts.
struct SigmaSpread {
  double alpha = 1.0;  ///< (0, 1]; small where the functions bend within the covariance.
  double beta = 2.0;   ///< >= alpha^2, which keeps every covariance positive; 2 suits a Gaussian.
  double kappa = 0.0;  ///< Greater than minus the number of states.

  /// `states` is the dimension of the state, positive.
  core::Result<void> validate(int states) const;
  /// alpha^2 (states + kappa) - states: "lambda". states + lambda is positive when valid.
  double lambda(int states) const;
  bool operator==(const SigmaSpread&) const = default;
};

/// Weights of the central point in means and in covariances, and of each of the 2 n others.
struct SigmaWeights {
  double central_mean = 0.0;
  double central_covariance = 0.0;
  double other = 0.0;

  double mean_sum(int states) const { return central_mean + 2.0 * states * other; }
};

/// The weights that reproduce a Gaussian's mean and covariance; mean weights sum to one.
SigmaWeights sigma_weights(const SigmaSpread& spread, int states);
/// As [Wu2019] eq. (17) prints them, lambda in the numerator of the outer ones: their sum is one
/// only for lambda = 1. For comparison; the filter cannot be made to use them.
SigmaWeights printed_sigma_weights(const SigmaSpread& spread, int states);

}  // namespace waylode::fusion
