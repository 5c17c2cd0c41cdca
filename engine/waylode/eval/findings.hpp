// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "waylode/eval/bootstrap.hpp"
#include "waylode/eval/evaluated_track.hpp"
#include "waylode/eval/scan_periods.hpp"

namespace waylode::eval {

/// Share of truths inside the region stated for a probability.
struct ReliabilityPoint {
  double stated_ratio = 0.0;
  double inside_ratio = 0.0;
};

/// Errors of truths in [from_s, to_s) since their track's first truth; the last span has no end.
struct TimeSpanError {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  std::uint64_t n = 0;
  double mean_m = 0.0;  ///< NaN without any.
};

/// Marked changes of floor, each lasting until the next one or the track's end. A change is found
/// with the first fix on the new floor; the delay counts from the first mark there. Fixes are
/// looked at every second (EvaluatedTrack::path) and at the marks.
struct FloorChanges {
  std::uint64_t n = 0;
  std::uint64_t found = 0;
  double median_s = 0.0;  ///< Delay of the found ones; NaN without any, as is the next.
  double worst_s = 0.0;
  double within_10s_ratio = 0.0;  ///< Of all; NaN without any.
};

/// What the table has no room for, of one method on one group.
struct MethodFindings {
  std::string method;
  std::string group;
  double ok_ratio = 0.0;                      ///< Scored truths whose fix is in state ok.
  double whole_trace_floor_hit_ratio = 0.0;   ///< Tracks whose every scored fix has the floor.
  double region_95_median_m2 = 0.0;           ///< Over fixes with a stated region.
  std::vector<ReliabilityPoint> reliability;  ///< Stated 10 ... 90, 95, 99 %.
  std::vector<TimeSpanError> by_time;         ///< 0, 10, 20, 40 s on.
  FloorChanges floor_changes;
};

/// A track begun at a wrong place that it was told with confidence.
struct WrongStartRow {
  std::string method;
  std::string group;
  std::uint64_t n = 0;          ///< Tracks with a truth at the time of judgement.
  std::uint64_t recovered = 0;  ///< Near the truth again, or as near as when left alone.
  bool takes_start = false;     ///< False when no fix of any track changed by the start given.
};

struct WrongStartRule {
  double offset_m = 0.0;
  double sigma_m = 2.0;
  double judged_at_s = 15.0;
  double near_m = 8.0;       ///< Below this the track has recovered ...
  double allowance_m = 3.0;  ///< ... or when it is at most this much worse than left alone.
};

/// Everything beside the table; what is empty was not asked for and is not shown.
struct Findings {
  std::vector<MeanInterval> intervals;
  std::vector<MethodFindings> methods;
  std::vector<ScanPeriodRows> scan_periods;
  WrongStartRule wrong_start_rule;
  std::vector<WrongStartRow> wrong_starts;
};

/// Rows for every method, "all", then "covered" when `with_covered`.
std::vector<MethodFindings> find_details(std::span<const EvaluatedTrack> tracks, bool with_covered);

/// `perturbed` and `alone` are parallel: the same methods on the same recordings, with paths.
/// Judged at the first whole second from `judged_at_s` on, the truth there on the straight line
/// between its marks; tracks that end before, or change floor between those marks, are left out.
std::vector<WrongStartRow> judge_wrong_starts(std::span<const EvaluatedTrack> perturbed,
                                              std::span<const EvaluatedTrack> alone,
                                              bool with_covered, const WrongStartRule& rule);

/// Aligned text for a terminal, to follow to_text(); empty without findings.
std::string findings_text(const Findings& findings);

}  // namespace waylode::eval
