// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"

namespace waylode::site {

/// The magnetic field at one surveyed place, levelled, so that it does not depend on where the
/// surveyor faced. Fixed layout: it is stored.
struct MagneticPoint {
  float x_m = 0.0F;  ///< Floor frame.
  float y_m = 0.0F;
  float horizontal_ut = 0.0F;  ///< Size of the horizontal part; not negative.
  float vertical_ut = 0.0F;    ///< Up positive: negative north of the magnetic equator.
  float sigma_ut = 0.0F;       ///< Scatter of the readings averaged here, per part; 0 of just one.
  std::uint16_t floor = 0;     ///< FloorId.
  std::uint16_t count = 0;     ///< Readings averaged here, at least 1; saturates.

  bool operator==(const MagneticPoint&) const = default;
};
static_assert(sizeof(MagneticPoint) == 24);

/// The surveyed field of a whole site. A view; the storage (a mapped bundle or MagneticMapStorage)
/// must outlive it.
struct MagneticMap {
  std::span<const MagneticPoint> points;  ///< Sorted by floor.

  bool empty() const { return points.empty(); }
  std::span<const MagneticPoint> on_floor(core::FloorId floor) const;
};

/// Owns what a MagneticMap views.
struct MagneticMapStorage {
  std::vector<MagneticPoint> points;

  MagneticMap view() const { return {points}; }
  bool operator==(const MagneticMapStorage&) const = default;
};

/// Averages readings in square cells, each floor by itself.
class MagneticMapBuilder {
 public:
  struct Options {
    double cell_m = 0.5;  ///< Side of a cell. Smaller: sharper and larger maps. At least 0.05.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit MagneticMapBuilder(const Options& options) : options_(options) {}

  /// A reading that is not finite, has a negative horizontal part or lies more than 1000 km out is
  /// passed over.
  void add(core::FloorId floor, const core::Vector2& position_m, double horizontal_ut,
           double vertical_ut);
  /// By floor, then row by row. Same input in the same order gives the same bytes.
  MagneticMapStorage build() const;

 private:
  struct CellKey {
    std::uint16_t floor = 0;
    std::int32_t row = 0;
    std::int32_t column = 0;
    auto operator<=>(const CellKey&) const = default;
  };
  /// Sums; the field's from `first`, so that its scatter keeps its digits.
  struct Cell {
    std::uint32_t count = 0;
    core::Vector2 position_sum_m = core::Vector2::Zero();
    core::Vector2 first_ut = core::Vector2::Zero();
    core::Vector2 sum_ut = core::Vector2::Zero();
    double square_sum_ut2 = 0.0;
  };

  static MagneticPoint point_of(core::FloorId floor, const Cell& cell);

  Options options_;
  std::map<CellKey, Cell> cells_;
};

}  // namespace waylode::site
