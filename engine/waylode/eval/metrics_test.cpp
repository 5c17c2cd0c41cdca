// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval {
namespace {

using core::FixState;
using core::FloorId;
using core::Vector2;
using testing::fix_at;
using testing::three_floor_site;
using testing::truth_at;

/// A track on floor 0 whose truths stand at the origin, one a second, and whose fixes are off by
/// `errors_m` along x.
EvaluatedTrack track_with_errors(const std::vector<double>& errors_m) {
  EvaluatedTrack track;
  track.name = "walk";
  track.group = "house/F1";
  track.method = "wknn";
  track.site = three_floor_site();
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    track.truths.push_back(truth_at(static_cast<double>(i), FloorId{0}, {0.0, 0.0}));
    track.fixes.push_back(fix_at(static_cast<double>(i), FloorId{0}, {errors_m[i], 0.0}));
  }
  return track;
}

Metrics metrics_of(const EvaluatedTrack& track) {
  const std::vector<const EvaluatedTrack*> tracks = {&track};
  return compute_metrics(tracks);
}

PointError error_of(const TruthPoint& truth, const core::Fix& fix) {
  return point_error(*three_floor_site(), truth, fix, core::DeviceTime{});
}

TEST(PointError, IsTheDistanceOnTheSameFloor) {
  const PointError error =
      error_of(truth_at(2.5, FloorId{0}, {1.0, 2.0}), fix_at(2.5, FloorId{0}, {4.0, 6.0}));
  EXPECT_DOUBLE_EQ(error.horizontal_m, 5.0);
  EXPECT_EQ(error.floors_wrong, 0);
  EXPECT_TRUE(error.has_belief);
  EXPECT_DOUBLE_EQ(error.since_start_s, 2.5);
}

TEST(PointError, GoesThroughTheCommonFrameOnAWrongFloor) {
  // Floor 1 is turned by +90 degrees and moved by (10, 0): its (3, 1) is at (9, 3) on the site.
  const PointError error =
      error_of(truth_at(0.0, FloorId{0}, {5.0, 0.0}), fix_at(0.0, FloorId{1}, {3.0, 1.0}));
  EXPECT_NEAR(error.horizontal_m, 5.0, 1e-12);
  EXPECT_EQ(error.floors_wrong, 1);
  EXPECT_FALSE(error.inside_68);
  EXPECT_FALSE(error.inside_95);
  EXPECT_TRUE(std::isinf(error.squared_mahalanobis));
}

TEST(PointError, CountsFloorsByTheirLevels) {
  // Floor 2 is the basement, level -1; floor 1 is level 1.
  const PointError error =
      error_of(truth_at(0.0, FloorId{1}, {0.0, 0.0}), fix_at(0.0, FloorId{2}, {0.0, 0.0}));
  EXPECT_EQ(error.floors_wrong, 2);
}

TEST(PointError, ChargesHalfTheDiagonalWithoutABelief) {
  // Floor 0 measures 30 m x 40 m.
  const PointError error = error_of(truth_at(0.0, FloorId{0}, {3.0, 4.0}), core::Fix{});
  EXPECT_DOUBLE_EQ(error.horizontal_m, 25.0);
  EXPECT_EQ(error.floors_wrong, 1);
  EXPECT_FALSE(error.has_belief);
  EXPECT_FALSE(error.inside_95);
  EXPECT_TRUE(std::isnan(error.region_95_m2));
}

