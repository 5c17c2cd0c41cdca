// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "waylode/core/fix.hpp"
#include "waylode/site/site.hpp"

namespace waylode::cli {

/// Fixes of one recording as text. A fix in state `unknown` or `outside` has no position in any
/// format: null, an empty cell, a null geometry. Latitude and longitude are there when the site is
/// georeferenced; GeoJSON without georeference has floor metres for coordinates and says so.
std::string fixes_to_json(const site::Site& site, std::span<const core::Fix> fixes);
std::string fixes_to_geojson(const site::Site& site, std::span<const core::Fix> fixes);
std::string fixes_to_csv(const site::Site& site, std::span<const core::Fix> fixes);

}  // namespace waylode::cli
