// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::observation {

/// How well a scan fits the places of a floor: log-likelihood at the nodes of a raster, up to a
/// constant common to all nodes and floors of the scan. A view of one scan; floor frame.
struct LikelihoodRaster {
  core::Vector2 origin_m = core::Vector2::Zero();  ///< Of the first node.
  double node_m = 2.0;                             ///< Between nodes.
  std::size_t columns = 0;                         ///< Along x.
  std::size_t rows = 0;                            ///< Along y.
  std::vector<float> log_likelihood;               ///< Row by row.
  float elsewhere = 0.0F;                          ///< Off the raster.

  bool empty() const { return log_likelihood.empty(); }

  core::Vector2 node_at(std::size_t row, std::size_t column) const {
    return origin_m + node_m * core::Vector2(static_cast<double>(column), static_cast<double>(row));
  }

  /// Bilinear between the nodes; `elsewhere` off them and for a position that is not finite.
  double at(const core::Vector2& position_m) const {
    const core::Vector2 place = (position_m - origin_m) / node_m;
    const auto last_column = static_cast<double>(columns) - 1.0;
    const auto last_row = static_cast<double>(rows) - 1.0;
    const bool inside =
        place.x() >= 0.0 && place.y() >= 0.0 && place.x() <= last_column && place.y() <= last_row;
    if (!inside) return static_cast<double>(elsewhere);
    const auto column =
        static_cast<std::size_t>(std::max(0.0, std::min(place.x(), last_column - 1.0)));
    const auto row = static_cast<std::size_t>(std::max(0.0, std::min(place.y(), last_row - 1.0)));
    const double right = columns > 1 ? place.x() - static_cast<double>(column) : 0.0;
    const double up = rows > 1 ? place.y() - static_cast<double>(row) : 0.0;
    const auto value = [&](std::size_t r, std::size_t c) {
      return static_cast<double>(
          log_likelihood[std::min(r, rows - 1) * columns + std::min(c, columns - 1)]);
    };
    return (1.0 - up) * ((1.0 - right) * value(row, column) + right * value(row, column + 1)) +
           up * ((1.0 - right) * value(row + 1, column) + right * value(row + 1, column + 1));
  }

  bool operator==(const LikelihoodRaster&) const = default;
};

}  // namespace waylode::observation
