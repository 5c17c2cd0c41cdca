// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/path.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/core/assert.hpp"

namespace waylode::sim::detail {

using core::Vector2;

Path::Path(const std::vector<Vector2>& vertices_m) {
  constexpr double kSame_m = 1e-6;
  for (const Vector2& vertex : vertices_m) {
    if (!vertices_m_.empty()) {
      const double step_m = (vertex - vertices_m_.back()).norm();
      if (step_m < kSame_m) continue;
      arc_m_.push_back(arc_m_.back() + step_m);
    } else {
      arc_m_.push_back(0.0);
    }
    vertices_m_.push_back(vertex);
  }
  WAYLODE_ASSERT(vertices_m_.size() >= 2);
  std::vector<double> piece_rad;
  for (std::size_t i = 1; i < vertices_m_.size(); ++i) {
    const Vector2 along = vertices_m_[i] - vertices_m_[i - 1];
    const double heading_rad = std::atan2(along.y(), along.x());
    const double last_rad = piece_rad.empty() ? heading_rad : piece_rad.back();
    piece_rad.push_back(last_rad + core::wrap_angle(heading_rad - last_rad));
  }
  heading_rad_.push_back(piece_rad.front());
  for (std::size_t i = 1; i < piece_rad.size(); ++i) {
    heading_rad_.push_back(0.5 * (piece_rad[i - 1] + piece_rad[i]));
  }
  heading_rad_.push_back(piece_rad.back());
}

std::size_t Path::piece_at(double arc_m) const {
  const auto above = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, arc_m);
  return static_cast<std::size_t>(above - arc_m_.begin()) - 1;
}

Vector2 Path::position_m(double arc_m) const {
  const std::size_t i = piece_at(arc_m);
  const double ratio = std::clamp((arc_m - arc_m_[i]) / (arc_m_[i + 1] - arc_m_[i]), 0.0, 1.0);
  return vertices_m_[i] + ratio * (vertices_m_[i + 1] - vertices_m_[i]);
}

double Path::heading_rad(double arc_m) const {
  const std::size_t i = piece_at(arc_m);
  const double ratio = std::clamp((arc_m - arc_m_[i]) / (arc_m_[i + 1] - arc_m_[i]), 0.0, 1.0);
  return heading_rad_[i] + ratio * (heading_rad_[i + 1] - heading_rad_[i]);
}

double Path::nearest_arc_m(const Vector2& position_m, double from_arc_m) const {
  // Later passes of the same place are somebody else's: stop once clearly past the first approach.
  constexpr double kPast_m = 1.5;
  constexpr double kNear_m = 2.0;
  double best_m = 1e300;
  double best_arc_m = from_arc_m;
  for (std::size_t i = 0; i < vertices_m_.size(); ++i) {
    if (arc_m_[i] < from_arc_m) continue;
    const double distance_m = (vertices_m_[i] - position_m).norm();
    if (distance_m < best_m) {
      best_m = distance_m;
      best_arc_m = arc_m_[i];
    } else if (best_m < kNear_m && distance_m > best_m + kPast_m) {
      break;
    }
  }
  return best_arc_m;
}

}  // namespace waylode::sim::detail
