// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/floor_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "waylode/site/detail/cell_grid.hpp"
#include "waylode/site/detail/crossing.hpp"
#include "waylode/site/detail/doorways.hpp"
#include "waylode/site/detail/wall_edges.hpp"

namespace waylode::site {

struct FloorGeometry::Index {
  std::vector<Polygon> walkable;
  std::vector<Polygon> obstacles;
  std::vector<detail::CellGrid::Segment> walls;
  detail::CellGrid walkable_grid;
  detail::CellGrid obstacle_grid;
  detail::CellGrid wall_grid;
};

namespace {

using core::Vector2;

constexpr double kLattice_m = 0.25;
constexpr double kMaxSearch_m = 50.0;

/// Whether a ray to the right of the point meets the ring an odd number of times.
bool encloses(const Ring& ring, const Vector2& point) {
  bool inside = false;
  for (std::size_t i = 0, previous = ring.size() - 1; i < ring.size(); previous = i++) {
    const Vector2& a = ring[previous];
    const Vector2& b = ring[i];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    // The edge's lower end first: neighbours that share an edge compute the same sign.
    const double side = a.y() < b.y() ? detail::turn(a, b, point) : detail::turn(b, a, point);
    if (side > 0.0) inside = !inside;
  }
  return inside;
}

bool encloses(const Polygon& polygon, const Vector2& point) {
  if (polygon.outer.empty()) return false;
  bool inside = encloses(polygon.outer, point);
  for (const Ring& hole : polygon.holes) {
    if (!hole.empty() && encloses(hole, point)) inside = !inside;
  }
  return inside;
}

bool any_encloses(const std::vector<Polygon>& polygons, const detail::CellGrid& grid,
                  const Vector2& point) {
  return std::ranges::any_of(grid.items_at(point),
                             [&](std::uint32_t item) { return encloses(polygons[item], point); });
}

detail::CellGrid grid_of(const std::vector<Polygon>& polygons) {
  std::vector<core::Bounds2> boxes;
  boxes.reserve(polygons.size());
  for (const Polygon& polygon : polygons) {
    core::Bounds2 box;
    if (!polygon.outer.empty()) box = {polygon.outer.front(), polygon.outer.front()};
    for (const Vector2& vertex : polygon.outer) {
      box = {box.min_m.cwiseMin(vertex), box.max_m.cwiseMax(vertex)};
    }
    boxes.push_back(box);
  }
  return detail::CellGrid::of_boxes(boxes);
}

/// The drawn walls and the obstacles' edges, with the doors open.
std::vector<detail::CellGrid::Segment> barriers_of(const Plan& plan) {
  std::vector<detail::CellGrid::Segment> barriers;
  const std::vector<Wall> walls = detail::walls_with_obstacle_edges(plan);
  for (const Wall& wall : detail::without_doorways(walls, plan.doors)) {
    barriers.emplace_back(wall.from_m, wall.to_m);
  }
  return barriers;
}

}  // namespace

FloorGeometry::FloorGeometry(const Plan& plan) {
  auto index = std::make_shared<Index>();
  index->walkable = plan.walkable;
  index->obstacles = plan.obstacles;
  index->walls = barriers_of(plan);
  index->walkable_grid = grid_of(index->walkable);
  index->obstacle_grid = grid_of(index->obstacles);
  index->wall_grid = detail::CellGrid::of_segments(index->walls);
  index_ = std::move(index);
}

bool FloorGeometry::has_walls() const { return !index_->walls.empty(); }

bool FloorGeometry::is_walkable(const Vector2& point_m) const {
  const Index& index = *index_;
  if (!index.walkable.empty() && !any_encloses(index.walkable, index.walkable_grid, point_m)) {
    return false;
  }
  return !any_encloses(index.obstacles, index.obstacle_grid, point_m);
}

bool FloorGeometry::crosses_wall(const Vector2& from_m, const Vector2& to_m) const {
  const Index& index = *index_;
  return index.wall_grid.any_along(from_m, to_m, [&](std::span<const std::uint32_t> items) {
    return std::ranges::any_of(items, [&](std::uint32_t item) {
      const auto& [a, b] = index.walls[item];
      return detail::crosses(a, b, from_m, to_m);
    });
  });
}

std::optional<Vector2> FloorGeometry::nearest_walkable(const Vector2& point_m,
                                                       double max_distance_m) const {
  if (is_walkable(point_m)) return point_m;
  double best_m = std::min(max_distance_m, kMaxSearch_m);
  std::optional<Vector2> nearest;
  // Square rings around the point; a ring's points are no nearer than its half width.
  for (int ring = 1; ring * kLattice_m <= best_m; ++ring) {
    for (int along = -ring; along < ring; ++along) {
      for (const auto& [x, y] : {std::pair(along, -ring), std::pair(ring, along),
                                 std::pair(-along, ring), std::pair(-ring, -along)}) {
        const Vector2 offset_m(x * kLattice_m, y * kLattice_m);
        const double distance_m = offset_m.norm();
        const bool nearer = nearest ? distance_m < best_m : distance_m <= best_m;
        if (!nearer || !is_walkable(point_m + offset_m)) continue;
        nearest = point_m + offset_m;
        best_m = distance_m;
      }
    }
  }
  return nearest;
}

}  // namespace waylode::site
