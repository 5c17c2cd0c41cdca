// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "waylode/core/geometry.hpp"
#include "waylode/site/detail/nearest_cell.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::site::detail {

/// Where a raster's cells lie: square, from `min_m` up.
struct RasterFrame {
  static constexpr double kMaxCells = 4'000'000.0;

  core::Vector2 min_m = core::Vector2::Zero();
  double cell_m = 1.0;
  int columns = 1;
  int rows = 1;

  /// Covers `bounds` (finite, not reversed); cells are doubled until there are at most kMaxCells.
  static RasterFrame covering(const core::Bounds2& bounds, double cell_m);

  core::Vector2 centre_m(int column, int row) const {
    return min_m + cell_m * core::Vector2(column + 0.5, row + 0.5);
  }
  std::size_t cell_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  CellMarks marks(bool marked) const;
};

/// Sets the cells whose centre the polygon encloses (even-odd over its rings) to `marked`.
void mark_polygon(const Polygon& polygon, bool marked, const RasterFrame& frame, CellMarks& marks);

/// Marks the cells whose centre lies within the circle.
void mark_disc(const core::Vector2& middle_m, double radius_m, const RasterFrame& frame,
               CellMarks& marks);

/// Marks at least every cell that a wall touches.
void mark_wall(const Wall& wall, const RasterFrame& frame, CellMarks& marks);

}  // namespace waylode::site::detail
