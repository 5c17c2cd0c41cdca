// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/biased_field_state.hpp"

#include <cmath>
#include <numbers>

#include "waylode/core/assert.hpp"

namespace waylode::magnetic {

double BiasedFieldState::update(const LevelField& measured, const FieldExpectation& expected,
                                const ReadingWeight& weight) {
  WAYLODE_ASSERT(weight.power > 0.0 && weight.cap_sigmas > 0.0);
  if (!std::isfinite(measured.horizontal_ut) || !std::isfinite(measured.vertical_ut)) return 0.0;
  const core::Vector2 field_ut(measured.horizontal_ut, measured.vertical_ut);
  double log_likelihood = 0.0;
  for (Eigen::Index part = 0; part < 2; ++part) {
    // N(r; b, v)^p = (2 pi v)^(-p/2) (2 pi v/p)^(1/2) N(r; b, v/p): a Kalman update with v/p.
    const double reading_ut2 = expected.variance_ut2[part];
    const double bias_ut2 = variance_ut2[part];
    WAYLODE_ASSERT(reading_ut2 > 0.0 && bias_ut2 >= 0.0);
    const double tempered_ut2 = reading_ut2 / weight.power;
    const double innovation_ut2 = bias_ut2 + tempered_ut2;
    const double residual_ut = field_ut[part] - expected.mean_ut[part] - mean_ut[part];
    const double square = residual_ut * residual_ut / innovation_ut2;
    // The cap is in the reading's own sigmas, not in those that the power widened.
    const double most =
        weight.cap_sigmas * weight.cap_sigmas * (bias_ut2 + reading_ut2) / innovation_ut2;
    log_likelihood -= 0.5 * (std::fmin(square, most) +
                             weight.power * std::log(2.0 * std::numbers::pi * reading_ut2) +
                             std::log(innovation_ut2 / tempered_ut2));
    if (square > most) continue;
    const double gain = bias_ut2 / innovation_ut2;
    mean_ut[part] += gain * residual_ut;
    variance_ut2[part] = gain * tempered_ut2;
  }
  return log_likelihood;
}

}  // namespace waylode::magnetic
