// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::structure::detail {

/// A walk's unknowns beside its nodes. What it measures of a true displacement: the length times
/// `reading_ratio`, the direction less `heading_offset_rad`.
struct WalkState {
  double heading_offset_rad = 0.0;
  double reading_ratio = 1.0;
};

struct SegmentTerm {
  std::size_t from = 0;
  std::size_t to = 0;
  std::size_t walk = 0;
  double length_m = 0.0;
  double length_sigma_m = 0.0;
  double direction_rad = 0.0;
  double direction_sigma_rad = 0.0;
};

/// Two nodes are one place.
struct TieTerm {
  std::size_t a = 0;
  std::size_t b = 0;
  double sigma_m = 0.0;
};

/// The turn from before->at to at->after is a right angle, whichever is nearer, left or right.
struct CornerTerm {
  std::size_t before = 0;
  std::size_t at = 0;
  std::size_t after = 0;
};

/// The line through two nodes has the direction of an axis, modulo half a turn.
struct AxisTerm {
  std::size_t from = 0;
  std::size_t to = 0;
  std::size_t axis = 0;
};

struct DistanceTerm {
  std::size_t a = 0;
  std::size_t b = 0;
  double metres = 0.0;
  double sigma_m = 0.0;
};

/// Unknowns at their present values, and what binds them. All nodes must hang together rigidly.
struct PoseGraph {
  std::vector<core::Vector2> nodes_m;
  std::vector<WalkState> walks;
  std::vector<double> axes_rad;
  double common_ratio = 1.0;  ///< Around which the walks' reading ratios lie.

  std::vector<SegmentTerm> segments;
  std::vector<TieTerm> ties;
  std::vector<CornerTerm> corners;
  std::vector<AxisTerm> axis_terms;
  std::vector<DistanceTerm> distances;

  // Gauge: these stay where they are.
  std::size_t fixed_node = 0;
  std::size_t fixed_walk = 0;  ///< Its heading offset.
};

struct PoseGraphOptions {
  double scale_sigma_ratio = 0.05;   ///< Of the common ratio around one.
  double person_sigma_ratio = 0.03;  ///< Of walks' ratios around the common one.
  double segment_loss_sigma = 2.0;
  double tie_loss_sigma = 2.0;
  double corner_sigma_rad = 0.0175;
  double parallel_sigma_rad = 0.0175;
};

struct SolveSummary {
  bool converged = false;
  double cost = 0.0;
  std::size_t degrees_of_freedom = 0;
};

/// Moves the unknowns to the nearest least cost.
SolveSummary solve(PoseGraph& graph, const PoseGraphOptions& options);

/// Of the unknowns where they are, in the graph's gauge: nodes (x, y each), then walks' heading
/// offsets and reading ratios (two each). Zero where fixed. Empty when the unknowns are not all
/// determined.
Eigen::MatrixXd covariance_of(const PoseGraph& graph, const PoseGraphOptions& options);

}  // namespace waylode::structure::detail
