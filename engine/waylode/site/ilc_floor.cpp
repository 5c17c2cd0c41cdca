// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <set>

#include "waylode/site/detail/json_text.hpp"
#include "waylode/site/detail/polygon_check.hpp"
#include "waylode/site/detail/wall_edges.hpp"
#include "waylode/site/frame_fit.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::ErrorCode;
using core::Result;
using core::Vector2;
using detail::find_member;
using nlohmann::json;

constexpr double kMaxFloorSize_m = 100'000.0;

tl::unexpected<core::Error> invalid(std::string message, std::string place) {
  return core::fail(ErrorCode::kPlanInvalid, std::move(message), std::move(place));
}

/// One feature's polygons, vertices as (longitude, latitude) in degrees until scaled.
struct Area {
  std::size_t feature = 0;
  bool is_outline = false;
  std::vector<Polygon> polygons;
};

/// Empty when `value` is no list of at least three distinct positions.
Ring parse_ring(const json& value) {
  Ring ring;
  if (!value.is_array()) return {};
  for (const json& position : value) {
    if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
        !position[1].is_number()) {
      return {};
    }
    ring.emplace_back(position[0].get<double>(), position[1].get<double>());
    if (!is_valid_geo_point({ring.back().y(), ring.back().x()})) return {};
  }
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring.size() >= 3 ? ring : Ring{};
}

std::optional<Polygon> parse_polygon(const json& rings) {
  if (!rings.is_array() || rings.empty()) return std::nullopt;
  Polygon polygon;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    Ring ring = parse_ring(rings[i]);
    if (ring.empty()) return std::nullopt;
    if (i == 0) {
      polygon.outer = std::move(ring);
    } else {
      polygon.holes.push_back(std::move(ring));
    }
  }
  return polygon;
}

bool has_text(const json* properties, const char* key, std::string_view text) {
  const json* value = properties != nullptr ? find_member(*properties, key) : nullptr;
  return value != nullptr && value->is_string() && value->get_ref<const std::string&>() == text;
}

/// nullopt for a feature that is no area at all.
std::optional<Area> parse_area(const json& feature) {
  const json* geometry = find_member(feature, "geometry");
  const json* coordinates = geometry != nullptr ? find_member(*geometry, "coordinates") : nullptr;
  if (coordinates == nullptr || !coordinates->is_array()) return std::nullopt;
  const json* properties = find_member(feature, "properties");
  Area area;
  const bool several = has_text(geometry, "type", "MultiPolygon");
  if (!several && !has_text(geometry, "type", "Polygon")) return std::nullopt;
  area.is_outline = several || has_text(properties, "category", "floor");
  if (!several) {
    if (auto polygon = parse_polygon(*coordinates)) area.polygons.push_back(std::move(*polygon));
  } else {
    for (const json& rings : *coordinates) {
      if (auto polygon = parse_polygon(rings)) area.polygons.push_back(std::move(*polygon));
    }
  }
  if (area.polygons.empty()) return std::nullopt;
  return area;
}

Result<std::vector<Area>> parse_areas(std::string_view geojson, const std::string& place,
                                      std::vector<std::string>& notes) {
  const auto document = detail::parse_json(geojson, place, ErrorCode::kPlanInvalid);
  if (!document) return tl::unexpected(document.error());
  const json* features = find_member(*document, "features");
  if (features == nullptr || !features->is_array()) {
    return invalid("no GeoJSON features; give the floor's own geojson_map.json", place);
  }
  std::vector<Area> areas;
  for (std::size_t i = 0; i < features->size(); ++i) {
    auto area = parse_area((*features)[i]);
    if (area) {
      area->feature = i;
      areas.push_back(std::move(*area));
    } else {
      notes.push_back("feature " + std::to_string(i) + " is no polygon; left out");
    }
  }
  if (areas.empty()) return invalid("no polygon in the drawing; give another plan", place);
  return areas;
}

/// The longitude/latitude box of the outline; of everything when no outline is drawn. On the
/// competition's floors the units reach past the outline by at most 0.06 m, and fall short of it
/// by up to 5 m.
core::Bounds2 geographic_box(const std::vector<Area>& areas) {
  bool any_outline = false;
  for (const Area& area : areas) any_outline = any_outline || area.is_outline;
  core::Bounds2 box{Vector2(360.0, 360.0), Vector2(-360.0, -360.0)};
  for (const Area& area : areas) {
    if (any_outline && !area.is_outline) continue;
    for (const Polygon& polygon : area.polygons) {
      for (const Vector2& vertex : polygon.outer) {
        box.min_m = box.min_m.cwiseMin(vertex);
        box.max_m = box.max_m.cwiseMax(vertex);
      }
    }
  }
  return box;
}

