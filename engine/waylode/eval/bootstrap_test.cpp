// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/bootstrap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval {
namespace {

/// A track whose fixes are off by the given distances; a negative one is a truth not scored.
EvaluatedTrack track_of(const std::string& name, const std::string& method,
                        const std::vector<double>& errors_m, bool covered = false) {
  static const auto site = testing::three_floor_site();
  EvaluatedTrack track;
  track.name = name;
  track.group = "house/F1";
  track.method = method;
  track.covered = covered;
  track.site = site;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    const double time_s = static_cast<double>(i);
    track.truths.push_back(testing::truth_at(time_s, core::FloorId{0}, {5.0, 7.0}));
    track.truths.back().scored = errors_m[i] >= 0.0;
    track.fixes.push_back(testing::fix_at(time_s, core::FloorId{0}, {5.0 + errors_m[i], 7.0}));
  }
  return track;
}

TEST(BootstrapMeans, TwoTracksOfOneTruthHaveTheExtremesAsBounds) {
  // Means of a resample: 1 and 4 each with probability 1/4, so beyond either 2.5 % quantile.
  const std::vector<EvaluatedTrack> tracks = {track_of("a", "wknn", {1.0}),
                                              track_of("b", "wknn", {4.0})};
  const auto intervals = bootstrap_means(tracks, false, {});
  ASSERT_EQ(intervals.size(), 1U);
  EXPECT_EQ(intervals[0].tracks, 2U);
  EXPECT_DOUBLE_EQ(intervals[0].mean_m, 2.5);
  EXPECT_DOUBLE_EQ(intervals[0].mean_95_m.low, 1.0);
  EXPECT_DOUBLE_EQ(intervals[0].mean_95_m.high, 4.0);
}

TEST(BootstrapMeans, WidthIsThatOfTheCentralLimit) {
  // 100 tracks of one truth, errors 0.1, 0.2 ... 10: standard deviation sqrt((100^2 - 1) / 12)
  // / 10.
  std::vector<EvaluatedTrack> tracks;
  for (int i = 1; i <= 100; ++i) {
    tracks.push_back(track_of(std::to_string(i), "wknn", {0.1 * i}));
  }
  const MeanInterval interval = bootstrap_means(tracks, false, {}).at(0);
  const double half_m = 1.96 * std::sqrt(9999.0 / 12.0) / 10.0 / 10.0;
  EXPECT_NEAR(interval.mean_95_m.low, 5.05 - half_m, 0.06);
  EXPECT_NEAR(interval.mean_95_m.high, 5.05 + half_m, 0.06);
}

TEST(BootstrapMeans, DifferenceIsPairedAndOfCommonTruths) {
  // Always 0.5 m better where both are scored: pairing leaves no doubt, whatever the tracks'
  // spread.
  std::vector<EvaluatedTrack> tracks;
  for (const double error_m : {1.0, 3.5, 9.0, 20.0}) {
    const std::string name = std::to_string(error_m);
    tracks.push_back(track_of(name, "wknn", {-1.0, error_m, error_m + 1.0}));
    tracks.push_back(track_of(name, "smoothed", {30.0, error_m - 0.5, error_m + 0.5}));
  }
  const auto intervals = bootstrap_means(tracks, false, {});
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_EQ(intervals[0].difference_m, 0.0);
  EXPECT_EQ(intervals[0].difference_95_m.high, 0.0);
  EXPECT_NEAR(intervals[1].difference_m, -0.5, 1e-12);
  EXPECT_NEAR(intervals[1].difference_95_m.low, -0.5, 1e-12);
  EXPECT_NEAR(intervals[1].difference_95_m.high, -0.5, 1e-12);
  // Mean over all three truths: (4 * 30 + 2 * 33.5) / 12.
  EXPECT_NEAR(intervals[1].mean_m, 187.0 / 12.0, 1e-12);
}

TEST(BootstrapMeans, SameForAnyOrderOfRecordingsAndOfTheSeedOnly) {
  std::vector<EvaluatedTrack> tracks = testing::demo_tracks(9);
  const auto forward = bootstrap_means(tracks, true, {.resamples = 50, .seed = 4});
  const auto other_seed = bootstrap_means(tracks, true, {.resamples = 50, .seed = 5});
  // Whole recordings are turned round, so that the methods keep their order.
  std::vector<EvaluatedTrack> turned;
  for (std::size_t i = tracks.size(); i >= 3; i -= 3) {
    for (std::size_t j = i - 3; j < i; ++j) turned.push_back(tracks[j]);
  }
  const auto backward = bootstrap_means(turned, true, {.resamples = 50, .seed = 4});
  ASSERT_EQ(forward.size(), 6U);
  for (std::size_t i = 0; i < forward.size(); ++i) {
    EXPECT_EQ(forward[i].method, backward[i].method);
    EXPECT_EQ(forward[i].group, i % 2 == 0 ? "all" : "covered");
    EXPECT_EQ(forward[i].mean_95_m.low, backward[i].mean_95_m.low);
    EXPECT_EQ(forward[i].difference_95_m.high, backward[i].difference_95_m.high);
  }
  EXPECT_NE(forward[0].mean_95_m.low, other_seed[0].mean_95_m.low);
}

TEST(BootstrapMeans, RecordingsOfOneNameStayApart) {
  const std::vector<EvaluatedTrack> tracks = {track_of("a", "wknn", {1.0}),
                                              track_of("a", "wknn", {4.0})};
  EXPECT_EQ(bootstrap_means(tracks, false, {}).at(0).tracks, 2U);
}

TEST(BootstrapMeans, NothingScoredIsNoNumber) {
  const std::vector<EvaluatedTrack> tracks = {track_of("a", "wknn", {-1.0}),
                                              track_of("b", "wknn", {})};
  const auto intervals = bootstrap_means(tracks, true, {});
  ASSERT_EQ(intervals.size(), 2U);
  for (const MeanInterval& interval : intervals) {
    EXPECT_EQ(interval.tracks, 0U);
    EXPECT_TRUE(std::isnan(interval.mean_m));
    EXPECT_TRUE(std::isnan(interval.mean_95_m.low));
    EXPECT_TRUE(std::isnan(interval.difference_95_m.high));
  }
  EXPECT_TRUE(bootstrap_means({}, true, {}).empty());
}

}  // namespace
}  // namespace waylode::eval
