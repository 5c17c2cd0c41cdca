// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "waylode/site/floor.hpp"

namespace waylode::site::detail {

/// The edges of the plan's walkable areas and obstacles. An edge that neighbours share (ends equal
/// to a millimetre, either direction) comes once, where it is first met.
std::vector<Wall> edges_of(const Plan& plan);

/// The plan's walls, then the edges of its obstacles that are not among them.
std::vector<Wall> walls_with_obstacle_edges(const Plan& plan);

/// The same, apart: what is an edge of a walkable area or obstacle, and what stands by itself.
struct Barriers {
  std::vector<Wall> edges;
  std::vector<Wall> thin_walls;
};
Barriers barriers_of(const Plan& plan);

}  // namespace waylode::site::detail
