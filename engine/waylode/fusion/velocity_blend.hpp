// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"

namespace waylode::fusion {

/// Speed and direction of walking. The direction is counter-clockwise from +x.
struct PolarVelocity {
  double speed_mps = 0.0;
  double heading_rad = 0.0;

  core::Vector2 vector_mps() const;
  bool operator==(const PolarVelocity&) const = default;
};

/// Blends the last velocity, the one between two fused positions and the one of the sensors
/// [Zhou2016] eqs. (14) and (15); headings by their weighted circular mean. While turning, the
/// sensors alone count, else the turn would lag.
class VelocityBlend {
 public:
  /// Each sums to one; none is negative.
  struct Shares {
    double last = 0.0;
    double fused = 0.0;
    double sensed = 1.0;

    bool operator==(const Shares&) const = default;
  };
  struct Options {
    Shares speed{0.3, 0.1, 0.6};    ///< "q1, q2, q3".
    Shares heading{0.2, 0.1, 0.7};  ///< "p1, p2, p3".
    double turn_rad = 0.6;          ///< Sensed heading this far from the last one: a turn; > 0.
    double fastest_mps = 2.0;       ///< The fused speed counts no more than this; > 0.
    double slowest_mps = 0.2;       ///< A slower one has no direction: the sensed one counts; >= 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit VelocityBlend(const Options& options) : options_(options) {}

  /// All finite, speeds not negative. Where the headings cancel, the sensed one counts.
  PolarVelocity blend(const PolarVelocity& last, const PolarVelocity& fused,
                      const PolarVelocity& sensed) const;
  bool is_turn(const PolarVelocity& last, const PolarVelocity& sensed) const;

 private:
  Options options_;
};

/// [Zhou2016] eqs. (16) and (17).
core::Vector2 moved_m(const core::Vector2& position_m, const PolarVelocity& velocity,
                      core::Duration by);

}  // namespace waylode::fusion
