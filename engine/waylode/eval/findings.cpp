// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "waylode/core/assert.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/eval/detail/methods.hpp"
#include "waylode/eval/detail/quantile.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval {
namespace {

constexpr std::array kStatedRatios = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99};
constexpr std::array kSpans_s = {0.0, 10.0, 20.0, 40.0};
constexpr double kSoon_s = 10.0;

using Members = std::vector<const EvaluatedTrack*>;

Members members_of(std::span<const EvaluatedTrack> tracks, const std::string& method,
                   bool covered_only) {
  Members members;
  for (const EvaluatedTrack& track : tracks) {
    if (track.method == method && (track.covered || !covered_only)) members.push_back(&track);
  }
  return members;
}

double ratio(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<ReliabilityPoint> reliability_of(const std::vector<PointError>& errors) {
  std::vector<ReliabilityPoint> points;
  for (const double stated : kStatedRatios) {
    const double limit = core::chi_square_2_quantile(stated);
    const auto inside = std::count_if(errors.begin(), errors.end(), [&](const PointError& error) {
      return error.squared_mahalanobis <= limit;
    });
    points.push_back({stated, ratio(static_cast<std::size_t>(inside), errors.size())});
  }
  return points;
}

std::vector<TimeSpanError> by_time_of(const std::vector<PointError>& errors) {
  std::vector<TimeSpanError> spans;
  for (std::size_t i = 0; i < kSpans_s.size(); ++i) {
    TimeSpanError span;
    span.from_s = kSpans_s[i];
    if (i + 1 < kSpans_s.size()) span.to_s = kSpans_s[i + 1];
    std::vector<double> errors_m;
    for (const PointError& error : errors) {
      if (error.since_start_s >= span.from_s && error.since_start_s < span.to_s) {
        errors_m.push_back(error.horizontal_m);
      }
    }
    std::sort(errors_m.begin(), errors_m.end());
    span.n = errors_m.size();
    span.mean_m = detail::mean(errors_m);
    spans.push_back(span);
  }
  return spans;
}

/// When the method first says `floor`, in [from, until).
std::optional<core::DeviceTime> first_on(const EvaluatedTrack& track, core::FloorId floor,
                                         core::DeviceTime from,
                                         std::optional<core::DeviceTime> until) {
  std::optional<core::DeviceTime> first;
  for (const auto* fixes : {&track.fixes, &track.path}) {
    for (const core::Fix& fix : *fixes) {
      if (fix.time < from || (until && fix.time >= *until)) continue;
      if (!fix.belief || fix.belief->floor != floor) continue;
      if (!first || fix.time < *first) first = fix.time;
    }
  }
  return first;
}

/// Indices of the first truths on a new floor.
std::vector<std::size_t> changes_of(const EvaluatedTrack& track) {
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < track.truths.size(); ++i) {
    if (track.truths[i].floor != track.truths[i - 1].floor) changes.push_back(i);
  }
  return changes;
}

FloorChanges floor_changes_of(const Members& members) {
  std::vector<double> delays_s;
  FloorChanges result;
  for (const EvaluatedTrack* track : members) {
    const std::vector<std::size_t> changes = changes_of(*track);
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const TruthPoint& truth = track->truths[changes[i]];
      std::optional<core::DeviceTime> until;
      if (i + 1 < changes.size()) until = track->truths[changes[i + 1]].time;
      ++result.n;
      if (const auto found = first_on(*track, truth.floor, truth.time, until)) {
        delays_s.push_back(core::to_seconds(*found - truth.time));
      }
    }
  }
  std::sort(delays_s.begin(), delays_s.end());
  result.found = delays_s.size();
  result.median_s = detail::quantile(delays_s, 0.5);
  result.worst_s = detail::quantile(delays_s, 1.0);
  const auto soon = std::upper_bound(delays_s.begin(), delays_s.end(), kSoon_s) - delays_s.begin();
  result.within_10s_ratio = ratio(static_cast<std::size_t>(soon), result.n);
  return result;
}

MethodFindings findings_of(const Members& members) {
  MethodFindings findings;
  std::vector<PointError> errors;
  std::size_t scored = 0;
  std::size_t right = 0;
  for (const EvaluatedTrack* track : members) {
    const std::vector<PointError> own = track_errors(*track);
    errors.insert(errors.end(), own.begin(), own.end());
    if (own.empty()) continue;
    ++scored;
    right += std::ranges::all_of(own, [](const auto& error) { return error.floors_wrong == 0; });
  }
  const auto ok = std::ranges::count(errors, core::FixState::kOk, &PointError::state);
  findings.ok_ratio = ratio(static_cast<std::size_t>(ok), errors.size());
  findings.whole_trace_floor_hit_ratio = ratio(right, scored);
  findings.region_95_median_m2 = compute_metrics(members).region_95_median_m2;
  findings.reliability = reliability_of(errors);
  findings.by_time = by_time_of(errors);
  findings.floor_changes = floor_changes_of(members);
  return findings;
}

}  // namespace

std::vector<MethodFindings> find_details(std::span<const EvaluatedTrack> tracks,
                                         bool with_covered) {
  std::vector<MethodFindings> rows;
  for (const std::string& method : detail::methods_in_order(tracks)) {
    for (const bool covered_only : {false, true}) {
      if (covered_only && !with_covered) continue;
      rows.push_back(findings_of(members_of(tracks, method, covered_only)));
      rows.back().method = method;
      rows.back().group = covered_only ? "covered" : "all";
    }
  }
  return rows;
}

}  // namespace waylode::eval
