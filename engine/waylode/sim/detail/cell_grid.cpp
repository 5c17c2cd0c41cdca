// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/cell_grid.hpp"

#include <array>
#include <map>
#include <utility>

namespace waylode::sim::detail {

namespace {

using Corner = std::pair<int, int>;
/// East, north, west, south: the way around a cell with the cell on the left.
constexpr std::array<Corner, 4> kDirections = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
/// The cell's neighbour across the side walked in that direction: south, east, north, west.
constexpr std::array<Corner, 4> kOutside = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
/// Where that side starts, as an offset from the cell's south-west corner.
constexpr std::array<Corner, 4> kSideStart = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

using Sides = std::map<Corner, std::array<bool, 4>>;

std::vector<Corner> connected_cells(const CellGrid& grid, Corner start, CellGrid& seen) {
  std::vector<Corner> cells = {start};
  seen.set_free(start.first, start.second);
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const Corner cell = cells[next];
    for (const auto& [dx, dy] : kOutside) {
      const Corner neighbour = {cell.first + dx, cell.second + dy};
      if (!grid.is_free(neighbour.first, neighbour.second) ||
          seen.is_free(neighbour.first, neighbour.second)) {
        continue;
      }
      seen.set_free(neighbour.first, neighbour.second);
      cells.push_back(neighbour);
    }
  }
  return cells;
}

Sides outer_sides(const CellGrid& grid, const std::vector<Corner>& cells) {
  Sides sides;
  for (const auto& [column, row] : cells) {
    for (std::size_t side = 0; side < 4; ++side) {
      if (grid.is_free(column + kOutside[side].first, row + kOutside[side].second)) continue;
      sides[{column + kSideStart[side].first, row + kSideStart[side].second}][side] = true;
    }
  }
  return sides;
}

/// Follows and removes one ring; where two corners of free cells meet it keeps to the same cell.
std::vector<Corner> take_ring(Sides& sides) {
  Corner corner = sides.begin()->first;
  std::size_t direction = 0;
  while (!sides.begin()->second[direction]) ++direction;
  const Corner first = corner;
  const std::size_t first_direction = direction;
  std::vector<Corner> ring;
  std::size_t previous = 4;
  while (true) {
    if (direction != previous) ring.push_back(corner);
    previous = direction;
    const auto entry = sides.find(corner);
    entry->second[direction] = false;
    if (entry->second == std::array<bool, 4>{}) sides.erase(entry);
    corner = {corner.first + kDirections[direction].first,
              corner.second + kDirections[direction].second};
    const auto next = sides.find(corner);
    if (next == sides.end()) break;
    const std::array<std::size_t, 3> order = {(direction + 1) % 4, direction, (direction + 3) % 4};
    bool found = false;
    for (const std::size_t candidate : order) {
      if (!next->second[candidate]) continue;
      direction = candidate;
      found = true;
      break;
    }
    if (!found) break;
  }
  // The ring starts at its smallest corner, always a turn, unless two rings touch there.
  if (ring.size() > 1 && corner == first && previous == first_direction) ring.erase(ring.begin());
  return ring;
}

site::Ring to_metres(const std::vector<Corner>& ring, double cell_m) {
  site::Ring result;
  result.reserve(ring.size());
  for (const auto& [x, y] : ring) result.emplace_back(x * cell_m, y * cell_m);
  return result;
}

bool is_counter_clockwise(const std::vector<Corner>& ring) {
  long doubled_area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner& a = ring[i];
    const Corner& b = ring[(i + 1) % ring.size()];
    doubled_area += static_cast<long>(a.first) * b.second - static_cast<long>(b.first) * a.second;
  }
  return doubled_area > 0;
}

/// Runs of true along one line, as [begin, end).
template <typename Predicate>
std::vector<std::pair<int, int>> runs(int count, Predicate&& predicate) {
  std::vector<std::pair<int, int>> result;
  int begin = -1;
  for (int i = 0; i <= count; ++i) {
    const bool inside = i < count && predicate(i);
    if (inside && begin < 0) begin = i;
    if (inside || begin < 0) continue;
    result.emplace_back(begin, i);
    begin = -1;
  }
  return result;
}

}  // namespace

std::vector<site::Polygon> outline_free_cells(const CellGrid& grid) {
  std::vector<site::Polygon> polygons;
  CellGrid seen(grid.columns(), grid.rows(), grid.cell_m());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (!grid.is_free(column, row) || seen.is_free(column, row)) continue;
      Sides sides = outer_sides(grid, connected_cells(grid, {column, row}, seen));
      site::Polygon polygon;
      while (!sides.empty()) {
        const std::vector<Corner> ring = take_ring(sides);
        if (is_counter_clockwise(ring)) {
          polygon.outer = to_metres(ring, grid.cell_m());
        } else {
          polygon.holes.push_back(to_metres(ring, grid.cell_m()));
        }
      }
      polygons.push_back(std::move(polygon));
    }
  }
  return polygons;
}

std::vector<site::Wall> face_walls(const CellGrid& grid) {
  std::vector<site::Wall> walls;
  const double cell_m = grid.cell_m();
  for (int row = 0; row <= grid.rows(); ++row) {
    const auto is_face = [&](int column) {
      return grid.is_free(column, row - 1) != grid.is_free(column, row);
    };
    for (const auto& [begin, end] : runs(grid.columns(), is_face)) {
      walls.push_back({{begin * cell_m, row * cell_m}, {end * cell_m, row * cell_m}});
    }
  }
  for (int column = 0; column <= grid.columns(); ++column) {
    const auto is_face = [&](int row) {
      return grid.is_free(column - 1, row) != grid.is_free(column, row);
    };
    for (const auto& [begin, end] : runs(grid.rows(), is_face)) {
      walls.push_back({{column * cell_m, begin * cell_m}, {column * cell_m, end * cell_m}});
    }
  }
  return walls;
}

std::vector<site::Wall> centre_walls(const CellGrid& grid) {
  std::vector<site::Wall> walls;
  for (int row = 0; row < grid.rows(); ++row) {
    const auto is_wall = [&](int column) { return !grid.is_free(column, row); };
    for (const auto& [begin, end] : runs(grid.columns(), is_wall)) {
      if (end - begin > 1)
        walls.push_back({grid.centre_m(begin, row), grid.centre_m(end - 1, row)});
    }
  }
  for (int column = 0; column < grid.columns(); ++column) {
    const auto is_wall = [&](int row) { return !grid.is_free(column, row); };
    for (const auto& [begin, end] : runs(grid.rows(), is_wall)) {
      if (end - begin > 1) {
        walls.push_back({grid.centre_m(column, begin), grid.centre_m(column, end - 1)});
      }
    }
  }
  return walls;
}

}  // namespace waylode::sim::detail
