// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/magnetic_map.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::site {
namespace {

constexpr double kSmallestCell_m = 0.05;
constexpr double kFarthest_m = 1e6;  // A cell's row and column stay within 32 bits.

}  // namespace

std::span<const MagneticPoint> MagneticMap::on_floor(core::FloorId floor) const {
  const auto found = std::ranges::equal_range(points, floor.index, {}, &MagneticPoint::floor);
  return {found.begin(), found.end()};
}

core::Result<void> MagneticMapBuilder::Options::validate() const {
  if (!(cell_m >= kSmallestCell_m && cell_m <= kFarthest_m)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "cell_m must be at least 0.05",
                      "magnetic_map");
  }
  return {};
}

void MagneticMapBuilder::add(core::FloorId floor, const core::Vector2& position_m,
                             double horizontal_ut, double vertical_ut) {
  const core::Vector2 field_ut(horizontal_ut, vertical_ut);
  if (!(position_m.cwiseAbs().maxCoeff() <= kFarthest_m) || !position_m.allFinite() ||
      !field_ut.allFinite() || horizontal_ut < 0.0) {
    return;
  }
  const core::Vector2 index = position_m / options_.cell_m;
  Cell& cell = cells_[{floor.index, static_cast<std::int32_t>(std::floor(index.y())),
                       static_cast<std::int32_t>(std::floor(index.x()))}];
  if (cell.count == 0) cell.first_ut = field_ut;
  const core::Vector2 difference_ut = field_ut - cell.first_ut;
  ++cell.count;
  cell.position_sum_m += position_m;
  cell.sum_ut += difference_ut;
  cell.square_sum_ut2 += difference_ut.squaredNorm();
}

MagneticPoint MagneticMapBuilder::point_of(core::FloorId floor, const Cell& cell) {
  const double count = cell.count;
  const core::Vector2 position_m = cell.position_sum_m / count;
  const core::Vector2 mean_ut = cell.sum_ut / count;
  // Mean of the two parts' variances.
  const double variance_ut2 = cell.square_sum_ut2 / count - mean_ut.squaredNorm();
  MagneticPoint point;
  point.x_m = static_cast<float>(position_m.x());
  point.y_m = static_cast<float>(position_m.y());
  point.horizontal_ut = static_cast<float>(cell.first_ut.x() + mean_ut.x());
  point.vertical_ut = static_cast<float>(cell.first_ut.y() + mean_ut.y());
  point.sigma_ut = static_cast<float>(std::sqrt(std::max(0.0, 0.5 * variance_ut2)));
  point.floor = floor.index;
  point.count = static_cast<std::uint16_t>(std::min<std::uint32_t>(cell.count, 0xFFFF));
  return point;
}

MagneticMapStorage MagneticMapBuilder::build() const {
  MagneticMapStorage storage;
  storage.points.reserve(cells_.size());
  for (const auto& [key, cell] : cells_) {
    storage.points.push_back(point_of(core::FloorId{key.floor}, cell));
  }
  return storage;
}

}  // namespace waylode::site
