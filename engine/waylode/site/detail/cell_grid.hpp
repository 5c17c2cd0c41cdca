// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::site::detail {

/// A uniform grid whose cells list the items (segments or boxes, by index) that touch them, in one
/// compressed array. Cells are kCell_m wide, more on floors of more than kMaxCells of them.
class CellGrid {
 public:
  static constexpr double kCell_m = 2.0;
  static constexpr double kMaxCells = 1'000'000.0;

  using Segment = std::pair<core::Vector2, core::Vector2>;

  CellGrid() = default;
  /// Every cell that a segment passes through lists it.
  static CellGrid of_segments(std::span<const Segment> segments);
  /// Every cell that a box touches lists it.
  static CellGrid of_boxes(std::span<const core::Bounds2> boxes);

  /// The items of the cell that holds the point; none outside the grid.
  std::span<const std::uint32_t> items_at(const core::Vector2& point_m) const;

  /// Calls `visit(items)` for every cell the segment passes through until one returns true; whether
  /// one did. Cells within kPad_m of the segment may be visited too: rounding never skips one.
  template <typename Visit>
  bool any_along(const core::Vector2& from_m, const core::Vector2& to_m, Visit&& visit) const {
    const auto [first_row, last_row] = rows_of(from_m.y(), to_m.y());
    for (std::int32_t row = first_row; row <= last_row; ++row) {
      const auto [first_column, last_column] = columns_in_row(from_m, to_m, row);
      for (std::int32_t column = first_column; column <= last_column; ++column) {
        if (visit(items_of(row, column))) return true;
      }
    }
    return false;
  }

 private:
  static constexpr double kPad_m = 1e-6;
  using Range = std::pair<std::int32_t, std::int32_t>;  ///< First and last; empty when reversed.

  explicit CellGrid(const core::Bounds2& bounds);
  Range rows_of(double a_m, double b_m) const;
  Range columns_of(double a_m, double b_m) const;
  Range columns_in_row(const core::Vector2& from_m, const core::Vector2& to_m,
                       std::int32_t row) const;
  std::size_t cell_of(std::int32_t row, std::int32_t column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::span<const std::uint32_t> items_of(std::int32_t row, std::int32_t column) const {
    const std::size_t cell = cell_of(row, column);
    return std::span(items_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
  }
  /// `for_each_cell(item, add)` calls `add(cell)` for the item's cells; the same ones each time.
  template <typename ForEachCell>
  void fill(std::size_t item_count, ForEachCell&& for_each_cell);

  core::Vector2 min_m_ = core::Vector2::Zero();
  double cell_m_ = kCell_m;
  std::int32_t rows_ = 0;
  std::int32_t columns_ = 0;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> items_;
};

}  // namespace waylode::site::detail