TEST(PointError, TreatsAMeanThatIsNotFiniteAsNoBelief) {
  const core::Fix fix = fix_at(0.0, FloorId{0}, {std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_DOUBLE_EQ(error_of(truth_at(0.0, FloorId{0}, {0.0, 0.0}), fix).horizontal_m, 25.0);
}

TEST(PointError, ReadsTheBeliefWhateverTheState) {
  core::Fix fix = fix_at(0.0, FloorId{0}, {0.0, 2.0});
  fix.state = FixState::kUnknown;
  const PointError error = error_of(truth_at(0.0, FloorId{0}, {0.0, 0.0}), fix);
  EXPECT_DOUBLE_EQ(error.horizontal_m, 2.0);
  EXPECT_EQ(error.state, FixState::kUnknown);
}

TEST(PointError, ComparesWithTheStatedRegion) {
  // Chi-square with two degrees of freedom: 2.2789 at 68 %, 5.9915 at 95 % (tables).
  core::Fix fix = fix_at(0.0, FloorId{0}, {0.0, 0.0});
  fix.belief->covariance_m2 << 4.0, 0.0, 0.0, 9.0;
  const auto inside = [&](Vector2 truth_m) {
    const PointError error = error_of(truth_at(0.0, FloorId{0}, truth_m), fix);
    return std::pair(error.inside_68, error.inside_95);
  };
  EXPECT_EQ(inside({2.0 * std::sqrt(2.278), 0.0}), std::pair(true, true));
  EXPECT_EQ(inside({2.0 * std::sqrt(2.280), 0.0}), std::pair(false, true));
  EXPECT_EQ(inside({0.0, 3.0 * std::sqrt(5.990)}), std::pair(false, true));
  EXPECT_EQ(inside({0.0, 3.0 * std::sqrt(5.993)}), std::pair(false, false));
  const PointError error = error_of(truth_at(0.0, FloorId{0}, {1.0, 3.0}), fix);
  EXPECT_NEAR(error.squared_mahalanobis, 1.25, 1e-12);
  EXPECT_NEAR(error.region_95_m2, 3.14159265 * 5.99146455 * 6.0, 1e-6);
}

TEST(PointError, ACovarianceThatIsNoneHoldsNothing) {
  core::Fix fix = fix_at(0.0, FloorId{0}, {0.0, 0.0});
  fix.belief->covariance_m2.setZero();
  const PointError error = error_of(truth_at(0.0, FloorId{0}, {0.0, 0.0}), fix);
  EXPECT_DOUBLE_EQ(error.horizontal_m, 0.0);
  EXPECT_FALSE(error.inside_95);
  EXPECT_TRUE(std::isnan(error.region_95_m2));
}

TEST(Metrics, SummariseAHandMadeTrack) {
  EvaluatedTrack track = track_with_errors({4.0, 1.0, 2.0, 3.0, 10.0});
  track.walked_s = 4.0;
  track.cpu_s = 0.25;
  const Metrics metrics = metrics_of(track);
  EXPECT_EQ(metrics.n, 5U);
  EXPECT_DOUBLE_EQ(metrics.mean_m, 4.0);
  EXPECT_DOUBLE_EQ(metrics.p50_m, 3.0);
  EXPECT_DOUBLE_EQ(metrics.p75_m, 4.0);
  EXPECT_DOUBLE_EQ(metrics.p90_m, 7.6);
  EXPECT_DOUBLE_EQ(metrics.p95_m, 8.8);
  EXPECT_DOUBLE_EQ(metrics.ipin_p75_m, 4.0);
  EXPECT_DOUBLE_EQ(metrics.floor_hit_ratio, 1.0);
  // Unit covariance: radius 1.51 m at 68 %, 2.45 m at 95 %.
  EXPECT_DOUBLE_EQ(metrics.inside_68_ratio, 0.2);
  EXPECT_DOUBLE_EQ(metrics.inside_95_ratio, 0.4);
  EXPECT_DOUBLE_EQ(metrics.within_1_m, 0.2);
  EXPECT_DOUBLE_EQ(metrics.within_1p5_m, 0.2);
  EXPECT_DOUBLE_EQ(metrics.within_2_m, 0.4);
  EXPECT_DOUBLE_EQ(metrics.within_3_m, 0.6);
  EXPECT_NEAR(metrics.region_95_median_m2, 18.8227, 1e-4);
  EXPECT_DOUBLE_EQ(metrics.walked_s, 4.0);
  EXPECT_DOUBLE_EQ(metrics.cpu_s, 0.25);
  EXPECT_DOUBLE_EQ(metrics.trace_floor_hit_ratio, 1.0);
}

TEST(Metrics, ScoreWhatIsFlaggedAndCountTheRest) {
  EvaluatedTrack track = track_with_errors({100.0, 100.0, 2.0, 4.0});
  track.truths[0].scored = false;
  track.truths[1].scored = false;
  const Metrics metrics = metrics_of(track);
  EXPECT_EQ(metrics.n, 2U);
  EXPECT_EQ(metrics.n_before_scan, 2U);
  EXPECT_DOUBLE_EQ(metrics.mean_m, 3.0);
}

TEST(Metrics, AreNotANumberWithoutScoredTruths) {
  EvaluatedTrack track = track_with_errors({1.0});
  track.truths[0].scored = false;
  const Metrics metrics = metrics_of(track);
  EXPECT_EQ(metrics.n, 0U);
  EXPECT_EQ(metrics.n_before_scan, 1U);
  for (const double value :
       {metrics.mean_m, metrics.p50_m, metrics.ipin_p75_m, metrics.floor_hit_ratio,
        metrics.inside_68_ratio, metrics.unknown_ratio, metrics.ok_mean_m, metrics.after10s_mean_m,
        metrics.trace_floor_hit_ratio, metrics.within_1_m, metrics.region_95_median_m2}) {
    EXPECT_TRUE(std::isnan(value));
  }
}

TEST(Metrics, AddFifteenMetresPerWrongFloor) {
  EvaluatedTrack track = track_with_errors({1.0, 2.0, 3.0, 4.0, 5.0});
  // The basement shares the ground floor's frame and is one level below it.
  track.fixes[2].belief->floor = FloorId{2};
  const Metrics metrics = metrics_of(track);
  // Penalised: 1, 2, 4, 5, 18; plain: 1 to 5.
  EXPECT_DOUBLE_EQ(metrics.ipin_p75_m, 5.0);
  EXPECT_DOUBLE_EQ(metrics.p75_m, 4.0);
  EXPECT_DOUBLE_EQ(metrics.mean_m, 3.0);
  EXPECT_DOUBLE_EQ(metrics.floor_hit_ratio, 0.8);
}

TEST(Metrics, SeparateTheStates) {
  EvaluatedTrack track = track_with_errors({1.0, 3.0, 20.0, 0.0});
  track.fixes[2].state = FixState::kUnknown;
  track.fixes[3].state = FixState::kLowConfidence;
  const Metrics metrics = metrics_of(track);
  EXPECT_EQ(metrics.n_ok, 2U);
  EXPECT_DOUBLE_EQ(metrics.ok_mean_m, 2.0);
  EXPECT_DOUBLE_EQ(metrics.unknown_ratio, 0.25);
  EXPECT_DOUBLE_EQ(metrics.mean_m, 6.0);
}

TEST(Metrics, LookAtFixesWithABeliefForTheRegion) {
  EvaluatedTrack track = track_with_errors({0.0, 0.0, 0.0});
  track.fixes[0].belief->covariance_m2 *= 4.0;
  track.fixes[1].belief->covariance_m2 *= 2.0;
  track.fixes[2].belief.reset();
  // The median of 4 and 2 times the unit region of 18.8227 m2.
  EXPECT_NEAR(metrics_of(track).region_95_median_m2, 3.0 * 18.8227, 1e-3);
}

TEST(Metrics, CountTenSecondsFromTheFirstTruthScoredOrNot) {
  EvaluatedTrack track = track_with_errors({9.0, 7.0, 1.0, 3.0});
  track.truths[0].scored = false;
  track.truths[0].time = core::device_time_from_seconds(100.0);
  track.truths[1].time = core::device_time_from_seconds(109.9);
  track.truths[2].time = core::device_time_from_seconds(110.0);
  track.truths[3].time = core::device_time_from_seconds(115.0);
  EXPECT_DOUBLE_EQ(metrics_of(track).after10s_mean_m, 2.0);
}

TEST(Metrics, JudgeATracksFloorByMajorityOfScoredFixes) {
  EvaluatedTrack good = track_with_errors({0.0, 0.0, 0.0});
  good.fixes[0].belief->floor = FloorId{2};
  EvaluatedTrack tied = track_with_errors({0.0, 0.0, 0.0});
  tied.fixes[1].belief->floor = FloorId{2};
  tied.truths[2].scored = false;
  EvaluatedTrack never_scored = track_with_errors({0.0});
  never_scored.truths[0].scored = false;
  const std::vector<const EvaluatedTrack*> tracks = {&good, &tied, &never_scored};
  EXPECT_DOUBLE_EQ(compute_metrics(tracks).trace_floor_hit_ratio, 0.5);
}

TEST(Summarise, OrdersMethodsByAppearanceAndGroupsByName) {
  std::vector<EvaluatedTrack> tracks;
  for (const auto& [method, group, error_m] :
       {std::tuple("fused", "b/F1", 1.0), std::tuple("wknn", "b/F1", 4.0),
        std::tuple("fused", "a/F2", 3.0), std::tuple("wknn", "a/F2", 8.0)}) {
    tracks.push_back(track_with_errors({error_m}));
    tracks.back().method = method;
    tracks.back().group = group;
    tracks.back().covered = error_m < 4.0;
  }
  std::vector<std::string> names;
  std::vector<double> means_m;
  for (const ResultRow& row : summarise(tracks, true)) {
    names.push_back(row.method + " " + row.group);
    means_m.push_back(row.metrics.n == 0 ? -1.0 : row.metrics.mean_m);
  }
  EXPECT_THAT(names,
              ::testing::ElementsAre("fused all", "fused covered", "fused a/F2", "fused b/F1",
                                     "wknn all", "wknn covered", "wknn a/F2", "wknn b/F1"));
  EXPECT_THAT(means_m, ::testing::ElementsAre(2.0, 2.0, 3.0, 1.0, 6.0, -1.0, 8.0, 4.0));
  EXPECT_EQ(summarise(tracks, false).size(), 6U);
}

}  // namespace
}  // namespace waylode::eval
