// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/sigma_points.hpp"

#include <cmath>

namespace waylode::fusion {

core::Result<void> SigmaSpread::validate(int states) const {
  const bool sound = alpha > 0.0 && alpha <= 1.0 && std::isfinite(beta) && beta >= alpha * alpha &&
                     std::isfinite(kappa) && states + kappa > 0.0;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "alpha must be in (0, 1], beta at least alpha squared, kappa greater than "
                      "minus the number of states",
                      "sigma_spread");
  }
  return {};
}

double SigmaSpread::lambda(int states) const { return alpha * alpha * (states + kappa) - states; }

// [Wu2019] eq. (17) with the outer weights of the unscented transform [Julier2004].
SigmaWeights sigma_weights(const SigmaSpread& spread, int states) {
  const double spanned = spread.alpha * spread.alpha * (states + spread.kappa);
  const double central = spread.lambda(states) / spanned;
  return {central, central + 1.0 - spread.alpha * spread.alpha + spread.beta, 0.5 / spanned};
}

SigmaWeights printed_sigma_weights(const SigmaSpread& spread, int states) {
  SigmaWeights weights = sigma_weights(spread, states);
  weights.other *= spread.lambda(states);
  return weights;
}

}  // namespace waylode::fusion
