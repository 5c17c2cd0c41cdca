// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/site/floor.hpp"
#include "waylode/site/plan_geojson.hpp"

namespace waylode::sim {

/// A Wi-Fi access point or a Bluetooth beacon, where it hangs.
struct Transmitter {
  enum class Kind : std::uint8_t { kWifi, kBluetooth };
  Kind kind = Kind::kWifi;
  std::string name;  ///< Unique on its floor; addresses and shadowing are drawn from it.
  core::FloorId floor;
  core::Vector2 position_m;  ///< Floor frame.
  bool operator==(const Transmitter&) const = default;
};

/// A place that routes name: "3", or "F1/3" where several floors have a "3".
struct NamedPoint {
  std::string name;
  core::FloorId floor;
  core::Vector2 position_m;  ///< Floor frame.
  bool operator==(const NamedPoint&) const = default;
};

/// Stairs between a floor and the next one up, at the same place on both. People wind upwards on a
/// circle of `radius_m` around the centre.
struct Stairwell {
  core::FloorId lower;
  core::Vector2 centre_m;
  double radius_m = 0.5;
  bool operator==(const Stairwell&) const = default;
};

/// What is simulated in: floors (rising level; FloorId is the index), transmitters, places, stairs.
/// All floors share one frame: positions of different floors can be compared.
struct Building {
  std::string name;
  std::vector<site::FloorDraft> floors;
  /// Per floor, what weakens radio: one thin line per wall, however thick the wall is drawn.
  std::vector<std::vector<site::Wall>> radio_walls;
  std::vector<Transmitter> transmitters;
  std::vector<NamedPoint> points;
  std::vector<Stairwell> stairwells;

  const site::Floor& floor(core::FloorId id) const { return floors[id.index].floor; }
  std::optional<core::FloorId> find_floor(std::string_view floor_name) const;
  /// "F1/3", or "3" when just one floor has it. kScenarioInvalid names what was looked for.
  core::Result<NamedPoint> find_point(std::string_view name) const;
};

/// A building from plans that were read elsewhere: floors sorted by level, plan walls (or, without
/// walls, the walkable outlines) as radio walls; no transmitters, places or stairs yet.
/// kScenarioInvalid when there is no floor or two share a level or a name.
core::Result<Building> building_from_plans(std::string name, std::vector<site::FloorDraft> floors);

/// Adds access points "AP1", "AP2", ... to every floor: one per walkable square of `spacing_m`, at
/// a walkable spot drawn with `seed`.
void add_seeded_access_points(Building& building, double spacing_m, std::uint64_t seed);

}  // namespace waylode::sim
