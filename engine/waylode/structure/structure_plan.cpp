// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/structure_plan.hpp"

#include <algorithm>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/algorithms/union.hpp>
#include <boost/geometry/algorithms/unique.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "waylode/site/floor_geometry.hpp"

namespace waylode::structure {
namespace {

using core::Vector2;
namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
// Counter-clockwise, open rings: the conventions of site::Polygon.
using BoostPolygon = bg::model::polygon<BoostPoint, false, false>;
using BoostArea = bg::model::multi_polygon<BoostPolygon>;

/// Blank border of the drawing.
constexpr double kMargin_m = 1.0;
/// Holes and areas below this are left by rounding and are no part of a building.
constexpr double kLeastArea_m2 = 0.01;

/// How often and by how much wider corridors are tried when their outline cannot be drawn.
constexpr int kAttempts = 5;
constexpr double kWidening_m = 0.004;
/// A point is on a line when it is off by no more: what rounding does.
constexpr double kStraight_m = 0.0015;

/// To the millimetre, which format_plan writes exactly.
double rounded(double value_m) { return std::round(value_m * 1e3) / 1e3; }

/// Four corners, half a width beyond both ends, so that corridors fill the corner where they meet.
site::Ring corridor(const Vector2& from_m, const Vector2& to_m, double width_m) {
  const Vector2 along = (to_m - from_m).normalized() * (0.5 * width_m);
  const Vector2 across(-along.y(), along.x());
  return {from_m - along - across, to_m + along - across, to_m + along + across,
          from_m - along + across};
}

BoostPolygon to_boost(const site::Ring& ring) {
  BoostPolygon polygon;
  for (const Vector2& point_m : ring) {
    polygon.outer().emplace_back(rounded(point_m.x()), rounded(point_m.y()));
  }
  bg::correct(polygon);
  return polygon;
}

site::Ring from_boost(const BoostPolygon::ring_type& ring) {
  site::Ring converted;
  for (const BoostPoint& point : ring) converted.emplace_back(point.x(), point.y());
  return converted;
}

/// To whole millimetres, without points that then lie on the line between their neighbours.
void round(BoostPolygon::ring_type& ring) {
  for (BoostPoint& point : ring) point = {rounded(point.x()), rounded(point.y())};
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const BoostPoint& before = ring[(i + ring.size() - 1) % ring.size()];
    const BoostPoint& after = ring[(i + 1) % ring.size()];
    const Vector2 chord_m(after.x() - before.x(), after.y() - before.y());
    const Vector2 way_m(ring[i].x() - before.x(), ring[i].y() - before.y());
    const double off_m = std::abs(chord_m.x() * way_m.y() - chord_m.y() * way_m.x());
    if (off_m <= kStraight_m * chord_m.norm()) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

/// Rounded, without what rounding has left; nothing when it can then not be drawn.
std::optional<BoostPolygon> tidied(BoostPolygon polygon) {
  round(polygon.outer());
  for (auto& hole : polygon.inners()) round(hole);
  std::erase_if(polygon.inners(), [](const BoostPolygon::ring_type& hole) {
    return std::abs(bg::area(hole)) < kLeastArea_m2;
  });
  bg::unique(polygon);
  bg::correct(polygon);
  if (!bg::is_valid(polygon) || bg::area(polygon) < kLeastArea_m2) return std::nullopt;
  return polygon;
}

/// All corridors as areas that do not overlap; nothing when they cannot be drawn so.
std::optional<std::vector<site::Polygon>> united(const std::vector<site::Ring>& corridors) {
  BoostArea area;
  for (const site::Ring& ring : corridors) {
    BoostArea sum;
    bg::union_(area, to_boost(ring), sum);
    area = std::move(sum);
  }
  std::vector<site::Polygon> polygons;
  for (const BoostPolygon& polygon : area) {
    const auto drawn = tidied(polygon);
    if (!drawn) return std::nullopt;
    site::Polygon converted{from_boost(drawn->outer()), {}};
    for (const auto& hole : drawn->inners()) converted.holes.push_back(from_boost(hole));
    polygons.push_back(std::move(converted));
  }
  return polygons;
}

void add_walls(const site::Ring& ring, std::vector<site::Wall>& walls) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    walls.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
}

std::vector<site::Ring> corridors_of(const AdjustedStructure& structure, double width_m) {
  std::vector<site::Ring> corridors;
  for (const StructureEdge& edge : structure.edges) {
    corridors.push_back(corridor(structure.nodes[edge.from].position_m,
                                 structure.nodes[edge.to].position_m, width_m));
  }
  return corridors;
}

/// Whether every centre line can be walked from end to end.
bool holds(const AdjustedStructure& structure, const site::Plan& plan) {
  const site::FloorGeometry geometry(plan);
  return std::ranges::all_of(structure.edges, [&](const StructureEdge& edge) {
    const Vector2& from_m = structure.nodes[edge.from].position_m;
    const Vector2& to_m = structure.nodes[edge.to].position_m;
    return geometry.is_walkable(from_m) && geometry.is_walkable(to_m) &&
           geometry.is_walkable(0.5 * (from_m + to_m)) && !geometry.crosses_wall(from_m, to_m);
  });
}

/// The corridors' common outline, also as walls.
std::optional<site::Plan> outlined(const AdjustedStructure& structure, double width_m) {
  auto polygons = united(corridors_of(structure, width_m));
  if (!polygons || polygons->empty()) return std::nullopt;
  site::Plan plan;
  plan.walkable = *std::move(polygons);
  for (const site::Polygon& polygon : plan.walkable) {
    add_walls(polygon.outer, plan.walls);
    for (const site::Ring& hole : polygon.holes) add_walls(hole, plan.walls);
  }
  return holds(structure, plan) ? std::optional(std::move(plan)) : std::nullopt;
}

/// The union of areas that nearly touch can fail; with other widths they do not nearly touch.
void draw_corridors(const AdjustedStructure& structure, double width_m, site::FloorDraft& draft) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (auto plan = outlined(structure, width_m + attempt * kWidening_m)) {
      draft.floor.plan = *std::move(plan);
      return;
    }
  }
  for (const site::Ring& ring : corridors_of(structure, width_m)) {
    draft.floor.plan.walkable.push_back({from_boost(to_boost(ring).outer()), {}});
  }
  draft.notes.emplace_back(
      "corridors are drawn one by one and without walls: their common outline crosses itself");
}

