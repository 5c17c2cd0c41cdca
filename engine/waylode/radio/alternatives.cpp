// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/alternatives.hpp"

#include <algorithm>
#include <utility>

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {

std::vector<core::Vector2> alternatives(const ReferenceMap& map,
                                        std::span<const QueryReading> readings, core::FloorId floor,
                                        std::size_t count, double apart_m) {
  const ReferenceQuery heard = map.prepare(readings);
  if (heard.heard.empty()) return {};
  std::vector<std::pair<double, std::uint32_t>> by_distance;
  for (const detail::FloorCandidates& candidates : detail::all_points(map, floor)) {
    for (const std::uint32_t point : candidates.points) {
      by_distance.emplace_back(map.distance_db(heard, point, Compared::kUnion), point);
    }
  }
  std::ranges::sort(by_distance);
  std::vector<core::Vector2> places;
  for (const auto& [distance_db, point] : by_distance) {
    if (places.size() == count) break;
    const core::Vector2& here = map.points()[point].position_m;
    const bool apart = std::ranges::all_of(
        places, [&](const core::Vector2& place) { return (place - here).norm() >= apart_m; });
    if (apart) places.push_back(here);
  }
  return places;
}

}  // namespace waylode::radio
