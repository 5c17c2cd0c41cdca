// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/site.hpp"

#include <algorithm>
#include <utility>

#include "waylode/core/assert.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::FloorId;
using core::GeoPoint;
using core::Vector2;

std::vector<core::Affine2> invert_all(const std::vector<Floor>& floors) {
  std::vector<core::Affine2> inverses;
  inverses.reserve(floors.size());
  for (const Floor& floor : floors) inverses.push_back(floor.site_from_floor.inverse());
  return inverses;
}

}  // namespace

Site::Site(SiteParts parts)
    : parts_(std::move(parts)), floor_from_site_(invert_all(parts_.floors)) {
  radio_map_ = parts_.radio_map.view();
  magnetic_map_ = parts_.magnetic_map.view();
}

Site::Site(SiteParts parts, RadioMap radio_map, MagneticMap magnetic_map,
           std::shared_ptr<const void> keep_alive, std::uint64_t version)
    : parts_(std::move(parts)),
      floor_from_site_(invert_all(parts_.floors)),
      radio_map_(radio_map),
      magnetic_map_(magnetic_map),
      keep_alive_(std::move(keep_alive)),
      version_(version) {}

std::optional<FloorId> Site::find_floor(std::string_view floor_name) const {
  const auto found = std::ranges::find(parts_.floors, floor_name, &Floor::name);
  if (found == parts_.floors.end()) return std::nullopt;
  return FloorId{static_cast<std::uint16_t>(found - parts_.floors.begin())};
}

Vector2 Site::site_from_floor(FloorId floor, const Vector2& position_m) const {
  WAYLODE_ASSERT(floor.index < parts_.floors.size());
  return parts_.floors[floor.index].site_from_floor * position_m;
}

Vector2 Site::floor_from_site(FloorId floor, const Vector2& position_m) const {
  WAYLODE_ASSERT(floor.index < floor_from_site_.size());
  return floor_from_site_[floor.index] * position_m;
}

std::optional<GeoPoint> Site::geo_from_floor(FloorId floor, const Vector2& position_m) const {
  if (!parts_.origin) return std::nullopt;
  return geo_from_enu(*parts_.origin, site_from_floor(floor, position_m));
}

std::optional<Vector2> Site::floor_from_geo(FloorId floor, const GeoPoint& position) const {
  if (!parts_.origin) return std::nullopt;
  return floor_from_site(floor, enu_from_geo(*parts_.origin, position));
}

double Site::horizontal_distance_m(FloorId floor_a, const Vector2& a_m, FloorId floor_b,
                                   const Vector2& b_m) const {
  return (site_from_floor(floor_a, a_m) - site_from_floor(floor_b, b_m)).norm();
}

}  // namespace waylode::site
