// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"
#include "waylode/magnetic/features.hpp"

namespace waylode::magnetic {

/// What is expected of the field at a place. Parts: horizontal, vertical; taken as independent.
struct FieldExpectation {
  core::Vector2 mean_ut = core::Vector2::Zero();
  core::Vector2 variance_ut2 = core::Vector2::Ones();  ///< Positive.
};

/// How one reading is weighed.
struct ReadingWeight {
  /// Power of the likelihood, above 0: less than 1 where readings repeat one another.
  double power = 1.0;
  double cap_sigmas = 3.0;  ///< A reading farther off counts as this far off. Positive.
};

/// A constant that a phone adds to its levelled field, learned along one guessed path: a Kalman
/// filter per part, small enough for every particle to carry. Copied with the particle.
struct BiasedFieldState {
  core::Vector2 mean_ut = core::Vector2::Zero();
  core::Vector2 variance_ut2 = core::Vector2::Zero();  ///< Not negative; zero: known, not learned.

  /// Logarithm of the reading's marginal likelihood to the power, the bias integrated out; then
  /// the bias learns from it. A part that is capped teaches nothing, and a measured field that is
  /// not finite is passed over: 0. `expected` and `weight` must be as their types say.
  double update(const LevelField& measured, const FieldExpectation& expected,
                const ReadingWeight& weight);
};

}  // namespace waylode::magnetic
