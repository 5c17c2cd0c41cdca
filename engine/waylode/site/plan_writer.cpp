// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "waylode/site/connectors.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::Vector2;
// Members in the order a reader expects them.
using Json = nlohmann::ordered_json;

/// 0.1 mm, in metres and in degrees.
double round_metres(double value_m) { return std::round(value_m * 1e4) / 1e4; }
double round_degrees(double value_deg) { return std::round(value_deg * 1e9) / 1e9; }

Json to_json(const Vector2& point_m) {
  return Json::array({round_metres(point_m.x()), round_metres(point_m.y())});
}

Json ring_to_json(const Ring& ring) {
  Json positions = Json::array();
  for (const Vector2& vertex : ring) positions.push_back(to_json(vertex));
  if (!ring.empty()) positions.push_back(to_json(ring.front()));
  return positions;
}

Json polygon_to_json(const Polygon& polygon) {
  Json rings = Json::array({ring_to_json(polygon.outer)});
  for (const Ring& hole : polygon.holes) rings.push_back(ring_to_json(hole));
  return rings;
}

Json feature(Json properties, const char* type, Json coordinates) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}}};
}

Json control_points(const FloorDraft& draft) {
  const core::Bounds2& bounds = draft.floor.bounds;
  Json points = Json::array();
  for (const Vector2& corner_m : {bounds.min_m, Vector2(bounds.max_m.x(), bounds.min_m.y()),
                                  bounds.max_m, Vector2(bounds.min_m.x(), bounds.max_m.y())}) {
    const core::GeoPoint geo = geo_from_enu(*draft.origin, draft.enu_from_floor * corner_m);
    points.push_back({{"floor_m", to_json(corner_m)},
                      {"wgs84", Json::array({round_degrees(geo.longitude_deg),
                                             round_degrees(geo.latitude_deg)})}});
  }
  return points;
}

Json head(const FloorDraft& draft) {
  const Floor& floor = draft.floor;
  Json members = {
      // The oldest that holds the plan.
      {"format_version", floor.plan.doors.empty() && floor.plan.connectors.empty() ? 1 : 2},
      {"floor", floor.name},
      {"level", floor.level},
      {"elevation_m", floor.elevation_m},
      {"bounds_m", Json::array({to_json(floor.bounds.min_m), to_json(floor.bounds.max_m)})}};
  if (draft.origin) members["control_points"] = control_points(draft);
  return members;
}

Json to_feature(const Connector& connector) {
  Json properties = {{"kind", name_of(connector.kind)}};
  if (!connector.name.empty()) properties["name"] = connector.name;
  if (!connector.levels.empty()) properties["levels"] = connector.levels;
  return feature(std::move(properties), "Point", to_json(connector.position_m));
}

std::vector<Json> features(const Plan& plan) {
  std::vector<Json> list;
  for (const Polygon& polygon : plan.walkable) {
    list.push_back(feature({{"kind", "walkable"}}, "Polygon", polygon_to_json(polygon)));
  }
  for (const Polygon& polygon : plan.obstacles) {
    list.push_back(feature({{"kind", "obstacle"}}, "Polygon", polygon_to_json(polygon)));
  }
  for (const Room& room : plan.rooms) {
    list.push_back(
        feature({{"kind", "room"}, {"name", room.name}}, "Polygon", polygon_to_json(room.outline)));
  }
  if (!plan.walls.empty()) {
    Json lines = Json::array();
    for (const Wall& wall : plan.walls) {
      lines.push_back(Json::array({to_json(wall.from_m), to_json(wall.to_m)}));
    }
    list.push_back(feature({{"kind", "wall"}}, "MultiLineString", std::move(lines)));
  }
  for (const Door& door : plan.doors) {
    list.push_back(feature({{"kind", "door"}, {"width_m", round_metres(door.width_m)}}, "Point",
                           to_json(door.position_m)));
  }
  for (const Connector& connector : plan.connectors) list.push_back(to_feature(connector));
  return list;
}

/// Bytes that are not UTF-8 become the replacement character: a name never stops a plan.
std::string dump(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string format_plan(const FloorDraft& draft) {
  std::string text = "{\"type\": \"FeatureCollection\",\n\"waylode\": " + dump(head(draft));
  text += ",\n\"features\": [";
  const char* separator = "\n";
  for (const Json& entry : features(draft.floor.plan)) {
    text += separator + dump(entry);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace waylode::site
