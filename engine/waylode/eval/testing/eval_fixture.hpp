// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "waylode/eval/evaluated_track.hpp"

namespace waylode::eval::testing {

/// Floor 0 "F1", level 0, 30 m x 40 m, its frame the site's; floor 1 "F2", level 1, turned by +90
/// degrees and moved by (10, 0); floor 2 "B1", level -1, its frame the site's.
inline std::shared_ptr<const site::Site> three_floor_site() {
  site::SiteParts parts;
  parts.name = "house";
  parts.floors.resize(3);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "F2";
  parts.floors[2].name = "B1";
  parts.floors[1].level = 1;
  parts.floors[2].level = -1;
  for (site::Floor& floor : parts.floors) floor.bounds.max_m = {30.0, 40.0};
  parts.floors[1].site_from_floor.linear << 0.0, -1.0, 1.0, 0.0;
  parts.floors[1].site_from_floor.translation_m = {10.0, 0.0};
  return std::make_shared<const site::Site>(std::move(parts));
}

inline TruthPoint truth_at(double time_s, core::FloorId floor, const core::Vector2& position_m) {
  return {core::device_time_from_seconds(time_s), floor, position_m, true};
}

/// State ok, unit covariance.
inline core::Fix fix_at(double time_s, core::FloorId floor, const core::Vector2& position_m) {
  core::Fix fix;
  fix.time = core::device_time_from_seconds(time_s);
  fix.state = core::FixState::kOk;
  fix.belief = core::Belief{floor, 1.0, position_m, core::Matrix2::Identity()};
  return fix;
}

/// Simulated walks through a two-storey block of shops, each tracked by three invented methods of
/// different accuracy, floor sense and honesty. The same every time.
std::vector<EvaluatedTrack> demo_tracks(std::size_t recording_count);

}  // namespace waylode::eval::testing
