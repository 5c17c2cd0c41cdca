// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/circle_knn.hpp"

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {
namespace {

std::vector<detail::FloorCandidates> within(const ReferenceMap& map, core::FloorId floor,
                                            const core::Vector2& centre_m, double radius_m) {
  constexpr double kRounding_m = 1e-6;  // Places are kept in single precision.
  const double reach_m = radius_m + kRounding_m;
  std::vector<detail::FloorCandidates> candidates = detail::all_points(map, floor);
  for (detail::FloorCandidates& all : candidates) {
    std::erase_if(all.points, [&](std::uint32_t point) {
      return !((map.points()[point].position_m - centre_m).norm() <= reach_m);
    });
  }
  return candidates;
}

}  // namespace

core::Result<void> CircleKnn::Options::validate() const {
  if (!(radius_m > 0.0 && radius_m <= 1000.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "radius_m must be in (0, 1000]",
                      "circle_knn");
  }
  return detail::validate_nearest(neighbours, base_sigma_m, spread_gain, "circle_knn");
}

std::optional<Positioning> CircleKnn::estimate(const Query& query,
                                               std::optional<core::FloorId> known_floor,
                                               const std::optional<core::Belief>& prior) const {
  const ReferenceQuery heard = map_->prepare(query.readings);
  if (heard.heard.empty()) return std::nullopt;
  const bool centred = prior && (!known_floor || prior->floor == *known_floor);
  return detail::position_by_nearest(
      *map_, query, heard,
      centred ? within(*map_, prior->floor, prior->position_m, options_.radius_m)
              : detail::all_points(*map_, known_floor),
      {.neighbours = options_.neighbours,
       .weighted = true,
       .compared = options_.compared,
       .spread = {options_.base_sigma_m, options_.spread_gain}});
}

}  // namespace waylode::radio
