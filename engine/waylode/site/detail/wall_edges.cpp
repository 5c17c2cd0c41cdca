// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/wall_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace waylode::site::detail {
namespace {

using Millimetres = std::pair<std::int64_t, std::int64_t>;

Millimetres to_millimetres(const core::Vector2& point_m) {
  return {std::llround(point_m.x() * 1000.0), std::llround(point_m.y() * 1000.0)};
}

class EdgeCollector {
 public:
  void add(const Polygon& polygon) {
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  void add(const core::Vector2& from_m, const core::Vector2& to_m) {
    const Millimetres a = to_millimetres(from_m);
    const Millimetres b = to_millimetres(to_m);
    if (a != b && seen_.insert(std::minmax(a, b)).second) walls_.push_back({from_m, to_m});
  }
  bool contains(const Wall& wall) const {
    return seen_.contains(std::minmax(to_millimetres(wall.from_m), to_millimetres(wall.to_m)));
  }
  std::vector<Wall> take() { return std::move(walls_); }

 private:
  void add(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      add(ring[i], ring[(i + 1) % ring.size()]);
    }
  }

  std::set<std::pair<Millimetres, Millimetres>> seen_;
  std::vector<Wall> walls_;
};

}  // namespace

std::vector<Wall> edges_of(const Plan& plan) {
  EdgeCollector edges;
  for (const Polygon& polygon : plan.walkable) edges.add(polygon);
  for (const Polygon& polygon : plan.obstacles) edges.add(polygon);
  return edges.take();
}

std::vector<Wall> walls_with_obstacle_edges(const Plan& plan) {
  EdgeCollector edges;
  for (const Wall& wall : plan.walls) edges.add(wall.from_m, wall.to_m);
  for (const Polygon& polygon : plan.obstacles) edges.add(polygon);
  return edges.take();
}

Barriers barriers_of(const Plan& plan) {
  EdgeCollector area_edges;
  for (const Wall& edge : edges_of(plan)) area_edges.add(edge.from_m, edge.to_m);
  Barriers barriers;
  for (const Wall& wall : walls_with_obstacle_edges(plan)) {
    (area_edges.contains(wall) ? barriers.edges : barriers.thin_walls).push_back(wall);
  }
  return barriers;
}

}  // namespace waylode::site::detail
