// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/structure/detail/places.hpp"
#include "waylode/structure/walk.hpp"

namespace waylode::structure::detail {

/// The visits of a walk as measured, in the walk's own frame, the first at the origin.
std::vector<core::Vector2> chain_of(const Walk& walk);

/// Where walks lie before the adjustment: chained to each other by the places they share.
struct Layout {
  struct Pose {
    double heading_offset_rad = 0.0;
    double scale_ratio = 1.0;
    core::Vector2 shift_m = core::Vector2::Zero();

    core::Vector2 operator*(const core::Vector2& point_m) const {
      return scale_ratio * (Eigen::Rotation2Dd(heading_offset_rad) * point_m) + shift_m;
    }
  };
  std::vector<std::optional<Pose>> walks;  ///< Of walks that can be reached.
  std::vector<std::optional<core::Vector2>> places_m;

  std::size_t reached() const;
};

/// Starts with `base` in its own frame and scale and adds the walk that most places agree on, while
/// two or more do.
Layout lay_out(std::span<const Walk> walks, const Places& places, std::size_t base);

}  // namespace waylode::structure::detail
