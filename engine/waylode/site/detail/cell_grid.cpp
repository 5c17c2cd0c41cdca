// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::site::detail {
namespace {

using core::Bounds2;
using core::Vector2;

void extend(Bounds2& bounds, const Vector2& point_m) {
  bounds.min_m = bounds.min_m.cwiseMin(point_m);
  bounds.max_m = bounds.max_m.cwiseMax(point_m);
}

/// Cells first..last of `count` that a stretch from low to high (in cells) touches.
std::pair<std::int32_t, std::int32_t> clamp_range(double low, double high, std::int32_t count) {
  if (!(high >= 0.0) || !(low < count)) return {0, -1};
  const double last = static_cast<double>(count) - 1.0;
  return {static_cast<std::int32_t>(std::max(0.0, std::floor(low))),
          static_cast<std::int32_t>(std::min(last, std::floor(high)))};
}

}  // namespace

CellGrid::CellGrid(const Bounds2& bounds) : min_m_(bounds.min_m) {
  const Vector2 size_m = bounds.size_m();
  while ((size_m.x() / cell_m_ + 1.0) * (size_m.y() / cell_m_ + 1.0) > kMaxCells) cell_m_ *= 2.0;
  columns_ = static_cast<std::int32_t>(std::floor(size_m.x() / cell_m_)) + 1;
  rows_ = static_cast<std::int32_t>(std::floor(size_m.y() / cell_m_)) + 1;
}

CellGrid::Range CellGrid::rows_of(double a_m, double b_m) const {
  const auto [low_m, high_m] = std::minmax(a_m, b_m);
  return clamp_range((low_m - min_m_.y() - kPad_m) / cell_m_,
                     (high_m - min_m_.y() + kPad_m) / cell_m_, rows_);
}

CellGrid::Range CellGrid::columns_of(double a_m, double b_m) const {
  const auto [low_m, high_m] = std::minmax(a_m, b_m);
  return clamp_range((low_m - min_m_.x() - kPad_m) / cell_m_,
                     (high_m - min_m_.x() + kPad_m) / cell_m_, columns_);
}

CellGrid::Range CellGrid::columns_in_row(const Vector2& from_m, const Vector2& to_m,
                                         std::int32_t row) const {
  const double height_m = to_m.y() - from_m.y();
  if (std::abs(height_m) <= kPad_m) return columns_of(from_m.x(), to_m.x());
  const double low_m = min_m_.y() + row * cell_m_ - kPad_m;
  const double high_m = low_m + cell_m_ + 2.0 * kPad_m;
  const double at_low = std::clamp((low_m - from_m.y()) / height_m, 0.0, 1.0);
  const double at_high = std::clamp((high_m - from_m.y()) / height_m, 0.0, 1.0);
  const double width_m = to_m.x() - from_m.x();
  return columns_of(from_m.x() + at_low * width_m, from_m.x() + at_high * width_m);
}

template <typename ForEachCell>
void CellGrid::fill(std::size_t item_count, ForEachCell&& for_each_cell) {
  begin_.assign(cell_of(rows_, 0) + 1, 0);
  for (std::size_t item = 0; item < item_count; ++item) {
    for_each_cell(item, [&](std::size_t cell) { ++begin_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  items_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t item = 0; item < item_count; ++item) {
    for_each_cell(
        item, [&](std::size_t cell) { items_[next[cell]++] = static_cast<std::uint32_t>(item); });
  }
}

CellGrid CellGrid::of_segments(std::span<const Segment> segments) {
  if (segments.empty()) return {};
  Bounds2 bounds{segments.front().first, segments.front().first};
  for (const auto& [from_m, to_m] : segments) {
    extend(bounds, from_m);
    extend(bounds, to_m);
  }
  CellGrid grid(bounds);
  grid.fill(segments.size(), [&](std::size_t item, auto&& add) {
    const auto& [from_m, to_m] = segments[item];
    const auto [first_row, last_row] = grid.rows_of(from_m.y(), to_m.y());
    for (std::int32_t row = first_row; row <= last_row; ++row) {
      const auto [first, last] = grid.columns_in_row(from_m, to_m, row);
      for (std::int32_t column = first; column <= last; ++column) add(grid.cell_of(row, column));
    }
  });
  return grid;
}

CellGrid CellGrid::of_boxes(std::span<const Bounds2> boxes) {
  if (boxes.empty()) return {};
  Bounds2 bounds = boxes.front();
  for (const Bounds2& box : boxes) {
    extend(bounds, box.min_m);
    extend(bounds, box.max_m);
  }
  CellGrid grid(bounds);
  grid.fill(boxes.size(), [&](std::size_t item, auto&& add) {
    const auto [first_row, last_row] = grid.rows_of(boxes[item].min_m.y(), boxes[item].max_m.y());
    const auto [first, last] = grid.columns_of(boxes[item].min_m.x(), boxes[item].max_m.x());
    for (std::int32_t row = first_row; row <= last_row; ++row) {
      for (std::int32_t column = first; column <= last; ++column) add(grid.cell_of(row, column));
    }
  });
  return grid;
}

std::span<const std::uint32_t> CellGrid::items_at(const Vector2& point_m) const {
  const Vector2 cells = (point_m - min_m_) / cell_m_;
  if (!(cells.x() >= 0.0) || !(cells.y() >= 0.0) || !(cells.x() < columns_) ||
      !(cells.y() < rows_)) {
    return {};
  }
  return items_of(static_cast<std::int32_t>(cells.y()), static_cast<std::int32_t>(cells.x()));
}

}  // namespace waylode::site::detail
