// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"

/// What the methods of nearest neighbours share.
namespace waylode::radio::detail {

/// covariance = base_sigma_m^2 I + gain * weighted scatter of the neighbours about their mean.
struct Spread {
  double base_sigma_m = 2.0;
  double gain = 1.0;
};

/// The weighted mean of the candidates. Weights are made to sum to one; some must be positive.
observation::FloorHypothesis locate(core::FloorId floor,
                                    std::vector<observation::RadioCandidate> candidates,
                                    const Spread& spread);

struct Vote {
  core::FloorId floor;
  double weight = 0.0;
};

/// Logarithms of the floors' shares in the votes. A tenth stays doubt, so that no floor is ruled
/// out. Every vote is for one of `floors`, which are not repeated.
std::map<core::FloorId, double> log_shares(std::span<const core::FloorId> floors,
                                           std::span<const Vote> votes);

/// The points of a floor that a scan is compared with.
struct FloorCandidates {
  core::FloorId floor;
  std::vector<std::uint32_t> points;
};

struct NearestOptions {
  std::size_t neighbours = 4;
  bool weighted = true;  ///< By the inverse of the distance; else all alike.
  Compared compared = Compared::kUnion;
  Spread spread{};
};

/// On every floor the nearest of its candidates; the nearest of all vote for the floors. nullopt
/// when no candidate can be compared.
std::optional<Positioning> position_by_nearest(const ReferenceMap& map, const Query& query,
                                               const ReferenceQuery& heard,
                                               std::span<const FloorCandidates> candidates,
                                               const NearestOptions& options);

/// All points of all floors, or of one.
std::vector<FloorCandidates> all_points(const ReferenceMap& map,
                                        std::optional<core::FloorId> only_floor);

/// What heard holds, the strongest first; Bluetooth after all else.
std::vector<ReferenceQuery::Heard> by_strength(const ReferenceMap& map,
                                               const ReferenceQuery& heard);

/// What is asked of the options that all methods of nearest neighbours have.
core::Result<void> validate_nearest(std::size_t neighbours, double base_sigma_m, double spread_gain,
                                    const char* place);

}  // namespace waylode::radio::detail
