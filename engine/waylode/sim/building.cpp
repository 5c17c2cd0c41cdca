// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/building.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "waylode/core/rng.hpp"
#include "waylode/sim/detail/nav_grid.hpp"
#include "waylode/sim/detail/seeds.hpp"

namespace waylode::sim {

namespace {

using core::ErrorCode;

void append_ring(const site::Ring& ring, std::vector<site::Wall>& walls) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    walls.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
}

std::vector<site::Wall> walls_of(const site::Plan& plan) {
  if (!plan.walls.empty()) return plan.walls;
  std::vector<site::Wall> walls;
  for (const site::Polygon& polygon : plan.walkable) {
    append_ring(polygon.outer, walls);
    for (const site::Ring& hole : polygon.holes) append_ring(hole, walls);
  }
  return walls;
}

}  // namespace

std::optional<core::FloorId> Building::find_floor(std::string_view floor_name) const {
  for (std::size_t i = 0; i < floors.size(); ++i) {
    if (floors[i].floor.name == floor_name) return core::FloorId{static_cast<std::uint16_t>(i)};
  }
  return std::nullopt;
}

core::Result<NamedPoint> Building::find_point(std::string_view point_name) const {
  const NamedPoint* found = nullptr;
  for (const NamedPoint& point : points) {
    if (floor(point.floor).name + "/" + point.name == point_name) return point;
    if (point.name != point_name) continue;
    if (found != nullptr) {
      return core::fail(ErrorCode::kScenarioInvalid,
                        "place '" + std::string(point_name) + "' is on several floors; write '" +
                            floor(found->floor).name + "/" + found->name + "' or the like");
    }
    found = &point;
  }
  if (found != nullptr) return *found;
  return core::fail(ErrorCode::kScenarioInvalid, "no place is named '" + std::string(point_name) +
                                                     "'; draw its digit or add a [[point]]");
}

core::Result<Building> building_from_plans(std::string name, std::vector<site::FloorDraft> floors) {
  if (floors.empty()) {
    return core::fail(ErrorCode::kScenarioInvalid, "the building has no floor; give it one");
  }
  std::stable_sort(floors.begin(), floors.end(),
                   [](const auto& a, const auto& b) { return a.floor.level < b.floor.level; });
  for (std::size_t i = 1; i < floors.size(); ++i) {
    if (floors[i].floor.level == floors[i - 1].floor.level) {
      return core::fail(ErrorCode::kScenarioInvalid,
                        "floors '" + floors[i - 1].floor.name + "' and '" + floors[i].floor.name +
                            "' have the same level; give each its own");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (floors[i].floor.name == floors[j].floor.name) {
        return core::fail(ErrorCode::kScenarioInvalid,
                          "two floors are named '" + floors[i].floor.name + "'; rename one");
      }
    }
  }
  Building building;
  building.name = std::move(name);
  building.floors = std::move(floors);
  for (const site::FloorDraft& draft : building.floors) {
    building.radio_walls.push_back(walls_of(draft.floor.plan));
  }
  return building;
}

void add_seeded_access_points(Building& building, double spacing_m, std::uint64_t seed) {
  for (std::size_t f = 0; f < building.floors.size(); ++f) {
    const site::Floor& floor = building.floors[f].floor;
    const detail::NavGrid grid(floor);
    core::Rng rng(detail::derive_seed(seed, "access points/" + floor.name));
    int number = 0;
    for (double y_m = floor.bounds.min_m.y(); y_m < floor.bounds.max_m.y(); y_m += spacing_m) {
      for (double x_m = floor.bounds.min_m.x(); x_m < floor.bounds.max_m.x(); x_m += spacing_m) {
        // Corridors can be a small part of a square: some draws find them nearly always.
        constexpr int kDraws = 30;
        for (int draw = 0; draw < kDraws; ++draw) {
          const double x = x_m + spacing_m * rng.uniform();
          const double y = y_m + spacing_m * rng.uniform();
          if (!grid.is_walkable({x, y})) continue;
          building.transmitters.push_back({Transmitter::Kind::kWifi,
                                           "AP" + std::to_string(++number),
                                           core::FloorId{static_cast<std::uint16_t>(f)},
                                           {x, y}});
          break;
        }
      }
    }
  }
}

}  // namespace waylode::sim
