// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/plan_features.hpp"

#include <cmath>
#include <utility>

#include "waylode/site/connectors.hpp"
#include "waylode/site/detail/json_text.hpp"
#include "waylode/site/detail/polygon_check.hpp"

namespace waylode::site::detail {
namespace {

using core::Vector2;
using nlohmann::json;
template <typename T>
using Parsed = tl::expected<T, std::string>;

/// How far a vertex may lie outside the bounds: the format's resolution.
constexpr double kBoundsSlack_m = 0.001;
constexpr double kMaxDoor_m = 100.0;
constexpr double kMaxLevel = 1'000.0;

tl::unexpected<std::string> refuse(std::string message) {
  return tl::unexpected<std::string>(std::move(message));
}

Parsed<Ring> parse_line(const json& value, const core::Bounds2& bounds) {
  if (!value.is_array()) return refuse("coordinates are no list of positions; correct them");
  const Vector2 slack = Vector2::Constant(kBoundsSlack_m);
  Ring line;
  for (const json& entry : value) {
    const auto position = parse_position(entry);
    if (!position) return tl::unexpected(position.error());
    if (!core::Bounds2{bounds.min_m - slack, bounds.max_m + slack}.contains(*position)) {
      return refuse("a position lies outside bounds_m; correct it or widen the bounds");
    }
    line.push_back(*position);
  }
  return line;
}

Parsed<Polygon> parse_polygon(const json& value, const core::Bounds2& bounds) {
  if (!value.is_array() || value.empty()) return refuse("a polygon has no ring; draw one");
  Polygon polygon;
  for (std::size_t i = 0; i < value.size(); ++i) {
    auto ring = parse_line(value[i], bounds);
    if (!ring) return tl::unexpected(ring.error());
    if (ring->size() < 4) return refuse("a ring has fewer than four positions; add some");
    if (ring->front() != ring->back()) {
      return refuse("a ring is open; repeat its first position at its end");
    }
    ring->pop_back();
    if (i == 0) {
      polygon.outer = std::move(*ring);
    } else {
      polygon.holes.push_back(std::move(*ring));
    }
  }
  tidy(polygon);
  const std::string defect = defect_of(polygon);
  if (!defect.empty()) return refuse("a polygon " + defect + "; draw it again");
  return polygon;
}

Parsed<std::vector<Polygon>> parse_polygons(const std::string& type, const json& coordinates,
                                            const core::Bounds2& bounds) {
  std::vector<Polygon> polygons;
  const json single = type == "Polygon" ? json::array({coordinates}) : json();
  const json& list = type == "Polygon" ? single : coordinates;
  if (type != "Polygon" && type != "MultiPolygon") {
    return refuse("an area must be a Polygon or MultiPolygon; change its geometry");
  }
  if (!list.is_array() || list.empty()) return refuse("an area has no polygon; draw one");
  for (const json& entry : list) {
    auto polygon = parse_polygon(entry, bounds);
    if (!polygon) return tl::unexpected(polygon.error());
    polygons.push_back(std::move(*polygon));
  }
  return polygons;
}

Parsed<void> add_walls(const json& line, const core::Bounds2& bounds, std::vector<Wall>& walls) {
  const auto positions = parse_line(line, bounds);
  if (!positions) return tl::unexpected(positions.error());
  if (positions->size() < 2) return refuse("a wall has fewer than two positions; add some");
  for (std::size_t i = 1; i < positions->size(); ++i) {
    if ((*positions)[i - 1] == (*positions)[i]) {
      return refuse("a wall repeats a position; remove one of them");
    }
    walls.push_back({(*positions)[i - 1], (*positions)[i]});
  }
  return {};
}

Parsed<void> add_wall_feature(const std::string& type, const json& coordinates,
                              const core::Bounds2& bounds, std::vector<Wall>& walls) {
  if (type == "LineString") return add_walls(coordinates, bounds, walls);
  if (type != "MultiLineString" || !coordinates.is_array()) {
    return refuse("a wall must be a LineString or MultiLineString; change its geometry");
  }
  for (const json& line : coordinates) {
    if (auto added = add_walls(line, bounds, walls); !added) return added;
  }
  return {};
}

Parsed<Vector2> parse_place(const std::string& type, const json& coordinates,
                            const core::Bounds2& bounds) {
  if (type != "Point") return refuse("a connector must be a Point; change its geometry");
  const auto line = parse_line(json::array({coordinates}), bounds);
  if (!line) return tl::unexpected(line.error());
  return line->front();
}

/// A Point with a width, or a LineString from jamb to jamb.
Parsed<void> add_door(const std::string& type, const json& coordinates, const json* properties,
                      const core::Bounds2& bounds, std::vector<Door>& doors) {
  const bool is_point = type == "Point";
  if (!is_point && type != "LineString") {
    return refuse("a door must be a Point or LineString; change its geometry");
  }
  const auto jambs = parse_line(is_point ? json::array({coordinates}) : coordinates, bounds);
  if (!jambs) return tl::unexpected(jambs.error());
  if (is_point) {
    const json* width = find_member(*properties, "width_m");
    const double width_m = width != nullptr && width->is_number() ? width->get<double>() : 0.0;
    if (!(width_m > 0.0) || !(width_m <= kMaxDoor_m)) {
      return refuse("a door has no width_m above 0 and up to 100; give it one");
    }
    doors.push_back({jambs->front(), width_m});
    return {};
  }
  if (jambs->size() != 2)
    return refuse("a door's line has not two positions; draw it jamb to jamb");
  const double width_m = (jambs->back() - jambs->front()).norm();
  if (!(width_m > 0.0) || !(width_m <= kMaxDoor_m)) {
    return refuse("a door is not above 0 and up to 100 m wide; draw it again");
  }
  doors.push_back({0.5 * (jambs->front() + jambs->back()), width_m});
  return {};
}

Parsed<std::vector<int>> parse_levels(const json* properties) {
  const json* value = find_member(*properties, "levels");
  std::vector<int> levels;
  if (value == nullptr) return levels;
  if (!value->is_array()) return refuse("levels is no list of integers; correct it");
  for (const json& level : *value) {
    const double read = level.is_number_integer() ? level.get<double>() : std::nan("");
    if (!(std::abs(read) <= kMaxLevel)) {
      return refuse("levels is no list of integers within +-1000; correct it");
    }
    levels.push_back(static_cast<int>(read));
  }
  return levels;
}

std::string text_member(const json* object, const char* key) {
  const json* value = object != nullptr ? find_member(*object, key) : nullptr;
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

Parsed<void> add_connector(ConnectorKind kind, const std::string& type, const json& coordinates,
                           const json* properties, const core::Bounds2& bounds,
                           std::vector<Connector>& connectors) {
  const auto place_m = parse_place(type, coordinates, bounds);
  if (!place_m) return tl::unexpected(place_m.error());
  auto levels = parse_levels(properties);
  if (!levels) return tl::unexpected(levels.error());
  connectors.push_back({kind, text_member(properties, "name"), *place_m, *std::move(levels)});
  return {};
}

Parsed<void> add_area(const std::string& kind, const std::string& name,
                      std::vector<Polygon> polygons, Plan& plan) {
  if (kind == "room") {
    if (name.empty()) return refuse("a room has no name; give it one");
    if (polygons.size() != 1) return refuse("a room must be one Polygon; split it");
    plan.rooms.push_back({name, std::move(polygons.front())});
    return {};
  }
  auto& areas = kind == "walkable" ? plan.walkable : plan.obstacles;
  for (Polygon& polygon : polygons) areas.push_back(std::move(polygon));
  return {};
}

}  // namespace

tl::expected<Vector2, std::string> parse_position(const json& value) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    return refuse("a position is not [x, y] in numbers; correct it");
  }
  return Vector2(value[0].get<double>(), value[1].get<double>());
}

