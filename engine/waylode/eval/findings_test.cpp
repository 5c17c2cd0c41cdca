// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/findings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval {
namespace {

using core::FloorId;
using core::Vector2;
using testing::fix_at;
using testing::three_floor_site;
using testing::truth_at;

EvaluatedTrack track_of(const char* method, std::vector<TruthPoint> truths,
                        std::vector<core::Fix> fixes, std::vector<core::Fix> path = {}) {
  EvaluatedTrack track;
  track.name = "walk";
  track.group = "house/F1";
  track.method = method;
  track.site = three_floor_site();
  track.truths = std::move(truths);
  track.fixes = std::move(fixes);
  track.path = std::move(path);
  return track;
}

/// Truths at the origin; the fixes lie `errors_m` east of it, one metre of sigma per axis.
EvaluatedTrack off_by(const std::vector<std::pair<double, double>>& times_and_errors) {
  std::vector<TruthPoint> truths;
  std::vector<core::Fix> fixes;
  for (const auto& [time_s, error_m] : times_and_errors) {
    truths.push_back(truth_at(time_s, FloorId{0}, Vector2(5.0, 5.0)));
    fixes.push_back(fix_at(time_s, FloorId{0}, Vector2(5.0 + error_m, 5.0)));
  }
  return track_of("a", std::move(truths), std::move(fixes));
}

TEST(FindDetails, SharesTruthsAmongRegionsByTheirChiSquare) {
  // Squared errors 0.16, 1, 4, 9 against -2 ln(1 - p): 0.2107 at 10 %, 1.386 at 50 %, 4.605 at
  // 90 %, 9.210 at 99 %.
  const auto rows =
      find_details(std::vector{off_by({{0.0, 0.4}, {1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}})}, false);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].group, "all");
  const auto inside = [&](double stated_ratio) {
    const auto found =
        std::ranges::find(rows[0].reliability, stated_ratio, &ReliabilityPoint::stated_ratio);
    return found == rows[0].reliability.end() ? -1.0 : found->inside_ratio;
  };
  EXPECT_EQ(inside(0.1), 0.25);
  EXPECT_EQ(inside(0.5), 0.5);
  EXPECT_EQ(inside(0.9), 0.75);
  EXPECT_EQ(inside(0.99), 1.0);
  EXPECT_EQ(rows[0].reliability.size(), 11U);
  // pi * -2 ln(0.05) of a unit covariance.
  EXPECT_NEAR(rows[0].region_95_median_m2, 18.82, 0.01);
}

TEST(FindDetails, SplitsErrorsByTheTimeSinceTheTracksOwnStart) {
  const auto rows = find_details(
      std::vector{off_by({{100.0, 1.0}, {109.9, 3.0}, {110.0, 5.0}, {139.0, 7.0}, {140.0, 9.0}})},
      false);
  const auto& spans = rows[0].by_time;
  ASSERT_EQ(spans.size(), 4U);
  EXPECT_NEAR(spans[0].mean_m, 2.0, 1e-9);
  EXPECT_NEAR(spans[1].mean_m, 5.0, 1e-9);
  EXPECT_NEAR(spans[2].mean_m, 7.0, 1e-9);
  EXPECT_NEAR(spans[3].mean_m, 9.0, 1e-9);
  const auto young = find_details(std::vector{off_by({{0.0, 1.0}})}, false);
  EXPECT_EQ(young[0].by_time[3].n, 0U);
  EXPECT_TRUE(std::isnan(young[0].by_time[3].mean_m));
}

TEST(FindDetails, CountsTracksThatAreNeverOnAWrongFloor) {
  EvaluatedTrack stray = off_by({{0.0, 1.0}, {1.0, 1.0}});
  stray.fixes[1].belief->floor = FloorId{1};
  stray.fixes[1].state = core::FixState::kLowConfidence;
  EvaluatedTrack covered = off_by({{0.0, 1.0}, {1.0, 1.0}});
  covered.covered = true;
  const auto rows = find_details(std::vector{stray, covered}, true);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].whole_trace_floor_hit_ratio, 0.5);
  EXPECT_EQ(rows[0].ok_ratio, 0.75);
  EXPECT_EQ(rows[1].group, "covered");
  EXPECT_EQ(rows[1].whole_trace_floor_hit_ratio, 1.0);
}

