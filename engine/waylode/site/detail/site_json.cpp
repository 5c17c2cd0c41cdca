// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/site_json.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "waylode/site/connectors.hpp"
#include "waylode/site/detail/json_text.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site::detail {
namespace {

using core::Affine2;
using core::ErrorCode;
using core::Vector2;
using nlohmann::json;

constexpr double kMinDeterminant = 1e-6;

json to_json(const Vector2& point) { return json::array({point.x(), point.y()}); }

json to_json(const Ring& ring) {
  json list = json::array();
  for (const Vector2& vertex : ring) list.push_back(to_json(vertex));
  return list;
}

/// The outer ring, then the holes.
json to_json(const Polygon& polygon) {
  json rings = json::array({to_json(polygon.outer)});
  for (const Ring& hole : polygon.holes) rings.push_back(to_json(hole));
  return rings;
}

json to_json(const std::vector<Polygon>& polygons) {
  json list = json::array();
  for (const Polygon& polygon : polygons) list.push_back(to_json(polygon));
  return list;
}

json to_json(const std::vector<Door>& doors) {
  json list = json::array();
  for (const Door& door : doors) {
    list.push_back({door.position_m.x(), door.position_m.y(), door.width_m});
  }
  return list;
}

json to_json(const std::vector<Connector>& connectors) {
  json list = json::array();
  for (const Connector& connector : connectors) {
    list.push_back({{"kind", name_of(connector.kind)},
                    {"name", connector.name},
                    {"position_m", to_json(connector.position_m)},
                    {"levels", connector.levels}});
  }
  return list;
}

json to_json(const Plan& plan) {
  json walls = json::array();
  for (const Wall& wall : plan.walls) {
    walls.push_back({wall.from_m.x(), wall.from_m.y(), wall.to_m.x(), wall.to_m.y()});
  }
  json rooms = json::array();
  for (const Room& room : plan.rooms) {
    rooms.push_back({{"name", room.name}, {"outline_m", to_json(room.outline)}});
  }
  json document = {{"walkable_m", to_json(plan.walkable)},
                   {"obstacles_m", to_json(plan.obstacles)},
                   {"walls_m", std::move(walls)},
                   {"rooms", std::move(rooms)}};
  // Not in format 1: a plan without them stays readable for programs that know no other.
  if (!plan.doors.empty()) document["doors"] = to_json(plan.doors);
  if (!plan.connectors.empty()) document["connectors"] = to_json(plan.connectors);
  return document;
}

json to_json(const Affine2& map) {
  return {map.linear(0, 0), map.linear(0, 1),      map.linear(1, 0),
          map.linear(1, 1), map.translation_m.x(), map.translation_m.y()};
}

json to_json(const Floor& floor) {
  return {{"name", floor.name},
          {"level", floor.level},
          {"elevation_m", floor.elevation_m},
          {"bounds_m", json::array({to_json(floor.bounds.min_m), to_json(floor.bounds.max_m)})},
          {"site_from_floor", to_json(floor.site_from_floor)},
          {"heading_offset_rad", floor.heading_offset_rad},
          {"plan", to_json(floor.plan)}};
}

// The readers throw json::exception or Unusable; parse_site_json turns both into an Error.
struct Unusable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

double number(const json& value) {
  const double read = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(read)) throw Unusable("a value is no finite number");
  return read;
}

int integer(const json& value) {
  const double read = number(value);
  if (!value.is_number_integer() || std::abs(read) > std::numeric_limits<int>::max()) {
    throw Unusable("a value is no usable integer");
  }
  return value.get<int>();
}

const json& list_of(const json& value, std::size_t size) {
  if (!value.is_array() || value.size() != size) throw Unusable("a list has not its length");
  return value;
}

const json& list(const json& value) {
  if (!value.is_array()) throw Unusable("a value is no list");
  return value;
}

Vector2 point(const json& value) {
  list_of(value, 2);
  return {number(value[0]), number(value[1])};
}

Ring ring(const json& value) {
  Ring read;
  for (const json& vertex : list(value)) read.push_back(point(vertex));
  return read;
}

Polygon polygon(const json& value) {
  if (list(value).empty()) throw Unusable("a polygon has no ring");
  Polygon read;
  read.outer = ring(value[0]);
  for (std::size_t i = 1; i < value.size(); ++i) read.holes.push_back(ring(value[i]));
  return read;
}

std::vector<Polygon> polygons(const json& value) {
  std::vector<Polygon> read;
  for (const json& entry : list(value)) read.push_back(polygon(entry));
  return read;
}

