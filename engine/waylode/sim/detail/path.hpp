// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::sim::detail {

/// A polyline by arc length, with a heading that turns evenly from vertex to vertex.
class Path {
 public:
  /// At least two vertices that differ. Repeated vertices are dropped.
  explicit Path(const std::vector<core::Vector2>& vertices_m);

  double length_m() const { return arc_m_.back(); }
  core::Vector2 position_m(double arc_m) const;
  /// Continuous along the path, so not wrapped.
  double heading_rad(double arc_m) const;
  /// The arc length of the vertex that comes nearest to `position_m`, at or after `from_arc_m`
  /// and before the path turns away for good.
  double nearest_arc_m(const core::Vector2& position_m, double from_arc_m) const;

 private:
  std::size_t piece_at(double arc_m) const;

  std::vector<core::Vector2> vertices_m_;
  std::vector<double> arc_m_;
  std::vector<double> heading_rad_;  ///< At vertices.
};

}  // namespace waylode::sim::detail
