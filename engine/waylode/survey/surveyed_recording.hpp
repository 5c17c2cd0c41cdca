// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/site/site.hpp"

namespace waylode::survey {

/// A walk with marks of where the surveyor was.
struct SurveyedRecording {
  std::string name;
  std::vector<sample::Sample> samples;  ///< By time.
  /// The floor of marks that name none.
  std::optional<core::FloorId> default_floor;
};

/// A mark placed on the site.
struct PlacedWaypoint {
  core::DeviceTime time;
  core::FloorId floor;
  core::Vector2 position_m = core::Vector2::Zero();  ///< Floor frame.
};

/// The recording's marks that can be placed: floor known, position given. By time.
std::vector<PlacedWaypoint> place_waypoints(const site::Site& site,
                                            std::span<const sample::Sample> samples,
                                            std::optional<core::FloorId> default_floor);

/// Takes away Wi-Fi readings last heard before `start`: they belong to what the phone did before
/// (another walk, perhaps), not to this recording. Scans stay, even when nothing is left in them.
/// Returns how many readings were dropped.
std::size_t drop_readings_before(std::vector<sample::Sample>& samples, core::DeviceTime start);

}  // namespace waylode::survey
