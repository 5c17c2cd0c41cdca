// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/site/floor.hpp"
#include "waylode/site/magnetic_map.hpp"
#include "waylode/site/radio_map.hpp"

namespace waylode::site {

/// What a site is made of before it is frozen.
struct SiteParts {
  std::string name;
  /// Origin of the site frame (local east-north tangent plane); none for a site without
  /// georeference, whose site frame is then just shared metres.
  std::optional<core::GeoPoint> origin;
  std::vector<Floor> floors;  ///< At most 65535; FloorId is the index.
  RadioMapStorage radio_map{};
  MagneticMapStorage magnetic_map{};
};

/// A building, immutable: floors, frames and built maps. Cheap to share between sessions.
///
/// Frames: `floor` (metres on one floor's plan), `site` (metres east and north of the origin,
/// common to all floors), WGS-84. See docs/frames.md.
class Site {
 public:
  explicit Site(SiteParts parts);
  /// A site whose maps live elsewhere (a mapped bundle); `keep_alive` owns that storage.
  /// Those of `parts` are ignored.
  Site(SiteParts parts, RadioMap radio_map, MagneticMap magnetic_map,
       std::shared_ptr<const void> keep_alive, std::uint64_t version);
  // The maps view storage inside: moving keeps it in place, copying would not.
  Site(Site&&) = default;
  Site& operator=(Site&&) = default;

  const std::string& name() const { return parts_.name; }
  const std::vector<Floor>& floors() const { return parts_.floors; }
  const Floor& floor(core::FloorId id) const { return parts_.floors[id.index]; }
  std::optional<core::FloorId> find_floor(std::string_view floor_name) const;
  const RadioMap& radio_map() const { return radio_map_; }
  const MagneticMap& magnetic_map() const { return magnetic_map_; }
  const std::optional<core::GeoPoint>& origin() const { return parts_.origin; }
  /// Identifies plans and maps by content (checksum of the bundle); 0 for a site never stored.
  std::uint64_t version() const { return version_; }

  core::Vector2 site_from_floor(core::FloorId floor, const core::Vector2& position_m) const;
  core::Vector2 floor_from_site(core::FloorId floor, const core::Vector2& position_m) const;
  /// nullopt without georeference.
  std::optional<core::GeoPoint> geo_from_floor(core::FloorId floor,
                                               const core::Vector2& position_m) const;
  std::optional<core::Vector2> floor_from_geo(core::FloorId floor,
                                              const core::GeoPoint& position) const;
  /// Horizontal metres between positions on any two floors, through the common frame.
  double horizontal_distance_m(core::FloorId floor_a, const core::Vector2& a_m,
                               core::FloorId floor_b, const core::Vector2& b_m) const;

 private:
  SiteParts parts_;
  std::vector<core::Affine2> floor_from_site_;
  RadioMap radio_map_;
  MagneticMap magnetic_map_;
  std::shared_ptr<const void> keep_alive_;
  std::uint64_t version_ = 0;
};

}  // namespace waylode::site
