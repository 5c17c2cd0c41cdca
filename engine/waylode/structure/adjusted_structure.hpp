// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::structure {

/// A corner, a junction, an end or a landmark.
struct StructureNode {
  core::Vector2 position_m = core::Vector2::Zero();
  /// With shift and rotation of the whole taken out (inner constraints); semi-definite.
  core::Matrix2 covariance_m2 = core::Matrix2::Zero();
  std::string landmark;            ///< Empty when it has no name.
  std::vector<std::string> notes;  ///< In the order given.
  std::size_t visits = 0;          ///< How often walks met it.

  bool operator==(const StructureNode&) const = default;
};

/// The centre line of a corridor between two nodes.
struct StructureEdge {
  std::size_t from = 0;  ///< Index into nodes.
  std::size_t to = 0;
  double length_m = 0.0;
  double length_sigma_m = 0.0;
  double direction_rad = 0.0;  ///< From `from` to `to`, counter-clockwise from +x.
  double direction_sigma_rad = 0.0;
  std::size_t walked = 0;  ///< How many segments, either way.

  bool operator==(const StructureEdge&) const = default;
};

/// What the adjustment found out about a walk.
struct AdjustedWalk {
  bool used = false;                ///< Otherwise nothing rigid ties it to the rest.
  double heading_offset_rad = 0.0;  ///< Structure's direction = the walk's + this.
  double scale_ratio = 1.0;         ///< True length = the walk's length times this.
  double scale_sigma_ratio = 0.0;
  std::vector<std::size_t> nodes;  ///< Visit by visit, into nodes; empty when not used.

  bool operator==(const AdjustedWalk&) const = default;
};

/// An end of a walk's segment.
struct Visit {
  std::size_t walk = 0;
  std::size_t visit = 0;

  bool operator==(const Visit&) const = default;
};

/// The statement that two visits met the same place.
struct Closure {
  Visit first;
  Visit second;
  std::string landmark;  ///< By whose name; empty when geometry alone said so.
  double gap_m = 0.0;    ///< That remains between them.

  bool operator==(const Closure&) const = default;
};

/// One floor's corridors. Frame: the first node at the origin, the first edge along +x.
struct AdjustedStructure {
  std::vector<StructureNode> nodes;  ///< In the order they were first met.
  std::vector<StructureEdge> edges;
  std::vector<AdjustedWalk> walks;  ///< As the survey's.

  /// False: no known distance, so all lengths share an unknown factor of `scale_sigma_ratio`.
  bool scale_known = false;
  double scale_sigma_ratio = 0.0;

  bool converged = false;
  double cost = 0.0;                   ///< Half the sum of squared, weighted residuals.
  std::size_t degrees_of_freedom = 0;  ///< Residuals less unknowns.
  std::vector<Closure> found;          ///< By geometry alone, and kept.
  std::vector<Closure> rejected;       ///< Contradicted by the rest.
  std::vector<std::string> notes;      ///< What was left out and why, one sentence each.

  bool operator==(const AdjustedStructure&) const = default;
};

}  // namespace waylode::structure
