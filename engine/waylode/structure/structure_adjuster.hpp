// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/structure/adjusted_structure.hpp"
#include "waylode/structure/walk.hpp"

namespace waylode::structure {

/// Many walks, each with its own heading offset and step scale, adjusted into one floor: a
/// least-squares pose graph over their segments, [Zhong2017] 4, where lengths and angles of
/// different people correct each other.
class StructureAdjuster {
 public:
  struct Options {
    double scale_sigma_ratio = 0.05;  ///< Of the scale common to all walks, around 1; 0.001 to 0.5.
    double person_sigma_ratio = 0.03;  ///< Of walks' scales around the common; 0.001 to 0.5.
    double landmark_sigma_m = 0.3;     ///< How far from a landmark one passes it; 0.001 to 5.
    double segment_loss_sigma = 2.0;   ///< Huber's corner for segments, in sigmas; 0.5 to 100.
    double closure_loss_sigma = 2.0;   ///< Cauchy's scale for closures, in sigmas; 0.5 to 100.
    /// A closure goes when leaving it out saves more than this of chi-square with two degrees of
    /// freedom; 5 to 1000. Larger keeps more wrong ones, smaller drops more good ones.
    double rejection_chi_square = 20.0;

    bool match_routes = true;  ///< Join corners of walks over the same route without names.
    double route_turn_tolerance_rad = 0.45;      ///< Between two walks' turns; 0 to 0.7.
    double route_length_tolerance_ratio = 0.25;  ///< Between lengths, scales levelled; 0 to 1.
    std::size_t route_least_segments = 3;        ///< Of a whole walk without names; 2 or more.

    bool find_closures = true;        ///< Where a walk comes back to an earlier corner.
    double closure_sigma_m = 0.5;     ///< Of such a corner's two passages; 0.001 to 5.
    double closure_reach_m = 5.0;     ///< Gap at most, before it is closed; 0 to 100.
    double closure_gate_sigma = 3.0;  ///< The same in standard deviations of the gap; 0 to 10.

    double corner_sigma_rad = 0.0175;     ///< Right angles are right to this; 0 leaves them free.
    double parallel_sigma_rad = 0.0175;   ///< Parallel corridors; 0 leaves them free.
    double regular_tolerance_rad = 0.21;  ///< From regular, to be thought regular; 0 to 0.5.
    double regular_least_m = 2.0;         ///< Shorter edges have no direction to speak of; > 0.

    std::size_t starts = 3;  ///< Walks that the rest is chained to in turn; 1 to 100.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit StructureAdjuster(const Options& options) : options_(options) {}

  /// kInvalidOptions, kInvalidArgument for a survey that is not valid, kSurveyInsufficient when no
  /// walk leads anywhere. Walks that share fewer than two places with the others are left out, and
  /// said so; the largest group of walks remains. Equal input, equal output.
  core::Result<AdjustedStructure> adjust(const Survey& survey) const;

 private:
  Options options_;
};

}  // namespace waylode::structure
