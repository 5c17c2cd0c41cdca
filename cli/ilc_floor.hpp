// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "waylode/core/result.hpp"
#include "waylode/site/plan_geojson.hpp"

namespace waylode::cli {

/// A floor's folder with floor_info.json and, for its walls, geojson_map.json; the folder's name is
/// the floor's. Errors of core::read_file, and kPlanInvalid.
core::Result<site::FloorDraft> read_ilc_floor(const std::filesystem::path& folder);

}  // namespace waylode::cli
