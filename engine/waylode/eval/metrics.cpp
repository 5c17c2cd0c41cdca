// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "waylode/core/assert.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/eval/detail/quantile.hpp"

namespace waylode::eval {
namespace {

constexpr double kIpinFloorPenalty_m = 15.0;
constexpr double kSettled_s = 10.0;

/// A sample that is sorted before it is summarised, so that the order of tracks leaves no trace.
class Sample {
 public:
  void add(double value) { values_.push_back(value); }
  void freeze() { std::sort(values_.begin(), values_.end()); }
  std::size_t size() const { return values_.size(); }
  double mean() const { return detail::mean(values_); }
  double quantile(double probability) const { return detail::quantile(values_, probability); }
  double sum() const { return std::accumulate(values_.begin(), values_.end(), 0.0); }
  double share_at_most(double limit) const {
    const auto end = std::upper_bound(values_.begin(), values_.end(), limit);
    return static_cast<double>(end - values_.begin()) / static_cast<double>(size());
  }

 private:
  std::vector<double> values_;
};

struct Tally {
  Sample horizontal_m;
  Sample ipin_m;
  Sample ok_m;
  Sample after10s_m;
  Sample region_95_m2;
  Sample walked_s;
  Sample cpu_s;
  std::uint64_t floor_hits = 0;
  std::uint64_t inside_68 = 0;
  std::uint64_t inside_95 = 0;
  std::uint64_t unknown = 0;
  std::uint64_t before_scan = 0;
  std::uint64_t scored_tracks = 0;
  std::uint64_t floor_hit_tracks = 0;

  void freeze() {
    for (Sample* sample :
         {&horizontal_m, &ipin_m, &ok_m, &after10s_m, &region_95_m2, &walked_s, &cpu_s}) {
      sample->freeze();
    }
  }
};

void add_point(Tally& tally, const PointError& error) {
  tally.horizontal_m.add(error.horizontal_m);
  tally.ipin_m.add(error.horizontal_m + kIpinFloorPenalty_m * error.floors_wrong);
  if (error.state == core::FixState::kOk) tally.ok_m.add(error.horizontal_m);
  if (error.since_start_s >= kSettled_s) tally.after10s_m.add(error.horizontal_m);
  if (!std::isnan(error.region_95_m2)) tally.region_95_m2.add(error.region_95_m2);
  if (error.floors_wrong == 0) ++tally.floor_hits;
  if (error.inside_68) ++tally.inside_68;
  if (error.inside_95) ++tally.inside_95;
  if (error.state == core::FixState::kUnknown) ++tally.unknown;
}

void add_track(Tally& tally, const EvaluatedTrack& track) {
  tally.walked_s.add(track.walked_s);
  tally.cpu_s.add(track.cpu_s);
  std::size_t scored = 0;
  std::size_t hits = 0;
  for (const PointError& error : track_errors(track)) {
    add_point(tally, error);
    ++scored;
    if (error.floors_wrong == 0) ++hits;
  }
  tally.before_scan += track.truths.size() - scored;
  if (scored == 0) return;
  ++tally.scored_tracks;
  if (2 * hits > scored) ++tally.floor_hit_tracks;
}

/// NaN when there is nothing to count.
double ratio(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

PointError point_error(const site::Site& site, const TruthPoint& truth, const core::Fix& fix,
                       core::DeviceTime track_start) {
  WAYLODE_ASSERT(truth.floor.index < site.floors().size());
  PointError error;
  error.state = fix.state;
  error.since_start_s = core::to_seconds(truth.time - track_start);
  error.squared_mahalanobis = std::numeric_limits<double>::infinity();
  error.region_95_m2 = std::numeric_limits<double>::quiet_NaN();
  error.has_belief = fix.belief.has_value() && fix.belief->position_m.allFinite();
  if (!error.has_belief) {
    error.horizontal_m = 0.5 * site.floor(truth.floor).bounds.diagonal_m();
    error.floors_wrong = 1;
    return error;
  }
  const core::Belief& belief = *fix.belief;
  WAYLODE_ASSERT(belief.floor.index < site.floors().size());
  const bool has_region = core::is_valid_covariance(belief.covariance_m2);
  if (has_region) error.region_95_m2 = core::confidence_region_area_m2(belief.covariance_m2, 0.95);
  if (belief.floor != truth.floor) {
    error.horizontal_m =
        site.horizontal_distance_m(truth.floor, truth.position_m, belief.floor, belief.position_m);
    const int levels = site.floor(belief.floor).level - site.floor(truth.floor).level;
    error.floors_wrong = std::max(1, std::abs(levels));
    return error;
  }
  const core::Vector2 error_m = belief.position_m - truth.position_m;
  error.horizontal_m = error_m.norm();
  if (!has_region) return error;
  error.squared_mahalanobis = core::squared_mahalanobis(error_m, belief.covariance_m2);
  error.inside_68 = error.squared_mahalanobis <= core::chi_square_2_quantile(0.68);
  error.inside_95 = error.squared_mahalanobis <= core::chi_square_2_quantile(0.95);
  return error;
}

std::vector<PointError> track_errors(const EvaluatedTrack& track) {
  WAYLODE_ASSERT(track.truths.size() == track.fixes.size());
  std::vector<PointError> errors;
  for (std::size_t i = 0; i < track.truths.size(); ++i) {
    if (!track.truths[i].scored) continue;
    errors.push_back(
        point_error(*track.site, track.truths[i], track.fixes[i], track.truths.front().time));
  }
  return errors;
}

Metrics compute_metrics(std::span<const EvaluatedTrack* const> tracks) {
  Tally tally;
  for (const EvaluatedTrack* track : tracks) add_track(tally, *track);
  tally.freeze();
  Metrics metrics;
  metrics.n = tally.horizontal_m.size();
  metrics.mean_m = tally.horizontal_m.mean();
  metrics.p50_m = tally.horizontal_m.quantile(0.50);
  metrics.p75_m = tally.horizontal_m.quantile(0.75);
  metrics.p90_m = tally.horizontal_m.quantile(0.90);
  metrics.p95_m = tally.horizontal_m.quantile(0.95);
  metrics.ipin_p75_m = tally.ipin_m.quantile(0.75);
  metrics.floor_hit_ratio = ratio(tally.floor_hits, metrics.n);
  metrics.inside_68_ratio = ratio(tally.inside_68, metrics.n);
  metrics.inside_95_ratio = ratio(tally.inside_95, metrics.n);
  metrics.unknown_ratio = ratio(tally.unknown, metrics.n);
  metrics.n_before_scan = tally.before_scan;
  metrics.n_ok = tally.ok_m.size();
  metrics.ok_mean_m = tally.ok_m.mean();
  metrics.after10s_mean_m = tally.after10s_m.mean();
  metrics.trace_floor_hit_ratio = ratio(tally.floor_hit_tracks, tally.scored_tracks);
  metrics.within_1_m = tally.horizontal_m.share_at_most(1.0);
  metrics.within_1p5_m = tally.horizontal_m.share_at_most(1.5);
  metrics.within_2_m = tally.horizontal_m.share_at_most(2.0);
  metrics.within_3_m = tally.horizontal_m.share_at_most(3.0);
  metrics.region_95_median_m2 = tally.region_95_m2.quantile(0.5);
  metrics.walked_s = tally.walked_s.sum();
  metrics.cpu_s = tally.cpu_s.sum();
  return metrics;
}

}  // namespace waylode::eval
