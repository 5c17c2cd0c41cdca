// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/sim/building.hpp"
#include "waylode/sim/detail/nav_grid.hpp"
#include "waylode/sim/detail/path.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

/// A walk without a stop: on one floor, or up or down one storey of stairs.
struct Stroke {
  Path path;
  core::FloorId floor;
  core::FloorId end_floor;  ///< Another floor on stairs only.
  double pause_before_s = 0.0;
  std::vector<double> taps_arc_m;  ///< Where named places are passed, rising.

  bool is_stairs() const { return floor != end_floor; }
};

/// The strokes through the named places, one after another; the walker stands between two. The
/// first place is tapped at arc 0 of the first stroke. kScenarioInvalid when a place is unknown or
/// there is no way to it.
core::Result<std::vector<Stroke>> plan_route(const Building& building,
                                             const std::vector<NavGrid>& grids,
                                             const std::vector<std::string>& places,
                                             const GaitOptions& options, core::Rng& rng);

}  // namespace waylode::sim::detail
