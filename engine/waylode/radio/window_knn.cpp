// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/window_knn.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {
namespace {

const WindowKnn::Window& window_at(std::span<const WindowKnn::Window> windows, double rssi_dbm) {
  for (const WindowKnn::Window& window : windows) {
    if (rssi_dbm >= static_cast<double>(window.from_dbm)) return window;
  }
  return windows.back();
}

bool hits(const WindowKnn::Window& window, double query_dbm, double point_dbm) {
  return point_dbm > query_dbm - static_cast<double>(window.below_db) &&
         point_dbm < query_dbm + static_cast<double>(window.above_db);
}

/// The scan's strongest alone.
ReferenceQuery only_strongest(const ReferenceMap& map, ReferenceQuery heard, std::size_t count) {
  std::vector<ReferenceQuery::Heard> ranked = detail::by_strength(map, heard);
  for (std::size_t i = count; i < ranked.size(); ++i) {
    heard.excess_db[ranked[i].transmitter] = std::numeric_limits<double>::quiet_NaN();
  }
  ranked.resize(std::min(ranked.size(), count));
  std::ranges::sort(ranked, {}, &ReferenceQuery::Heard::transmitter);
  heard.heard = std::move(ranked);
  return heard;
}

/// How many of the scan's transmitters every point of the map has within their window.
std::vector<std::size_t> count_hits(const ReferenceMap& map, const ReferenceQuery& heard,
                                    std::span<const detail::FloorCandidates> floors,
                                    std::span<const WindowKnn::Window> windows) {
  std::vector<std::size_t> count(map.points().size(), 0);
  for (const ReferenceQuery::Heard& one : heard.heard) {
    const double query_dbm = one.excess_db + static_cast<double>(map.options().fill_dbm);
    const WindowKnn::Window& window = window_at(windows, query_dbm);
    for (const detail::FloorCandidates& floor : floors) {
      for (const std::uint32_t point : map.points_hearing(one.transmitter, floor.floor)) {
        const auto point_dbm = static_cast<double>(map.mean_dbm(point, one.transmitter));
        if (hits(window, query_dbm, point_dbm)) ++count[point];
      }
    }
  }
  return count;
}

/// The fewest hits of a point that is kept.
std::size_t fewest_kept(std::span<const std::size_t> count, std::size_t transmitters,
                        const WindowKnn::Options& options) {
  if (options.keep == WindowKnn::Keep::kAllHits) return transmitters;
  const std::size_t most = std::ranges::max(count);
  return most > options.slack_hits ? std::max<std::size_t>(1, most - options.slack_hits) : 1;
}

}  // namespace

core::Result<void> WindowKnn::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "window_knn");
  };
  if (windows.empty() || windows.size() > 64) return refuse("there must be 1 to 64 windows");
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Window& window = windows[i];
    if (!(window.below_db > 0.0F && window.above_db > 0.0F && std::isfinite(window.below_db) &&
          std::isfinite(window.above_db) && std::isfinite(window.from_dbm))) {
      return refuse("a window must reach below and above by more than 0 dB");
    }
    if (i > 0 && !(window.from_dbm < windows[i - 1].from_dbm)) {
      return refuse("windows must go by falling from_dbm");
    }
  }
  if (strongest < 1 || strongest > 1000) return refuse("strongest must be in [1, 1000]");
  return detail::validate_nearest(neighbours, base_sigma_m, spread_gain, "window_knn");
}

std::optional<Positioning> WindowKnn::estimate(const Query& query,
                                               std::optional<core::FloorId> known_floor,
                                               const std::optional<core::Belief>&) const {
  const ReferenceQuery heard =
      only_strongest(*map_, map_->prepare(query.readings), options_.strongest);
  std::vector<detail::FloorCandidates> all = detail::all_points(*map_, known_floor);
  if (heard.heard.empty() || all.empty()) return std::nullopt;

  const std::vector<std::size_t> count = count_hits(*map_, heard, all, options_.windows);
  const std::size_t fewest = fewest_kept(count, heard.heard.size(), options_);
  const bool none_kept = std::ranges::none_of(count, [&](std::size_t n) { return n >= fewest; });
  if (!none_kept) {
    for (detail::FloorCandidates& floor : all) {
      std::erase_if(floor.points, [&](std::uint32_t point) { return count[point] < fewest; });
    }
  }
  // [Zhou2016] eq. (2) to (5)
  return detail::position_by_nearest(*map_, query, heard, all,
                                     {.neighbours = options_.neighbours,
                                      .weighted = false,
                                      .compared = options_.compared,
                                      .spread = {options_.base_sigma_m, options_.spread_gain}});
}

}  // namespace waylode::radio
