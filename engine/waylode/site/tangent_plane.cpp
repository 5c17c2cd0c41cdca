// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/tangent_plane.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace waylode::site {

core::Vector2 enu_from_geo(const core::GeoPoint& origin, const core::GeoPoint& position) {
  const GeographicLib::LocalCartesian plane(origin.latitude_deg, origin.longitude_deg);
  double east_m = 0.0;
  double north_m = 0.0;
  double up_m = 0.0;
  plane.Forward(position.latitude_deg, position.longitude_deg, 0.0, east_m, north_m, up_m);
  return {east_m, north_m};
}

core::GeoPoint geo_from_enu(const core::GeoPoint& origin, const core::Vector2& position_m) {
  const GeographicLib::LocalCartesian plane(origin.latitude_deg, origin.longitude_deg);
  core::GeoPoint point;
  double height_m = 0.0;
  plane.Reverse(position_m.x(), position_m.y(), 0.0, point.latitude_deg, point.longitude_deg,
                height_m);
  return point;
}

bool is_valid_geo_point(const core::GeoPoint& point) {
  // Comparisons with NaN are false.
  return std::abs(point.latitude_deg) <= 90.0 && std::abs(point.longitude_deg) <= 180.0;
}

}  // namespace waylode::site
