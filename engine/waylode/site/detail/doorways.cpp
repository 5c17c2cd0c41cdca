// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/doorways.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace waylode::site::detail {
namespace {

using core::Vector2;

constexpr double kMinRest_m = 0.001;

/// Shares of the wall's length, from its start, that lie within the door's circle.
std::optional<std::pair<double, double>> opening(const Wall& wall, const Door& door) {
  const Vector2 way_m = wall.to_m - wall.from_m;
  const double length2_m2 = way_m.squaredNorm();
  const double radius_m = 0.5 * door.width_m;
  const Vector2 to_middle_m = door.position_m - wall.from_m;
  const double middle = to_middle_m.dot(way_m) / length2_m2;
  const double beside2_m2 = (to_middle_m - middle * way_m).squaredNorm();
  // False for NaN, a wall of no length among them.
  if (!(beside2_m2 < radius_m * radius_m) || !(radius_m > 0.0)) return std::nullopt;
  const double half = std::sqrt((radius_m * radius_m - beside2_m2) / length2_m2);
  if (middle + half <= 0.0 || middle - half >= 1.0) return std::nullopt;
  return std::pair(middle - half, middle + half);
}

void append_rest(const Wall& wall, std::vector<std::pair<double, double>> openings,
                 std::vector<Wall>& rest) {
  std::ranges::sort(openings);
  openings.emplace_back(1.0, 1.0);
  const Vector2 way_m = wall.to_m - wall.from_m;
  const double min_share = kMinRest_m / way_m.norm();
  double begin = 0.0;
  for (const auto& [open, close] : openings) {
    const double end = std::min(open, 1.0);
    if (end - begin > min_share) {
      rest.push_back({begin > 0.0 ? Vector2(wall.from_m + begin * way_m) : wall.from_m,
                      end < 1.0 ? Vector2(wall.from_m + end * way_m) : wall.to_m});
    }
    begin = std::max(begin, close);
  }
}

}  // namespace

std::vector<Wall> without_doorways(std::span<const Wall> walls, std::span<const Door> doors) {
  std::vector<Wall> rest;
  for (const Wall& wall : walls) {
    std::vector<std::pair<double, double>> openings;
    for (const Door& door : doors) {
      if (const auto open = opening(wall, door)) openings.push_back(*open);
    }
    if (openings.empty()) {
      rest.push_back(wall);
    } else {
      append_rest(wall, std::move(openings), rest);
    }
  }
  return rest;
}

}  // namespace waylode::site::detail
