// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::sim::detail {

/// Cells that are free or wall; row 0 is the southernmost. Everything outside is wall.
class CellGrid {
 public:
  CellGrid(int columns, int rows, double cell_m)
      : columns_(columns),
        rows_(rows),
        cell_m_(cell_m),
        free_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), false) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell_m() const { return cell_m_; }
  bool is_free(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_ && free_[index(column, row)];
  }
  void set_free(int column, int row) { free_[index(column, row)] = true; }
  core::Vector2 centre_m(int column, int row) const {
    return {(column + 0.5) * cell_m_, (row + 0.5) * cell_m_};
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_;
  int rows_;
  double cell_m_;
  std::vector<bool> free_;
};

/// The free cells as polygons: one per set of cells connected by their sides, outer ring
/// counter-clockwise, holes clockwise, no vertex on a straight side.
std::vector<site::Polygon> outline_free_cells(const CellGrid& grid);

/// The sides between free and wall cells, each as long as it can be.
std::vector<site::Wall> face_walls(const CellGrid& grid);

/// Lines through the middles of wall cells that touch by their sides, each as long as it can be: a
/// wall of any length that is one cell thick is one line.
std::vector<site::Wall> centre_walls(const CellGrid& grid);

}  // namespace waylode::sim::detail