Door door(const json& value) {
  list_of(value, 3);
  const Door read{{number(value[0]), number(value[1])}, number(value[2])};
  if (!(read.width_m > 0.0)) throw Unusable("a door has no width");
  return read;
}

Connector connector(const json& value) {
  const auto kind = connector_kind(value.at("kind").get_ref<const std::string&>());
  if (!kind) throw Unusable("a connector is of no known kind");
  Connector read{*kind, value.at("name").get<std::string>(), point(value.at("position_m")), {}};
  for (const json& level : list(value.at("levels"))) read.levels.push_back(integer(level));
  return read;
}

Plan plan(const json& value) {
  Plan read;
  read.walkable = polygons(value.at("walkable_m"));
  read.obstacles = polygons(value.at("obstacles_m"));
  for (const json& wall : list(value.at("walls_m"))) {
    list_of(wall, 4);
    read.walls.push_back(
        {Vector2(number(wall[0]), number(wall[1])), Vector2(number(wall[2]), number(wall[3]))});
  }
  for (const json& room : list(value.at("rooms"))) {
    read.rooms.push_back({room.at("name").get<std::string>(), polygon(room.at("outline_m"))});
  }
  if (value.contains("doors")) {
    for (const json& entry : list(value["doors"])) read.doors.push_back(door(entry));
  }
  if (value.contains("connectors")) {
    for (const json& entry : list(value["connectors"])) {
      read.connectors.push_back(connector(entry));
    }
  }
  return read;
}

Affine2 affine(const json& value) {
  list_of(value, 6);
  Affine2 read;
  read.linear << number(value[0]), number(value[1]), number(value[2]), number(value[3]);
  read.translation_m = Vector2(number(value[4]), number(value[5]));
  if (!(std::abs(read.linear.determinant()) > kMinDeterminant)) {
    throw Unusable("a floor's frame cannot be inverted");
  }
  return read;
}

Floor floor(const json& value) {
  Floor read;
  read.name = value.at("name").get<std::string>();
  read.level = integer(value.at("level"));
  read.elevation_m = number(value.at("elevation_m"));
  const json& bounds = list_of(value.at("bounds_m"), 2);
  read.bounds = {point(bounds[0]), point(bounds[1])};
  read.site_from_floor = affine(value.at("site_from_floor"));
  read.heading_offset_rad = number(value.at("heading_offset_rad"));
  read.plan = plan(value.at("plan"));
  return read;
}

SiteParts parts_of(const json& value) {
  SiteParts read;
  read.name = value.at("name").get<std::string>();
  const json& origin = value.at("origin");
  if (!origin.is_null()) {
    read.origin = {number(origin.at("latitude_deg")), number(origin.at("longitude_deg"))};
    if (!is_valid_geo_point(*read.origin)) throw Unusable("the origin is no position on Earth");
  }
  std::set<std::string> names;
  for (const json& entry : list(value.at("floors"))) {
    read.floors.push_back(floor(entry));
    if (!names.insert(read.floors.back().name).second) throw Unusable("two floors share a name");
  }
  if (read.floors.size() > std::numeric_limits<std::uint16_t>::max()) {
    throw Unusable("there are more than 65535 floors");
  }
  return read;
}

}  // namespace

core::Result<std::string> format_site_json(const SiteParts& parts) {
  json floors = json::array();
  for (const Floor& floor : parts.floors) floors.push_back(to_json(floor));
  json origin = nullptr;
  if (parts.origin) {
    origin = {{"latitude_deg", parts.origin->latitude_deg},
              {"longitude_deg", parts.origin->longitude_deg}};
  }
  const json document = {
      {"name", parts.name}, {"origin", std::move(origin)}, {"floors", std::move(floors)}};
  try {
    return document.dump();
  } catch (const json::type_error&) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "a site, floor, room or connector name is not UTF-8; rename it", parts.name);
  }
}

core::Result<SiteParts> parse_site_json(std::string_view text, std::string_view place) {
  const auto document = parse_json(text, place, ErrorCode::kBundleCorrupt);
  if (!document) return tl::unexpected(document.error());
  std::string defect = "a member is missing or of another kind";
  try {
    return parts_of(*document);
  } catch (const json::exception&) {
    // The default words above: the library's own name bytes of its source, not of ours.
  } catch (const Unusable& unusable) {
    defect = unusable.what();
  }
  return core::fail(ErrorCode::kBundleCorrupt,
                    defect + "; build the site again with `waylode site build`",
                    std::string(place));
}

}  // namespace waylode::site::detail
