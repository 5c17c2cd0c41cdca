// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <set>

#include "waylode/site/frame_fit.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::Vector2;

/// The whole text as an integer.
std::optional<int> parse_integer(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

std::string upper_case_ascii(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

/// Four points that span the floor, also when its bounds are a point or a line.
std::array<Vector2, 4> spanning_corners(const core::Bounds2& bounds) {
  constexpr double kLeastSpan_m = 10.0;
  const Vector2 centre_m = 0.5 * (bounds.min_m + bounds.max_m);
  const Vector2 half_m = (0.5 * bounds.size_m()).cwiseMax(kLeastSpan_m);
  return {centre_m - half_m, centre_m + Vector2(half_m.x(), -half_m.y()), centre_m + half_m,
          centre_m + Vector2(-half_m.x(), half_m.y())};
}

std::optional<core::Affine2> site_from_draft(const FloorDraft& draft,
                                             const core::GeoPoint& site_origin) {
  if (*draft.origin == site_origin) return draft.enu_from_floor;
  const std::array<Vector2, 4> corners_m = spanning_corners(draft.floor.bounds);
  std::array<Vector2, 4> site_m;
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Vector2 enu_m = draft.enu_from_floor * corners_m[i];
    site_m[i] = enu_from_geo(site_origin, geo_from_enu(*draft.origin, enu_m));
  }
  return fit_affine(corners_m, site_m);
}

}  // namespace

FloorDraft bare_floor(std::string_view name, const core::Bounds2& bounds) {
  FloorDraft draft;
  draft.floor.name = name;
  draft.floor.level = level_of_floor_name(name);
  draft.floor.bounds = bounds;
  return draft;
}

int level_of_floor_name(std::string_view name) {
  const std::string upper = upper_case_ascii(name);
  std::string_view rest = upper;
  if (const auto ordinal = parse_integer(rest)) return *ordinal;
  if (rest == "LG") return -1;
  if (rest.starts_with('B')) {
    rest.remove_prefix(1);
    if (rest.ends_with('F')) rest.remove_suffix(1);
    const auto depth = parse_integer(rest);
    return depth && *depth > 0 ? -*depth : 0;
  }
  if (rest.starts_with('F') || rest.starts_with('L')) {
    rest.remove_prefix(1);
  } else if (rest.ends_with('F') || rest.ends_with('L')) {
    rest.remove_suffix(1);
  } else {
    return 0;
  }
  const auto storey = parse_integer(rest);
  if (!storey) return 0;
  return *storey > 0 ? *storey - 1 : *storey;
}

core::Result<std::vector<Floor>> join_floors(std::vector<FloorDraft> drafts,
                                             std::optional<core::GeoPoint>& origin) {
  origin.reset();
  for (const FloorDraft& draft : drafts) {
    if (draft.origin && !origin) origin = draft.origin;
  }
  std::set<std::string_view> names;
  std::vector<Floor> floors;
  floors.reserve(drafts.size());
  for (FloorDraft& draft : drafts) {
    if (draft.origin) {
      const auto site_from_floor = site_from_draft(draft, *origin);
      if (!site_from_floor) {
        return core::fail(core::ErrorCode::kPlanInvalid,
                          "the floor's georeference or bounds are not usable; correct its plan",
                          draft.floor.name);
      }
      draft.floor.site_from_floor = *site_from_floor;
    } else {
      draft.floor.site_from_floor = core::Affine2{};
    }
    floors.push_back(std::move(draft.floor));
    if (!names.insert(floors.back().name).second) {
      return core::fail(core::ErrorCode::kPlanInvalid,
                        "two floors have this name; give each its own", floors.back().name);
    }
  }
  return floors;
}

}  // namespace waylode::site