TEST(FindDetails, TimesFloorChangesFromTheFirstMarkOnTheNewFloor) {
  // F1 until 10 s, F2 marked at 20 s and 40 s, F1 again at 60 s: the first change is found by the
  // path at 24 s, the second never.
  const Vector2 place_m(5.0, 5.0);
  std::vector<TruthPoint> truths;
  std::vector<core::Fix> fixes;
  std::vector<core::Fix> path;
  for (const double time_s : {0.0, 10.0, 20.0, 40.0, 60.0}) {
    const bool upstairs = time_s == 20.0 || time_s == 40.0;
    truths.push_back(truth_at(time_s, FloorId{static_cast<std::uint16_t>(upstairs)}, place_m));
    fixes.push_back(fix_at(time_s, FloorId{static_cast<std::uint16_t>(time_s > 30.0)}, place_m));
  }
  for (int s = 0; s <= 60; ++s) {
    path.push_back(fix_at(s, FloorId{static_cast<std::uint16_t>(s >= 24)}, place_m));
  }
  const auto rows = find_details(std::vector{track_of("a", truths, fixes, path)}, false);
  const FloorChanges& changes = rows[0].floor_changes;
  EXPECT_EQ(changes.n, 2U);
  EXPECT_EQ(changes.found, 1U);
  EXPECT_NEAR(changes.worst_s, 4.0, 1e-9);
  EXPECT_EQ(changes.within_10s_ratio, 0.5);
}

/// One second apart, `error_m` east of the way from (0, 10) to (30, 10) at 1 m/s.
EvaluatedTrack walking(double error_m_at_15_s, double until_s = 30.0) {
  EvaluatedTrack track = track_of(
      "a", {truth_at(0.0, FloorId{0}, {0.0, 10.0}), truth_at(until_s, FloorId{0}, {until_s, 10.0})},
      {fix_at(0.0, FloorId{0}, {0.0, 10.0}), fix_at(until_s, FloorId{0}, {until_s, 10.0})});
  for (int s = 0; s <= static_cast<int>(until_s); ++s) {
    track.path.push_back(fix_at(s, FloorId{0}, {s + (s == 15 ? error_m_at_15_s : 20.0), 10.0}));
  }
  return track;
}

TEST(JudgeWrongStarts, JudgesAtItsTimeOnTheWayBetweenMarks) {
  const WrongStartRule rule{.offset_m = 50.0};
  // 7 m off is near; 12 m off is not, unless the track left alone is 9 m off or more.
  const std::vector<EvaluatedTrack> perturbed = {walking(7.0), walking(12.0), walking(12.0)};
  const std::vector<EvaluatedTrack> alone = {walking(1.0), walking(1.0), walking(9.5)};
  const auto rows = judge_wrong_starts(perturbed, alone, false, rule);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].n, 3U);
  EXPECT_EQ(rows[0].recovered, 2U);
  EXPECT_TRUE(rows[0].takes_start);
}

TEST(JudgeWrongStarts, LeavesOutTracksThatEndBeforeAndToldMethodsThatPassStartsOver) {
  const std::vector<EvaluatedTrack> same = {walking(7.0), walking(1.0, 14.0)};
  const auto rows = judge_wrong_starts(same, same, false, {.offset_m = 50.0});
  EXPECT_EQ(rows[0].n, 1U);
  EXPECT_FALSE(rows[0].takes_start);
}

TEST(FindingsText, ShowsWhatWasAskedForAlone) {
  EXPECT_EQ(findings_text({}), "");
  Findings findings;
  findings.wrong_start_rule.offset_m = 50.0;
  findings.wrong_starts = {{"fused", "all", 40, 38, true}, {"wknn", "all", 40, 40, false}};
  const std::string text = findings_text(findings);
  EXPECT_NE(text.find("95.0"), std::string::npos);
  EXPECT_EQ(text.find("100.0"), std::string::npos);  // No share for a method that takes no start.
}

TEST(ScanPeriodSvg, HasALinePerMethodOfTheGroup) {
  ResultRow row;
  row.method = "fused";
  row.group = "covered";
  row.metrics.mean_m = 4.5;
  const std::vector<ScanPeriodRows> periods = {{0.0, {row}}, {30.0, {row}}};
  const std::string svg = scan_period_svg_file(periods, "covered");
  EXPECT_NE(svg.find("fused"), std::string::npos);
  EXPECT_NE(svg.find("30 s"), std::string::npos);
  EXPECT_EQ(scan_period_svg(periods, "all"), "");
  EXPECT_EQ(scan_period_svg({}, "all"), "");
}

}  // namespace
}  // namespace waylode::eval
