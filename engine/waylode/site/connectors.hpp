// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "waylode/core/geometry.hpp"
#include "waylode/site/site.hpp"

namespace waylode::site {

/// "stairs", "lift", "escalator", "ramp".
const char* name_of(ConnectorKind kind);
std::optional<ConnectorKind> connector_kind(std::string_view name);

/// Whether one may get from here to another level: it is listed, or nothing is.
bool may_lead_to(const Connector& connector, int level);

struct NearestConnector {
  std::size_t index = 0;    ///< In Plan::connectors.
  double distance_m = 0.0;  ///< Straight, whatever is in the way.
};

/// The nearest way off the floor, or to `level` when one is given; the first of equals. nullopt
/// when none is drawn or the point is not finite: that tells nothing about a change of floor.
std::optional<NearestConnector> nearest_connector(const Plan& plan, const core::Vector2& point_m,
                                                  std::optional<int> level = std::nullopt);

/// Where one comes out on floor `to` that takes `entry` on floor `from`: the entry of the same kind
/// and name nearest in the site frame, else, when `to` has none of that name, the same place.
/// nullopt when the entry does not lead to the floor.
std::optional<core::Vector2> connector_exit_m(const Site& site, core::FloorId from,
                                              const Connector& entry, core::FloorId to);

}  // namespace waylode::site
