// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"
#include "waylode/fusion/floor_filter.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::smoothing {

/// What a track is made of.
using Event = std::variant<observation::MotionDelta, observation::RadioObservation,
                           observation::VerticalMotion>;

/// The floor around a scan.
struct FloorAt {
  core::DeviceTime time;
  core::FloorId floor;
  double probability = 1.0;
};

/// The floor at each scan given all of them and the climbs, or the known one. `levels` as in
/// fusion::FloorFilter.
std::vector<FloorAt> smooth_floors(const std::vector<Event>& events,
                                   std::optional<core::FloorId> known_floor,
                                   const std::vector<int>& levels,
                                   const fusion::FloorFilter::Options& options);

}  // namespace waylode::smoothing
