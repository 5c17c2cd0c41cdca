// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "waylode/eval/metrics.hpp"
#include "waylode/eval/report.hpp"
#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval {
namespace {

/// All figures to the last digit.
std::string figures_of(const std::vector<const EvaluatedTrack*>& tracks) {
  const std::vector<ResultRow> rows = {{"m", "all", compute_metrics(tracks)}};
  return to_json({}, rows);
}

std::vector<const EvaluatedTrack*> pointers_to(const std::vector<EvaluatedTrack>& tracks) {
  std::vector<const EvaluatedTrack*> pointers;
  for (const EvaluatedTrack& track : tracks) pointers.push_back(&track);
  return pointers;
}

RC_GTEST_PROP(Metrics, DoNotDependOnTheOrderOfTracks, ()) {
  const std::vector<EvaluatedTrack> tracks = testing::demo_tracks(8);
  std::vector<const EvaluatedTrack*> order = pointers_to(tracks);
  const std::string before = figures_of(order);
  for (std::size_t i = order.size() - 1; i > 0; --i) {
    std::swap(order[i], order[*rc::gen::inRange<std::size_t>(0, i + 1)]);
  }
  RC_ASSERT(figures_of(order) == before);
}

TEST(Metrics, ATrackWithoutTruthsChangesNothing) {
  const std::vector<EvaluatedTrack> tracks = testing::demo_tracks(3);
  std::vector<const EvaluatedTrack*> pointers = pointers_to(tracks);
  const std::string before = figures_of(pointers);
  EvaluatedTrack empty;
  empty.site = tracks[0].site;
  pointers.insert(pointers.begin() + 2, &empty);
  EXPECT_EQ(figures_of(pointers), before);
}

TEST(Metrics, RatiosAndPercentilesKeepTheirOrder) {
  const std::vector<EvaluatedTrack> tracks = testing::demo_tracks(20);
  for (const ResultRow& row : summarise(tracks, true)) {
    const Metrics& m = row.metrics;
    const double ascending_m[] = {0.0, m.p50_m, m.p75_m, m.p90_m, m.p95_m};
    EXPECT_TRUE(std::is_sorted(std::begin(ascending_m), std::end(ascending_m))) << row.group;
    const double shares[] = {0.0, m.within_1_m, m.within_1p5_m, m.within_2_m, m.within_3_m, 1.0};
    EXPECT_TRUE(std::is_sorted(std::begin(shares), std::end(shares))) << row.group;
    EXPECT_LE(m.inside_68_ratio, m.inside_95_ratio);
    EXPECT_LE(m.inside_95_ratio, m.floor_hit_ratio);
    EXPECT_GE(m.ipin_p75_m, m.p75_m);
    EXPECT_LE(m.n_ok, m.n);
  }
}

}  // namespace
}  // namespace waylode::eval
