// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/circle_knn.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Of the best of the candidates, as the options say.
double log_likelihood(const ReferenceMap& map, const ReferenceQuery& heard,
                      std::span<const detail::FloorCandidates> candidates,
                      const CircleKnn::Options& options) {
  double least_db = std::numeric_limits<double>::infinity();
  for (const detail::FloorCandidates& floor : candidates) {
    for (const std::uint32_t point : floor.points) {
      least_db = std::min(least_db, map.distance_db(heard, point, options.compared));
    }
  }
  if (!std::isfinite(least_db)) return 0.0;
  // Already a mean where distances are per transmitter.
  const auto count = static_cast<double>(heard.heard.size());
  const double sum_db2 =
      least_db * least_db * (options.compared == Compared::kCommonMean ? count : 1.0);
  const double mean_db2 = sum_db2 / count;
  return -0.5 * std::min(count, options.independent_readings) * mean_db2 /
         (options.reading_sigma_db * options.reading_sigma_db);
}

}  // namespace

core::Result<void> CircleKnn::Options::validate() const {
  if (!(radius_m > 0.0 && radius_m <= 1000.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "radius_m must be in (0, 1000]",
                      "circle_knn");
  }
  if (!(reading_sigma_db > 0.0 && independent_readings > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "reading_sigma_db and independent_readings must be positive", "circle_knn");
  }
  return detail::validate_nearest(neighbours, base_sigma_m, spread_gain, "circle_knn");
}

std::optional<Positioning> CircleKnn::estimate(const Query& query,
                                               std::optional<core::FloorId> known_floor,
                                               const std::optional<core::Belief>& prior) const {
  const ReferenceQuery heard = map_->prepare(query.readings);
  if (heard.heard.empty()) return std::nullopt;
  const bool centred = prior && (!known_floor || prior->floor == *known_floor);
  const std::vector<detail::FloorCandidates> candidates =
      centred ? within(*map_, prior->floor, prior->position_m, options_.radius_m)
              : detail::all_points(*map_, known_floor);
  auto placed =
      detail::position_by_nearest(*map_, query, heard, candidates,
                                  {.neighbours = options_.neighbours,
                                   .weighted = true,
                                   .compared = options_.compared,
                                   .spread = {options_.base_sigma_m, options_.spread_gain}});
  if (placed && centred) {
    placed->observation.floors.front().log_likelihood =
        log_likelihood(*map_, heard, candidates, options_);
  }
  return placed;
}

}  // namespace waylode::radio
