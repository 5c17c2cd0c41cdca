// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::site {

/// A ring of vertices, floor frame metres, not closed (the last vertex differs from the first).
using Ring = std::vector<core::Vector2>;

struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
  bool operator==(const Polygon&) const = default;
};

/// A wall or the edge of an obstacle: a person does not cross it.
struct Wall {
  core::Vector2 from_m;
  core::Vector2 to_m;
  bool operator==(const Wall&) const = default;
};

struct Room {
  std::string name;
  Polygon outline;
  bool operator==(const Room&) const = default;
};

/// A way through walls: within this circle no wall or edge of an obstacle is in the way.
struct Door {
  core::Vector2 position_m;  ///< Its middle.
  double width_m = 0.0;      ///< Diameter of the circle, positive.
  bool operator==(const Door&) const = default;
};

enum class ConnectorKind : std::uint8_t { kStairs, kLift, kEscalator, kRamp };

/// Where people leave this floor for others, or come out. The entries of one staircase or lift have
/// the same kind and name on all its floors.
struct Connector {
  ConnectorKind kind = ConnectorKind::kStairs;
  std::string name;          ///< May be empty: then the entry stands for itself.
  core::Vector2 position_m;  ///< On this floor.
  std::vector<int> levels;   ///< One gets from here to these; empty: not known, so perhaps to any.
  bool operator==(const Connector&) const = default;
};

/// What is drawn on a floor. Empty members mean "not known", never "nothing there".
struct Plan {
  std::vector<Polygon> walkable;   ///< Outlines: where people can be unless an obstacle is there.
  std::vector<Polygon> obstacles;  ///< Shops, shafts, blocks as drawn; they win over `walkable`.
  std::vector<Wall> walls;
  std::vector<Room> rooms;
  std::vector<Door> doors{};
  std::vector<Connector> connectors{};
  bool operator==(const Plan&) const = default;
};

/// One storey. Floor frame: metres, x east-ish, y north-ish on the plan, right-handed. Each floor
/// has its own origin; positions of different floors meet in the site frame (docs/frames.md).
struct Floor {
  std::string name;
  int level = 0;             ///< Ordinal: ground 0, basements negative. Differences count floors.
  double elevation_m = 0.0;  ///< Above the site's ground floor.
  core::Bounds2 bounds;      ///< Extent of the plan or, without one, of the survey.
  core::Affine2 site_from_floor;
  /// Heading on the site frame = PDR heading + this; learnt from the survey (declination left over,
  /// plan rotation). 0 until learnt.
  double heading_offset_rad = 0.0;
  Plan plan;

  bool operator==(const Floor&) const = default;
};

}  // namespace waylode::site