void scale(Ring& ring, const core::Bounds2& box_deg, const Vector2& size_m) {
  for (Vector2& vertex : ring) {
    vertex = (vertex - box_deg.min_m).cwiseQuotient(box_deg.size_m()).cwiseProduct(size_m);
  }
}

/// Areas in floor metres go into the plan, unsound ones into the notes.
void fill_plan(std::vector<Area> areas, const core::Bounds2& box_deg, FloorDraft& draft) {
  Plan& plan = draft.floor.plan;
  const Vector2 size_m = draft.floor.bounds.size_m();
  for (Area& area : areas) {
    for (Polygon& polygon : area.polygons) {
      scale(polygon.outer, box_deg, size_m);
      for (Ring& hole : polygon.holes) scale(hole, box_deg, size_m);
      detail::tidy(polygon);
      const std::string defect = detail::defect_of(polygon);
      if (!defect.empty()) {
        draft.notes.push_back("feature " + std::to_string(area.feature) + " " + defect +
                              "; left out");
        continue;
      }
      (area.is_outline ? plan.walkable : plan.obstacles).push_back(std::move(polygon));
    }
  }
  plan.walls = detail::edges_of(plan);
}

/// Fits floor metres to the tangent plane at the box's centre.
bool georeference(const core::Bounds2& box_deg, FloorDraft& draft) {
  const Vector2 centre_deg = 0.5 * (box_deg.min_m + box_deg.max_m);
  draft.origin = core::GeoPoint{centre_deg.y(), centre_deg.x()};
  const Vector2 size_m = draft.floor.bounds.size_m();
  std::array<Vector2, 4> floor_m;
  std::array<Vector2, 4> enu_m;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 share(i == 1 || i == 2 ? 1.0 : 0.0, i >= 2 ? 1.0 : 0.0);
    const Vector2 corner_deg = box_deg.min_m + share.cwiseProduct(box_deg.size_m());
    floor_m[i] = share.cwiseProduct(size_m);
    enu_m[i] = enu_from_geo(*draft.origin, {corner_deg.y(), corner_deg.x()});
  }
  const auto fitted = fit_affine(floor_m, enu_m);
  if (fitted) draft.enu_from_floor = *fitted;
  return fitted.has_value();
}

}  // namespace

Result<core::Bounds2> parse_ilc_floor_size(std::string_view floor_info_json,
                                           std::string_view place) {
  const auto document = detail::parse_json(floor_info_json, place, ErrorCode::kPlanInvalid);
  if (!document) return tl::unexpected(document.error());
  const json* map_info = find_member(*document, "map_info");
  const json* width = map_info != nullptr ? find_member(*map_info, "width") : nullptr;
  const json* height = map_info != nullptr ? find_member(*map_info, "height") : nullptr;
  if (width == nullptr || height == nullptr || !width->is_number() || !height->is_number()) {
    return invalid("no map_info with width and height in metres; add them", std::string(place));
  }
  const Vector2 size_m(width->get<double>(), height->get<double>());
  if (!(size_m.minCoeff() > 0.0) || !(size_m.maxCoeff() < kMaxFloorSize_m)) {
    return invalid("the floor's width or height is no usable length in metres; correct it",
                   std::string(place));
  }
  return core::Bounds2{Vector2::Zero(), size_m};
}

Result<FloorDraft> parse_ilc_floor(std::string_view geojson, std::string_view floor_info_json,
                                   std::string_view floor_name, std::string_view place) {
  const std::string place_text(place);
  const auto bounds = parse_ilc_floor_size(floor_info_json, place_text + " (floor_info.json)");
  if (!bounds) return tl::unexpected(bounds.error());
  FloorDraft draft = bare_floor(floor_name, *bounds);
  auto areas = parse_areas(geojson, place_text, draft.notes);
  if (!areas) return tl::unexpected(areas.error());
  const core::Bounds2 box_deg = geographic_box(*areas);
  if (!(box_deg.size_m().minCoeff() > 0.0) || !georeference(box_deg, draft)) {
    return invalid("the drawing has no extent; give another plan", place_text);
  }
  fill_plan(std::move(*areas), box_deg, draft);
  return draft;
}

}  // namespace waylode::site
