// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "waylode/site/detail/json_text.hpp"
#include "waylode/site/detail/plan_features.hpp"
#include "waylode/site/frame_fit.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::Result;
using core::Vector2;
using detail::find_member;
using nlohmann::json;

constexpr int kPlanFormatVersion = 2;
constexpr double kMaxCoordinate_m = 100'000.0;
constexpr double kMaxElevation_m = 10'000.0;
constexpr int kMaxLevel = 1'000;
/// Control points disagree with the floor's metres or with each other beyond these.
constexpr double kMaxStretch_ratio = 1.25;
constexpr double kMaxResidual_m = 10.0;

struct ControlPoint {
  Vector2 floor_m;
  core::GeoPoint geo;
};

tl::unexpected<core::Error> invalid(std::string message, std::string place) {
  return core::fail(core::ErrorCode::kPlanInvalid, std::move(message), std::move(place));
}

Result<void> check_members(const json& head, const std::string& place) {
  constexpr std::array kKnown = {"format_version", "floor",    "level",
                                 "elevation_m",    "bounds_m", "control_points"};
  for (const auto& [key, value] : head.items()) {
    if (std::ranges::find(kKnown, key) == kKnown.end()) {
      return invalid("unknown member " + key + "; remove it or correct its name", place);
    }
  }
  const json* version = find_member(head, "format_version");
  if (version == nullptr || !version->is_number_integer()) {
    return invalid("no format_version; set it to 2", place);
  }
  if (*version < 1 || *version > kPlanFormatVersion) {
    return invalid("format_version is not 1 or 2; use a newer waylode or set it to 2", place);
  }
  return {};
}

/// The optional number, or `fallback`; an error when it is no number within +-limit.
Result<double> parse_limited(const json& head, const char* key, double fallback, double limit,
                             const std::string& place) {
  const json* value = find_member(head, key);
  if (value == nullptr) return fallback;
  if (!value->is_number() || !(std::abs(value->get<double>()) <= limit)) {
    return invalid(std::string(key) + " is no usable number; correct or remove it", place);
  }
  return value->get<double>();
}

Result<core::Bounds2> parse_bounds(const json& head, const std::string& place) {
  const json* value = find_member(head, "bounds_m");
  if (value == nullptr || !value->is_array() || value->size() != 2) {
    return invalid("no bounds_m; set it to [[least x, least y], [greatest x, greatest y]]", place);
  }
  const auto least = detail::parse_position((*value)[0]);
  const auto greatest = detail::parse_position((*value)[1]);
  if (!least || !greatest) return invalid("bounds_m are no two positions; correct them", place);
  const core::Bounds2 bounds{*least, *greatest};
  if (!(bounds.size_m().minCoeff() > 0.0) ||
      !(bounds.min_m.cwiseAbs().cwiseMax(bounds.max_m.cwiseAbs()).maxCoeff() <= kMaxCoordinate_m)) {
    return invalid("bounds_m enclose nothing or too much; put the lesser corner first, in metres",
                   place);
  }
  return bounds;
}

Result<std::vector<ControlPoint>> parse_control_points(const json& value,
                                                       const std::string& place) {
  if (!value.is_array() || value.size() < 2) {
    return invalid("fewer than two control points; add some or remove control_points", place);
  }
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string here = place + " control point " + std::to_string(i);
    const json* floor_m = find_member(value[i], "floor_m");
    const json* wgs84 = find_member(value[i], "wgs84");
    if (floor_m == nullptr || wgs84 == nullptr) {
      return invalid("lacks floor_m or wgs84; give both", here);
    }
    const auto position = detail::parse_position(*floor_m);
    const auto lon_lat = detail::parse_position(*wgs84);
    if (!position || !lon_lat || !(position->cwiseAbs().maxCoeff() <= kMaxCoordinate_m)) {
      return invalid("floor_m or wgs84 is no usable pair of numbers; correct it", here);
    }
    points.push_back({*position, {lon_lat->y(), lon_lat->x()}});
    if (!is_valid_geo_point(points.back().geo)) {
      return invalid("wgs84 is not [longitude, latitude] in degrees; correct it", here);
    }
  }
  return points;
}

/// Two points give a similarity, more the least-squares affine map.
std::optional<core::Affine2> fit(const std::vector<ControlPoint>& points,
                                 const core::GeoPoint& origin) {
  std::vector<Vector2> floor_m;
  std::vector<Vector2> enu_m;
  for (const ControlPoint& point : points) {
    floor_m.push_back(point.floor_m);
    enu_m.push_back(enu_from_geo(origin, point.geo));
  }
  if (points.size() == 2) {
    return fit_similarity({floor_m[0], floor_m[1]}, {enu_m[0], enu_m[1]});
  }
  return fit_affine(floor_m, enu_m);
}

