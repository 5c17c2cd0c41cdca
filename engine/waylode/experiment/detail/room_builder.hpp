// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/experiment/paper_rooms.hpp"
#include "waylode/sim/world.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::experiment::detail {

/// What a room is before it is surveyed and walked through.
struct RoomPlan {
  std::string name;
  site::Ring outline_m;
  std::vector<core::Vector2> access_points_m;
  std::vector<core::Vector2> grid_m;
  std::vector<core::Vector2> route_m;
  std::size_t instances_per_point = 10;
  std::size_t scans_per_instance = 1;
  sim::World::Facing facing = sim::World::Facing::kFour;
  std::vector<core::Vector2> magnetic_line_m;
  double magnetic_spacing_m = 0.2;
  double magnetic_noise_ut = 0.7;  ///< Of the survey, per component.
  std::size_t start_scans = 0;
  double start_interval_s = 0.5;
};

/// One floor with its access points and the route's vertices as places "0", "1", ...
core::Result<sim::Building> make_building(const RoomPlan& plan);
/// The names of the route's places.
std::vector<std::string> route_names(const RoomPlan& plan);

/// Surveys the room and lets scenario.walkers[0] walk; `scenario` is complete.
core::Result<PaperRoom> build_room(const RoomPlan& plan, const sim::Scenario& scenario);

}  // namespace waylode::experiment::detail
