// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/surveyed_recording.hpp"

namespace waylode::survey {

std::vector<PlacedWaypoint> place_waypoints(const site::Site& site,
                                            std::span<const sample::Sample> samples,
                                            std::optional<core::FloorId> default_floor) {
  std::vector<PlacedWaypoint> placed;
  for (const sample::Sample& sample : samples) {
    const auto* mark = std::get_if<sample::WaypointSample>(&sample);
    if (mark == nullptr) continue;
    const auto floor = mark->floor.empty() ? default_floor : site.find_floor(mark->floor);
    if (!floor) continue;
    std::optional<core::Vector2> position_m = mark->position_m;
    if (!position_m && mark->geo_position) {
      position_m = site.floor_from_geo(*floor, *mark->geo_position);
    }
    if (position_m) placed.push_back({mark->time, *floor, *position_m});
  }
  return placed;
}

std::size_t drop_readings_before(std::vector<sample::Sample>& samples, core::DeviceTime start) {
  std::size_t dropped = 0;
  for (sample::Sample& sample : samples) {
    if (auto* scan = std::get_if<sample::WifiScan>(&sample)) {
      dropped += std::erase_if(scan->readings, [&](const sample::WifiReading& reading) {
        return reading.last_seen < start;
      });
    }
  }
  return dropped;
}

}  // namespace waylode::survey
