// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "waylode/eval/evaluated_track.hpp"

namespace waylode::eval {

/// How one fix compares with its truth.
struct PointError {
  double horizontal_m = 0.0;  ///< Through the common frame when the floor is wrong.
  int floors_wrong = 0;     ///< Difference of level ordinals; at least 1 on a wrong floor or none.
  bool has_belief = false;  ///< Without one, horizontal_m is half the diagonal of the true floor.
  /// Of the error in the truth's floor frame against the stated covariance; infinite on a wrong
  /// floor, without a belief, and for a covariance that is not positive definite.
  double squared_mahalanobis = 0.0;
  bool inside_68 = false;  ///< Truth inside the stated region (right floor needed).
  bool inside_95 = false;
  double region_95_m2 = 0.0;  ///< Area of the stated region; NaN where none is stated.
  core::FixState state = core::FixState::kUnknown;
  double since_start_s = 0.0;  ///< Since the track's first truth.
};

/// The error of one fix. The belief's mean is read whatever the state says; a mean that is not
/// finite is no belief. Floors must be floors of `site`.
PointError point_error(const site::Site& site, const TruthPoint& truth, const core::Fix& fix,
                       core::DeviceTime track_start);

/// The errors of a track's scored truths, in order. `fixes` must be parallel to `truths`.
std::vector<PointError> track_errors(const EvaluatedTrack& track);

/// The row of the evaluation's table. Means, ratios and percentiles over scored truths; NaN where
/// there are none. Percentiles interpolate linearly between order statistics.
struct Metrics {
  std::uint64_t n = 0;  ///< Scored truths.
  double mean_m = 0.0;
  double p50_m = 0.0;
  double p75_m = 0.0;
  double p90_m = 0.0;
  double p95_m = 0.0;
  double ipin_p75_m = 0.0;  ///< Third quartile of error + 15 m per wrong floor.
  double floor_hit_ratio = 0.0;
  double inside_68_ratio = 0.0;
  double inside_95_ratio = 0.0;
  double unknown_ratio = 0.0;       ///< Fixes whose state is unknown.
  std::uint64_t n_before_scan = 0;  ///< Truths that were not scored.
  std::uint64_t n_ok = 0;           ///< Scored truths whose fix is in state ok.
  double ok_mean_m = 0.0;
  double after10s_mean_m = 0.0;        ///< Truths at least 10 s after the track's first truth.
  double trace_floor_hit_ratio = 0.0;  ///< Tracks whose majority of scored fixes has the floor.
  double within_1_m = 0.0;             ///< Share of errors of at most 1 m; likewise the next three.
  double within_1p5_m = 0.0;
  double within_2_m = 0.0;
  double within_3_m = 0.0;
  double region_95_median_m2 = 0.0;  ///< Over fixes with a belief.
  double walked_s = 0.0;             ///< Summed over tracks, as is cpu_s.
  double cpu_s = 0.0;
};

/// Exact in any order of `tracks`: sums run over sorted values.
Metrics compute_metrics(std::span<const EvaluatedTrack* const> tracks);

struct ResultRow {
  std::string method;
  std::string group;  ///< "all", "covered" or "<site>/<floor>".
  Metrics metrics;
};

/// Rows for every method: "all", then "covered" when `with_covered`, then each group by name.
/// Methods in the order of their first appearance.
std::vector<ResultRow> summarise(std::span<const EvaluatedTrack> tracks, bool with_covered);

}  // namespace waylode::eval