Result<void> check_fit(const core::Affine2& enu_from_floor, const core::GeoPoint& origin,
                       const std::vector<ControlPoint>& points, const std::string& place) {
  const Eigen::SelfAdjointEigenSolver<core::Matrix2> squares(enu_from_floor.linear.transpose() *
                                                             enu_from_floor.linear);
  const double least = std::sqrt(std::max(0.0, squares.eigenvalues()(0)));
  const double greatest = std::sqrt(squares.eigenvalues()(1));
  if (!(least >= 1.0 / kMaxStretch_ratio) || !(greatest <= kMaxStretch_ratio) ||
      !(enu_from_floor.linear.determinant() > 0.0)) {
    return invalid(
        "control points do not fit the floor's metres (stretched or mirrored); correct them",
        place);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2 expected_m = enu_from_geo(origin, points[i].geo);
    if (!((enu_from_floor * points[i].floor_m - expected_m).norm() <= kMaxResidual_m)) {
      return invalid("lies more than 10 m from where the others put it; correct it",
                     place + " control point " + std::to_string(i));
    }
  }
  return {};
}

/// Sets the draft's origin at the bounds' centre and its affine map there.
Result<void> georeference(const json& value, const std::string& place, FloorDraft& draft) {
  const auto points = parse_control_points(value, place);
  if (!points) return tl::unexpected(points.error());
  const auto rough = fit(*points, points->front().geo);
  if (!rough) {
    return invalid("control points coincide or lie on one line; move one off the line", place);
  }
  if (auto checked = check_fit(*rough, points->front().geo, *points, place); !checked) {
    return checked;
  }
  const Vector2 centre_m = 0.5 * (draft.floor.bounds.min_m + draft.floor.bounds.max_m);
  draft.origin = geo_from_enu(points->front().geo, *rough * centre_m);
  const auto fitted = fit(*points, *draft.origin);
  if (!fitted) return invalid("control points lie too far away; correct them", place);
  draft.enu_from_floor = *fitted;
  return check_fit(*fitted, *draft.origin, *points, place);
}

Result<FloorDraft> parse_head(const json& head, const std::string& place) {
  if (auto checked = check_members(head, place); !checked) {
    return tl::unexpected(checked.error());
  }
  const json* name = find_member(head, "floor");
  if (name == nullptr || !name->is_string() || name->get_ref<const std::string&>().empty()) {
    return invalid("no floor; give the floor's name", place);
  }
  const auto bounds = parse_bounds(head, place);
  if (!bounds) return tl::unexpected(bounds.error());
  FloorDraft draft = bare_floor(name->get_ref<const std::string&>(), *bounds);
  const auto level = parse_limited(head, "level", draft.floor.level, kMaxLevel, place);
  if (!level) return tl::unexpected(level.error());
  if (*level != std::floor(*level)) return invalid("level is no integer; correct it", place);
  draft.floor.level = static_cast<int>(*level);
  const auto elevation_m = parse_limited(head, "elevation_m", 0.0, kMaxElevation_m, place);
  if (!elevation_m) return tl::unexpected(elevation_m.error());
  draft.floor.elevation_m = *elevation_m;
  if (const json* points = find_member(head, "control_points")) {
    if (auto done = georeference(*points, place, draft); !done) {
      return tl::unexpected(done.error());
    }
  }
  return draft;
}

}  // namespace

Result<FloorDraft> parse_plan(std::string_view geojson, std::string_view place) {
  const std::string place_text(place);
  const auto document = detail::parse_json(geojson, place, core::ErrorCode::kPlanInvalid);
  if (!document) return tl::unexpected(document.error());
  const json* head = find_member(*document, "waylode");
  const json* features = find_member(*document, "features");
  if (head == nullptr || !head->is_object() || features == nullptr || !features->is_array()) {
    return invalid("no Waylode plan (members waylode and features); see contract/plan-format.md",
                   place_text);
  }
  auto draft = parse_head(*head, place_text + " member waylode");
  if (!draft) return draft;
  for (std::size_t i = 0; i < features->size(); ++i) {
    const auto added = detail::add_feature((*features)[i], draft->floor.bounds, draft->floor.plan);
    if (!added) return invalid(added.error(), place_text + " feature " + std::to_string(i));
  }
  return draft;
}

}  // namespace waylode::site
