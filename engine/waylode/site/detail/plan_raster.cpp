// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/plan_raster.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace waylode::site::detail {
namespace {

using core::Vector2;

/// First and last whole number in [low, high], at most 0..count-1; reversed when there is none.
std::pair<int, int> whole_within(double low, double high, int count) {
  const double first = std::max(0.0, std::ceil(low));
  const double last = std::min(static_cast<double>(count) - 1.0, std::floor(high));
  if (!(first <= last)) return {0, -1};
  return {static_cast<int>(first), static_cast<int>(last)};
}

/// Positions counted in cells, so that a cell's centre is at its whole column and row.
Vector2 in_cells(const Vector2& point_m, const RasterFrame& frame) {
  return (point_m - frame.min_m) / frame.cell_m - Vector2(0.5, 0.5);
}

/// Where the ring crosses each row's line of centres.
void add_crossings(const Ring& ring, const RasterFrame& frame,
                   std::vector<std::vector<double>>& crossings) {
  for (std::size_t i = 0, previous = ring.size() - 1; i < ring.size(); previous = i++) {
    Vector2 low = in_cells(ring[previous], frame);
    Vector2 high = in_cells(ring[i], frame);
    if (low.y() > high.y()) std::swap(low, high);
    const auto [first, last] = whole_within(low.y(), high.y(), frame.rows);
    for (int row = first; row <= last; ++row) {
      if (row == high.y()) continue;  // Its lower end belongs to an edge, its upper one does not.
      const double share = (row - low.y()) / (high.y() - low.y());
      crossings[static_cast<std::size_t>(row)].push_back(low.x() + share * (high.x() - low.x()));
    }
  }
}

}  // namespace

RasterFrame RasterFrame::covering(const core::Bounds2& bounds, double cell_m) {
  const Vector2 size_m = bounds.size_m();
  const auto count = [](double length_m, double cell) {
    return std::max(1.0, std::ceil(length_m / cell));
  };
  constexpr double kMaxSide = 65'535.0;
  const auto is_too_fine = [&] {
    const double columns = count(size_m.x(), cell_m);
    const double rows = count(size_m.y(), cell_m);
    return columns * rows > kMaxCells || columns > kMaxSide || rows > kMaxSide;
  };
  while (is_too_fine()) cell_m *= 2.0;
  return {bounds.min_m, cell_m, static_cast<int>(count(size_m.x(), cell_m)),
          static_cast<int>(count(size_m.y(), cell_m))};
}

CellMarks RasterFrame::marks(bool marked) const {
  return {columns, rows,
          std::vector<std::uint8_t>(cell_of(0, rows), static_cast<std::uint8_t>(marked ? 1 : 0))};
}

void mark_polygon(const Polygon& polygon, bool marked, const RasterFrame& frame, CellMarks& marks) {
  if (polygon.outer.empty()) return;
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(frame.rows));
  add_crossings(polygon.outer, frame, crossings);
  for (const Ring& hole : polygon.holes) {
    if (!hole.empty()) add_crossings(hole, frame, crossings);
  }
  for (int row = 0; row < frame.rows; ++row) {
    std::vector<double>& along = crossings[static_cast<std::size_t>(row)];
    std::ranges::sort(along);
    for (std::size_t i = 0; i + 1 < along.size(); i += 2) {
      const auto [first, last] = whole_within(along[i], along[i + 1], frame.columns);
      for (int column = first; column <= last; ++column) {
        marks.marked[frame.cell_of(column, row)] = marked ? 1 : 0;
      }
    }
  }
}

void mark_disc(const Vector2& middle_m, double radius_m, const RasterFrame& frame,
               CellMarks& marks) {
  const Vector2 middle = in_cells(middle_m, frame);
  const double radius = radius_m / frame.cell_m;
  const auto [first, last] = whole_within(middle.y() - radius, middle.y() + radius, frame.rows);
  for (int row = first; row <= last; ++row) {
    const double height = row - middle.y();
    const double half = std::sqrt(std::max(0.0, radius * radius - height * height));
    const auto [begin, end] = whole_within(middle.x() - half, middle.x() + half, frame.columns);
    for (int column = begin; column <= end; ++column) {
      marks.marked[frame.cell_of(column, row)] = 1;
    }
  }
}

void mark_wall(const Wall& wall, const RasterFrame& frame, CellMarks& marks) {
  // Half a cell to each side of a centre, and a little for rounding.
  constexpr double kReach = 0.5 + 1e-6;
  Vector2 low = in_cells(wall.from_m, frame);
  Vector2 high = in_cells(wall.to_m, frame);
  if (low.y() > high.y()) std::swap(low, high);
  const Vector2 way = high - low;
  const auto [first, last] = whole_within(low.y() - kReach, high.y() + kReach, frame.rows);
  for (int row = first; row <= last; ++row) {
    double enter = 0.0;
    double leave = 1.0;
    if (way.y() > kReach - 0.5) {
      enter = std::clamp((row - kReach - low.y()) / way.y(), 0.0, 1.0);
      leave = std::clamp((row + kReach - low.y()) / way.y(), 0.0, 1.0);
    }
    const auto [left, right] = std::minmax({low.x() + enter * way.x(), low.x() + leave * way.x()});
    const auto [begin, end] = whole_within(left - kReach, right + kReach, frame.columns);
    for (int column = begin; column <= end; ++column) {
      marks.marked[frame.cell_of(column, row)] = 1;
    }
  }
}

}  // namespace waylode::site::detail
