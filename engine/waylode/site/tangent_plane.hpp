// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"

namespace waylode::site {

/// East and north metres of WGS-84 positions on the plane that touches the ellipsoid at `origin`,
/// height 0 throughout. Exact (GeographicLib::LocalCartesian); heights that the plane's departure
/// from the ellipsoid gives rise to (20 mm at 500 m) are dropped, which bends horizontal positions
/// by less than 2 um there.
core::Vector2 enu_from_geo(const core::GeoPoint& origin, const core::GeoPoint& position);

/// The inverse.
core::GeoPoint geo_from_enu(const core::GeoPoint& origin, const core::Vector2& position_m);

/// Finite, latitude within [-90, 90], longitude within [-180, 180].
bool is_valid_geo_point(const core::GeoPoint& point);

}  // namespace waylode::site
