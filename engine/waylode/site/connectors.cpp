// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/connectors.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "waylode/core/assert.hpp"

namespace waylode::site {
namespace {

using core::Vector2;

constexpr std::array kNames = {
    std::pair(ConnectorKind::kStairs, "stairs"), std::pair(ConnectorKind::kLift, "lift"),
    std::pair(ConnectorKind::kEscalator, "escalator"), std::pair(ConnectorKind::kRamp, "ramp")};

/// Index and distance of the nearest connector that `takes(connector)` holds for.
template <typename Takes>
std::optional<NearestConnector> nearest_of(const Plan& plan, const Vector2& point_m,
                                           Takes&& takes) {
  std::optional<NearestConnector> nearest;
  for (std::size_t i = 0; i < plan.connectors.size(); ++i) {
    if (!takes(plan.connectors[i])) continue;
    const double distance_m = (plan.connectors[i].position_m - point_m).norm();
    // False for NaN.
    if (distance_m < (nearest ? nearest->distance_m : std::numeric_limits<double>::infinity())) {
      nearest = NearestConnector{i, distance_m};
    }
  }
  return nearest;
}

}  // namespace

const char* name_of(ConnectorKind kind) {
  const auto* const found = std::ranges::find(kNames, kind, [](const auto& e) { return e.first; });
  WAYLODE_ASSERT(found != kNames.end());
  return found->second;
}

std::optional<ConnectorKind> connector_kind(std::string_view name) {
  for (const auto& [kind, known] : kNames) {
    if (name == known) return kind;
  }
  return std::nullopt;
}

bool may_lead_to(const Connector& connector, int level) {
  return connector.levels.empty() ||
         std::ranges::find(connector.levels, level) != connector.levels.end();
}

std::optional<NearestConnector> nearest_connector(const Plan& plan, const Vector2& point_m,
                                                  std::optional<int> level) {
  if (!point_m.allFinite()) return std::nullopt;
  return nearest_of(plan, point_m, [&](const Connector& connector) {
    return !level || may_lead_to(connector, *level);
  });
}

std::optional<Vector2> connector_exit_m(const Site& site, core::FloorId from,
                                        const Connector& entry, core::FloorId to) {
  const Floor& there = site.floor(to);
  if (from == to || !may_lead_to(entry, there.level) || !entry.position_m.allFinite()) {
    return std::nullopt;
  }
  const Vector2 above_m = site.floor_from_site(to, site.site_from_floor(from, entry.position_m));
  if (entry.name.empty()) return above_m;
  const auto nearest = nearest_of(there.plan, above_m, [&](const Connector& other) {
    return other.kind == entry.kind && other.name == entry.name;
  });
  return nearest ? there.plan.connectors[nearest->index].position_m : above_m;
}

}  // namespace waylode::site
