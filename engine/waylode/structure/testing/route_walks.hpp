// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/structure/walk.hpp"

namespace waylode::structure::testing {

/// A way along points whose names may be empty.
struct Stop {
  core::Vector2 position_m;
  std::string name;
};

/// How one person measures.
struct Walker {
  double offset_rad = 0.0;     ///< Of the walk's frame against the true one.
  double reading_ratio = 1.0;  ///< Measured over true length.
  double length_sigma_ratio = 0.02;
  double direction_sigma_rad = 0.03;
};

/// The walk that measures the truth, but for the walker's offset and scale.
inline Walk exact_walk(const std::vector<Stop>& stops, const Walker& walker) {
  Walk walk;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const core::Vector2 way_m = stops[i].position_m - stops[i - 1].position_m;
    WalkedSegment segment;
    segment.begin = core::device_time_from_seconds(10.0 * static_cast<double>(i - 1));
    segment.end = core::device_time_from_seconds(10.0 * static_cast<double>(i) - 1.0);
    segment.length_m = walker.reading_ratio * way_m.norm();
    segment.length_sigma_m = walker.length_sigma_ratio * way_m.norm() + 1e-3;
    segment.direction_rad = std::atan2(way_m.y(), way_m.x()) - walker.offset_rad;
    segment.direction_sigma_rad = walker.direction_sigma_rad;
    segment.begin_landmark = stops[i - 1].name;
    segment.end_landmark = stops[i].name;
    walk.segments.push_back(segment);
  }
  return walk;
}

/// The same with the random errors that the segments' sigmas state.
inline Walk noisy_walk(const std::vector<Stop>& stops, const Walker& walker, core::Rng& rng) {
  Walk walk = exact_walk(stops, walker);
  for (WalkedSegment& segment : walk.segments) {
    segment.length_m = std::abs(segment.length_m + rng.normal(0.0, segment.length_sigma_m));
    segment.direction_rad += rng.normal(0.0, segment.direction_sigma_rad);
  }
  return walk;
}

/// Where `positions_m` come to lie when shifted and rotated (not scaled) onto `truth_m` as well as
/// can be.
inline std::vector<core::Vector2> aligned(std::span<const core::Vector2> positions_m,
                                          std::span<const core::Vector2> truth_m) {
  core::Vector2 from_m = core::Vector2::Zero();
  core::Vector2 to_m = core::Vector2::Zero();
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    from_m += positions_m[i] / static_cast<double>(truth_m.size());
    to_m += truth_m[i] / static_cast<double>(truth_m.size());
  }
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    const core::Vector2 a = positions_m[i] - from_m;
    const core::Vector2 b = truth_m[i] - to_m;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Eigen::Rotation2Dd rotation(std::atan2(across, along));
  std::vector<core::Vector2> result;
  for (const core::Vector2& position_m : positions_m) {
    result.emplace_back(rotation * (position_m - from_m) + to_m);
  }
  return result;
}

}  // namespace waylode::structure::testing
