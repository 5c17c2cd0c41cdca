// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"

namespace waylode::site::detail {

/// Twice the area of the triangle: positive when `point` is left of the way from `a` to `b`.
inline double turn(const core::Vector2& a, const core::Vector2& b, const core::Vector2& point) {
  return (b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x());
}

/// Whether the way crosses the wall from `a` to `b`: its ends are on different sides (the line
/// itself is left) and it meets the wall, the wall's ends included.
inline bool crosses(const core::Vector2& a, const core::Vector2& b, const core::Vector2& from,
                    const core::Vector2& to) {
  if ((turn(a, b, from) >= 0.0) == (turn(a, b, to) >= 0.0)) return false;
  const double side_of_a = turn(from, to, a);
  const double side_of_b = turn(from, to, b);
  return (side_of_a <= 0.0 && side_of_b >= 0.0) || (side_of_a >= 0.0 && side_of_b <= 0.0);
}

}  // namespace waylode::site::detail
