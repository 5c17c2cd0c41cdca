// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::site {

/// How well a step fits a floor's plan, cheap enough to ask for every particle. Everything is soft
/// and limited, so that a person whom a wrong plan puts into a wall stays where the other evidence
/// says. Immutable, safe to share between threads, cheap to copy. Positions: floor frame, metres.
///
/// Areas are rastered: what is said of depth holds to about a cell. Walls are exact.
class Walkability {
 public:
  struct Options {
    double cell_m = 0.25;       ///< Of the raster of areas; 0.05 to 2. Coarser on huge floors.
    double softness_m = 0.6;    ///< Depth that costs 0.5; 0.05 to 10. More: the plan is less exact.
    double wall_penalty = 3.0;  ///< For crossing walls in one step, however many; 0 to 100.
    double max_penalty = 6.0;   ///< A step never costs more; 0 to 100, 0 ignores the plan.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `bounds`: where people can be; the plan's extent when it is empty or not finite. What of the
  /// plan is not finite or lies beyond 1000 km is passed over. Areas that leave no place to walk
  /// are not believed. Within a door's circle neither walls nor obstacles count.
  Walkability(const Plan& plan, const core::Bounds2& bounds, const Options& options);

  /// Whether the plan says anything; without, every place is walkable and no step costs.
  bool knows_anything() const;

  /// Log-likelihood of the step, from -max_penalty to 0: 0.5 (depth / softness)^2 of its end and
  /// wall_penalty when it crosses a wall. The edges of areas count as walls only
  /// between two walkable places: depth tells the rest, and leaving an obstacle is free.
  /// -max_penalty for a position that is not finite.
  double log_penalty(const core::Vector2& from_m, const core::Vector2& to_m) const;

  /// Distance to the nearest walkable place, 0 at one. +infinity for a point that is not finite.
  double depth_m(const core::Vector2& point_m) const;

  /// The point itself if walkable, else the walkable place nearest to its cell. nullopt for a point
  /// that is not finite.
  std::optional<core::Vector2> nearest_walkable(const core::Vector2& point_m) const;

  /// Uniform over the walkable places within the bounds; over the bounds when there are none.
  core::Vector2 sample_walkable(core::Rng& rng) const;

 private:
  struct Raster;
  std::shared_ptr<const Raster> raster_;
};

}  // namespace waylode::site