/// A square around each landmark: a place with a name, no barrier.
void draw_landmarks(const AdjustedStructure& structure, double size_m, site::Plan& plan) {
  const Vector2 half_m = Vector2::Constant(0.5 * size_m);
  for (const StructureNode& node : structure.nodes) {
    if (node.landmark.empty()) continue;
    const Vector2 least_m = node.position_m - half_m;
    const Vector2 most_m = node.position_m + half_m;
    const BoostPolygon square = to_boost(
        {least_m, Vector2(most_m.x(), least_m.y()), most_m, Vector2(least_m.x(), most_m.y())});
    plan.rooms.push_back({node.landmark, {from_boost(square.outer()), {}}});
  }
}

core::Bounds2 bounds_of(const site::Plan& plan) {
  core::Bounds2 bounds{plan.walkable.front().outer.front(), plan.walkable.front().outer.front()};
  const auto take = [&](const site::Ring& ring) {
    for (const Vector2& point_m : ring) {
      bounds.min_m = bounds.min_m.cwiseMin(point_m);
      bounds.max_m = bounds.max_m.cwiseMax(point_m);
    }
  };
  for (const site::Polygon& polygon : plan.walkable) take(polygon.outer);
  for (const site::Room& room : plan.rooms) take(room.outline.outer);
  const Vector2 margin_m = Vector2::Constant(kMargin_m);
  bounds.min_m = (bounds.min_m - margin_m).unaryExpr(&rounded);
  bounds.max_m = (bounds.max_m + margin_m).unaryExpr(&rounded);
  return bounds;
}

}  // namespace

core::Result<void> PlanOptions::validate() const {
  const bool in_range = corridor_width_m >= 0.2 && corridor_width_m <= 50.0 &&
                        landmark_size_m >= 0.1 && landmark_size_m <= 50.0;
  if (!floor.empty() && in_range) return {};
  return core::fail(core::ErrorCode::kInvalidOptions,
                    "need a floor's name, corridors 0.2 to 50 m wide and landmarks of 0.1 to 50 m",
                    "structure plan");
}

core::Result<site::FloorDraft> to_plan(const AdjustedStructure& structure,
                                       const PlanOptions& options) {
  if (auto checked = options.validate(); !checked) return tl::unexpected(checked.error());
  if (structure.edges.empty()) {
    return core::fail(core::ErrorCode::kSurveyInsufficient,
                      "the structure has no corridor to draw; adjust some walks first");
  }
  site::FloorDraft draft = site::bare_floor(options.floor, {});
  draw_corridors(structure, options.corridor_width_m, draft);
  draw_landmarks(structure, options.landmark_size_m, draft.floor.plan);
  draft.floor.bounds = bounds_of(draft.floor.plan);
  if (!structure.scale_known) {
    draft.notes.emplace_back("the plan's scale is not known; measure a distance to fix it");
  }
  return draft;
}

}  // namespace waylode::structure
