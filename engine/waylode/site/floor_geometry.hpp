// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::site {

/// A plan prepared for the questions a tracker asks many times. Immutable, safe to share between
/// threads, cheap to copy. All positions: floor frame, metres, finite. Signs are computed in double
/// precision without tolerance: exact for coordinates on a millimetre-like lattice, otherwise a
/// point may count for either side of a line it misses by less than 1e-9 m.
class FloorGeometry {
 public:
  explicit FloorGeometry(const Plan& plan);

  bool has_walls() const;

  /// In a walkable area, or no such area is drawn, and in no obstacle. Even-odd rule over a
  /// polygon's rings; of an axis-aligned edge the left and the lower one belong to the polygon.
  bool is_walkable(const core::Vector2& point_m) const;

  /// Whether the straight way crosses a wall or an obstacle's edge (the edges of walkable areas are
  /// no walls by themselves, doors are open). A wall divides the plane into its left side, with the
  /// line itself, and its right; a way crosses when its ends are on different sides and it meets
  /// the wall, the wall's ends included. So walking along a wall or standing still does not cross,
  /// two walls that share an end leave no gap, and of a way split at any point one part crosses if
  /// the whole does.
  bool crosses_wall(const core::Vector2& from_m, const core::Vector2& to_m) const;

  /// A walkable point near `point_m`: the point itself, or the nearest one of a 0.25 m lattice
  /// around it; nullopt when none is within `max_distance_m` (taken as 50 m at most). Farther than
  /// the true nearest point by less than 0.36 m where the area is wider than that. The work grows
  /// with the square of the distance: for starts and recoveries, not for every particle.
  std::optional<core::Vector2> nearest_walkable(const core::Vector2& point_m,
                                                double max_distance_m) const;

 private:
  struct Index;
  std::shared_ptr<const Index> index_;
};

}  // namespace waylode::site
