// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "waylode/site/connectors.hpp"
#include "waylode/site/floor_geometry.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/walkability.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto plan = waylode::site::parse_plan(text, "fuzz");
  if (plan) {
    const waylode::site::FloorGeometry geometry(plan->floor.plan);
    const auto& bounds = plan->floor.bounds;
    static_cast<void>(geometry.crosses_wall(bounds.min_m, bounds.max_m));
    static_cast<void>(geometry.is_walkable(0.5 * (bounds.min_m + bounds.max_m)));
    if (bounds.diagonal_m() < 1000.0) {  // Larger rasters would only slow the search down.
      const waylode::site::Walkability walkability(plan->floor.plan, bounds, {});
      static_cast<void>(walkability.log_penalty(bounds.min_m, bounds.max_m));
    }
    static_cast<void>(waylode::site::nearest_connector(plan->floor.plan, bounds.min_m));
    static_cast<void>(waylode::site::format_plan(*plan));
  }
  static_cast<void>(waylode::site::parse_ilc_floor(
      text, R"({"map_info": {"width": 30, "height": 20}})", "F1", "fuzz"));
  return 0;
}
