// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/region_wknn.hpp"

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {
namespace {

/// The regions of the strongest transmitters, as many as it takes to hold `enough` points.
std::vector<detail::FloorCandidates> regions(const ReferenceMap& map, const ReferenceQuery& heard,
                                             std::optional<core::FloorId> only_floor,
                                             std::size_t enough) {
  std::vector<detail::FloorCandidates> candidates;
  for (const ReferenceMap::FloorRange& range : map.floors()) {
    if (!only_floor || range.floor == *only_floor) candidates.push_back({range.floor, {}});
  }
  std::size_t found = 0;
  for (const ReferenceQuery::Heard& strong : detail::by_strength(map, heard)) {
    for (detail::FloorCandidates& floor : candidates) {
      const auto region = map.region_of(strong.transmitter, floor.floor);
      floor.points.insert(floor.points.end(), region.begin(), region.end());
      found += region.size();
    }
    if (found >= enough) return candidates;
  }
  return detail::all_points(map, only_floor);
}

}  // namespace

core::Result<void> RegionWknn::Options::validate() const {
  return detail::validate_nearest(neighbours, base_sigma_m, spread_gain, "region_wknn");
}

std::optional<Positioning> RegionWknn::estimate(const Query& query,
                                                std::optional<core::FloorId> known_floor,
                                                const std::optional<core::Belief>&) const {
  const ReferenceQuery heard = map_->prepare(query.readings);
  if (heard.heard.empty()) return std::nullopt;
  return detail::position_by_nearest(*map_, query, heard,
                                     regions(*map_, heard, known_floor, options_.neighbours),
                                     {.neighbours = options_.neighbours,
                                      .weighted = true,
                                      .compared = options_.compared,
                                      .spread = {options_.base_sigma_m, options_.spread_gain}});
}

}  // namespace waylode::radio
