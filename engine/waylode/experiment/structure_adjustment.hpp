// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/structure/structure_adjuster.hpp"

namespace waylode::experiment {

/// The true way of the walks: straight stretches and the turns between them (counter-clockwise).
struct StructureRoute {
  std::vector<double> lengths_m = {20.0, 15.0, 15.0};
  std::vector<double> turns_deg = {90.0, 90.0};
};

/// How segments of single walks err, as the gait simulation of the papers' specification measured
/// it: scale in common and by person, each segment, each corner.
struct WalkStatistics {
  double common_bias_ratio = -0.025;
  double person_sigma_ratio = 0.03;
  double segment_sigma_ratio = 0.02;
  double corner_mean_abs_deg = 2.6;  ///< Of Gaussian errors; the direction offset is any.
};

/// Walks over the route with errors drawn from the statistics.
std::vector<structure::Walk> simulate_walks(const StructureRoute& route,
                                            const WalkStatistics& statistics, std::size_t count,
                                            core::Rng& rng);

/// How good a map of many walks is, [Zhong2017] 4: repeated draws of some of the walks given.
struct StructureAdjustmentOptions {
  StructureRoute route;
  std::size_t walks_per_draw = 10;
  std::size_t draws = 60;         ///< Each without replacement; draws share walks.
  std::size_t known_segment = 0;  ///< The one whose true length is known.
  double known_sigma_m = 0.02;
  std::uint64_t seed = 1;
  structure::StructureAdjuster::Options adjuster;
};

struct RouteErrors {
  Interval length_pct;          ///< Mean |error| of segments' lengths, relative.
  Interval unknown_length_pct;  ///< The same without the segment whose length is known.
  Interval corner_deg;          ///< Mean |error| of the corners' angles.
};

struct StructureAdjustmentStudy {
  std::size_t walks = 0;     ///< That have the route's segments and turn as it does.
  std::size_t left_out = 0;  ///< The others.
  RouteErrors single;        ///< One walk as it is.
  RouteErrors mean;          ///< Plain mean of a draw's lengths and turns.
  RouteErrors scaled_mean;   ///< The same, scaled to the known segment.
  RouteErrors evidence;      ///< Adjusted, without wishing for right angles and parallels.
  RouteErrors adjusted;      ///< Adjusted.
};

/// `walks` are measured or simulated, their landmarks are not looked at: visits are named by their
/// order. kInvalidArgument when fewer than `walks_per_draw` follow the route.
core::Result<StructureAdjustmentStudy> study_structure_adjustment(
    std::span<const structure::Walk> walks, const StructureAdjustmentOptions& options);

/// Beside the paper's figures. `data` says what the walks are.
Outcome structure_adjustment_outcome(const StructureAdjustmentStudy& study,
                                     const StructureAdjustmentOptions& options, std::string data);

}  // namespace waylode::experiment
