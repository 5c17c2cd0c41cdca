// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::site {

/// A floor as read from its files, before it joins a site.
struct FloorDraft {
  Floor floor;  ///< site_from_floor is the identity until the site is put together.
  /// Floor metres -> metres east and north of `origin`, when the source is georeferenced.
  std::optional<core::GeoPoint> origin;
  core::Affine2 enu_from_floor;
  /// What was left out of the drawing and why, one sentence each, for the caller to report.
  std::vector<std::string> notes;
};

/// A floor without plan or georeference.
FloorDraft bare_floor(std::string_view name, const core::Bounds2& bounds);

/// Waylode's own plan: GeoJSON whose coordinates are floor metres (contract/plan-format.md). The
/// origin is the centre of the bounds. kPlanInvalid names `place` and the feature's index.
core::Result<FloorDraft> parse_plan(std::string_view geojson, std::string_view place);

/// The plan as GeoJSON; parse_plan gives the same draft back (to the millimetre) when its bounds
/// enclose an area with all that is drawn, and its polygons are simple.
std::string format_plan(const FloorDraft& draft);

/// A floor of the Indoor Location Competition: `geojson` in WGS-84 and the plan's size in metres.
/// The longitude/latitude box of the floor's outline is scaled to the plan's size. The outline
/// becomes walkable, the units (shops) become obstacles, the edges of both become walls; polygons
/// that cross themselves are left out with a note. Errors: kPlanInvalid.
core::Result<FloorDraft> parse_ilc_floor(std::string_view geojson, std::string_view floor_info_json,
                                         std::string_view floor_name, std::string_view place);

/// The size of a floor without drawing from its floor_info.json: a box from (0, 0), metres.
core::Result<core::Bounds2> parse_ilc_floor_size(std::string_view floor_info_json,
                                                 std::string_view place);

/// Ground 0. Storeys counted from one: "F1", "1F", "L1" -> 0, "F2", "L2" -> 1. Ordinals: "0", "3",
/// "-2". Basements "B1", "B1F" -> -1. "G", "GF" -> 0, "LG" -> -1. Letter case does not matter; 0
/// when the name says nothing.
int level_of_floor_name(std::string_view name);

/// Puts floors together. The site's origin is that of the first georeferenced floor; floors without
/// georeference share the site frame as they are. kPlanInvalid when two floors share a name.
core::Result<std::vector<Floor>> join_floors(std::vector<FloorDraft> drafts,
                                             std::optional<core::GeoPoint>& origin);

}  // namespace waylode::site
