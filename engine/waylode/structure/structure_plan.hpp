// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "waylode/core/result.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/structure/adjusted_structure.hpp"

namespace waylode::structure {

struct PlanOptions {
  std::string floor = "F1";       ///< The floor's name; not empty.
  double corridor_width_m = 2.0;  ///< Wall to wall; 0.2 to 50.
  double landmark_size_m = 1.0;   ///< Side of the square that stands for a landmark; 0.1 to 50.

  core::Result<void> validate() const;
  bool operator==(const PlanOptions&) const = default;
};

/// The structure as a plan: corridors of one width around the edges are walkable, their outline is
/// walls, every named landmark a room of its name. site::format_plan writes it and site::parse_plan
/// reads the same back. kInvalidOptions; kSurveyInsufficient for a structure without edges.
core::Result<site::FloorDraft> to_plan(const AdjustedStructure& structure,
                                       const PlanOptions& options);

}  // namespace waylode::structure