tl::expected<void, std::string> add_feature(const json& feature, const core::Bounds2& bounds,
                                            Plan& plan) {
  const json* geometry = find_member(feature, "geometry");
  const json* coordinates = geometry != nullptr ? find_member(*geometry, "coordinates") : nullptr;
  if (coordinates == nullptr) return refuse("no geometry with coordinates; draw one or delete it");
  const std::string type = text_member(geometry, "type");
  const json* properties = find_member(feature, "properties");
  const std::string kind = text_member(properties, "kind");
  if (kind == "wall") return add_wall_feature(type, *coordinates, bounds, plan.walls);
  if (kind == "door") return add_door(type, *coordinates, properties, bounds, plan.doors);
  if (const auto connector = connector_kind(kind)) {
    return add_connector(*connector, type, *coordinates, properties, bounds, plan.connectors);
  }
  if (kind != "walkable" && kind != "obstacle" && kind != "room") {
    return refuse(
        "kind is not walkable, obstacle, wall, room, door, stairs, lift, escalator or ramp; set "
        "properties.kind");
  }
  auto polygons = parse_polygons(type, *coordinates, bounds);
  if (!polygons) return tl::unexpected(polygons.error());
  return add_area(kind, text_member(properties, "name"), std::move(*polygons), plan);
}

}  // namespace waylode::site::detail
