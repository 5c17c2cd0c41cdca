// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/knn_positioner.hpp"

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {

core::Result<void> KnnPositioner::Options::validate() const {
  return detail::validate_nearest(neighbours, base_sigma_m, spread_gain, "knn");
}

std::optional<Positioning> KnnPositioner::estimate(const Query& query,
                                                   std::optional<core::FloorId> known_floor,
                                                   const std::optional<core::Belief>&) const {
  const ReferenceQuery heard = map_->prepare(query.readings);
  if (heard.heard.empty()) return std::nullopt;
  return detail::position_by_nearest(*map_, query, heard, detail::all_points(*map_, known_floor),
                                     {.neighbours = options_.neighbours,
                                      .weighted = options_.weighted,
                                      .compared = options_.compared,
                                      .spread = {options_.base_sigma_m, options_.spread_gain}});
}

}  // namespace waylode::radio
