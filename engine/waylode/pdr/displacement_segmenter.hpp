// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::pdr {

/// A straight stretch of a walk.
struct Displacement {
  core::DeviceTime begin;
  core::DeviceTime end;
  double length_m = 0.0;       ///< Sum of the steps.
  double direction_rad = 0.0;  ///< Circular mean of the steps' headings.
  std::size_t step_count = 0;

  bool operator==(const Displacement&) const = default;
};

/// Splits the steps that move a person into straight stretches [Zhong2017] 2.7: a step that departs
/// from the stretch's mean direction begins the next one. The steps within a corner may make short
/// stretches of their own.
class DisplacementSegmenter {
 public:
  struct Options {
    double tolerance_rad = 0.34907;  ///< 20 degrees, in (0, pi/2].

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit DisplacementSegmenter(const Options& options) : options_(options) {}

  /// Tells a stretch when the first step beyond it comes. Steps of no length are passed over.
  std::optional<Displacement> add(const observation::MotionDelta& motion);
  /// The open stretch, if there is one; the next step begins anew.
  std::optional<Displacement> finish();

 private:
  void take(const observation::MotionDelta& motion);

  Options options_;
  std::optional<Displacement> open_;
  core::Vector2 direction_sum_ = core::Vector2::Zero();
};

/// Turns between neighbours, counter-clockwise, in (-pi, pi]; one less than there are stretches.
std::vector<double> corner_angles_rad(std::span<const Displacement> displacements);

/// Corners of the way walked, from `start_m` on; one more than there are stretches.
std::vector<core::Vector2> polyline_m(const core::Vector2& start_m,
                                      std::span<const Displacement> displacements);

}  // namespace waylode::pdr
