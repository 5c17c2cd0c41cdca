// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::sim::detail {

/// Where a person's middle can be on one floor, on a fine grid with the distance to the nearest
/// wall, and ways through it.
class NavGrid {
 public:
  /// From the plan: walkable outlines (else the bounds) minus obstacles; walls and outlines keep
  /// people off.
  explicit NavGrid(const site::Floor& floor);

  /// Inside the walkable area, whatever the distance to walls.
  bool is_walkable(const core::Vector2& position_m) const;
  /// Distance from the middle of this cell to the nearest wall, at most kFarClearance_m; 0 outside.
  double clearance_m(const core::Vector2& position_m) const;

  /// The way of least cost, which is length plus an extra near walls, as straight pieces between
  /// `from_m` and `to_m` (both included). nullopt when there is none.
  std::optional<std::vector<core::Vector2>> find_way(const core::Vector2& from_m,
                                                     const core::Vector2& to_m) const;
  /// The same way with evenly spaced vertices and rounded corners; `fixed` vertices and the ends
  /// keep their place. Never nearer to a wall than kLeastClearance_m unless it was already.
  void round_corners(std::vector<core::Vector2>& vertices_m) const;

  static constexpr double kCell_m = 0.25;
  static constexpr double kLeastClearance_m = 0.25;
  static constexpr double kFarClearance_m = 1.5;
  static constexpr double kVertexSpacing_m = 0.1;

 private:
  using Cell = std::int32_t;
  static constexpr Cell kOutside = -1;

  Cell cell_at(const core::Vector2& position_m) const;
  core::Vector2 centre_m(Cell cell) const;
  std::optional<Cell> nearest_passable(const core::Vector2& position_m) const;
  bool is_passable(Cell cell) const;
  std::vector<Cell> search(Cell from, Cell to) const;
  bool is_clear_line(const core::Vector2& from_m, const core::Vector2& to_m,
                     double clearance_m) const;
  void mark_inside(const site::Ring& ring, bool adds);
  void keep_off(const core::Vector2& from_m, const core::Vector2& to_m);
  void keep_off(const site::Polygon& polygon);

  core::Vector2 origin_m_;
  Cell columns_ = 0;
  Cell rows_ = 0;
  std::vector<std::uint8_t> inside_;
  std::vector<float> clearance_m_;
};

/// Vertices every `spacing_m` along straight pieces; corners and ends are among them.
std::vector<core::Vector2> resample(const std::vector<core::Vector2>& way_m, double spacing_m);

}  // namespace waylode::sim::detail
