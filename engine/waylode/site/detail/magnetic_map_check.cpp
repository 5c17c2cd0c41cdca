// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/magnetic_map_check.hpp"

#include <cmath>

namespace waylode::site::detail {
namespace {

const char* defect_of(const MagneticPoint& point, std::size_t floor_count) {
  if (!std::isfinite(point.x_m) || !std::isfinite(point.y_m)) return "has no finite position";
  if (!std::isfinite(point.horizontal_ut) || point.horizontal_ut < 0.0F ||
      !std::isfinite(point.vertical_ut)) {
    return "has no usable field";
  }
  if (!std::isfinite(point.sigma_ut) || point.sigma_ut < 0.0F) return "has no usable sigma";
  if (point.count == 0) return "averages no reading";
  if (point.floor >= floor_count) return "names a floor that does not exist";
  return nullptr;
}

}  // namespace

std::string defect_of(const MagneticMap& map, std::size_t floor_count) {
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const char* defect = defect_of(map.points[i], floor_count);
    if (defect == nullptr && i > 0 && map.points[i - 1].floor > map.points[i].floor) {
      defect = "is not in the order of floors";
    }
    if (defect != nullptr) return "magnetic.points entry " + std::to_string(i) + " " + defect;
  }
  return {};
}

}  // namespace waylode::site::detail
