// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "waylode/site/site.hpp"
#include "waylode/survey/labelled_path.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::survey {

/// How far marks are turned against dead reckoning, from stretches long enough to tell; the robust
/// circular centre. nullopt with fewer than ten such stretches.
std::optional<double> heading_offset(std::span<const LabelledPath::Stretch> stretches);

/// The build's figures, floor by floor.
std::vector<FloorQuality> floor_quality(
    const site::SiteParts& parts, const std::vector<std::vector<LabelledPath::Stretch>>& stretches,
    const std::vector<std::set<std::uint32_t>>& recordings);

/// Share of the floor's area within `reach_m` of a fingerprint, on a 1 m raster of the walkable
/// area (of the fingerprints' box when the plan is not known). 0 without fingerprints.
double covered_ratio(const site::Floor& floor,
                     std::span<const site::FingerprintRecord> fingerprints, double reach_m);

}  // namespace waylode::survey
