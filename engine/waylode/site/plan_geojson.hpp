// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

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
};

/// Waylode's own plan: GeoJSON whose coordinates are floor metres (contract/plan-format.md).
core::Result<FloorDraft> parse_plan(std::string_view geojson, std::string_view place);

/// The plan as GeoJSON; parse_plan gives the same draft back (to the millimetre).
std::string format_plan(const FloorDraft& draft);

/// A floor of the Indoor Location Competition: `geojson` in WGS-84 and the plan's size in metres.
/// The longitude/latitude box of the drawing is scaled to the plan's size. Shops become obstacles.
core::Result<FloorDraft> parse_ilc_floor(std::string_view geojson, std::string_view floor_info_json,
                                         std::string_view floor_name, std::string_view place);

/// Ground 0: "F1" -> 0, "F2" -> 1, "B1" -> -1, "-2" -> -2, "3" -> 3. 0 when the name says nothing.
int level_of_floor_name(std::string_view name);

/// Puts floors together. The site's origin is that of the first georeferenced floor; floors without
/// georeference share the site frame as they are.
core::Result<std::vector<Floor>> join_floors(std::vector<FloorDraft> drafts,
                                             std::optional<core::GeoPoint>& origin);

}  // namespace waylode::site
