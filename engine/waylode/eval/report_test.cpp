// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "waylode/core/file.hpp"
#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string html_of(const ReportOptions& options, const std::vector<EvaluatedTrack>& tracks) {
  return to_html(options, tracks, summarise(tracks, true));
}

ResultRow row_of_nothing() { return {"wknn", "all", compute_metrics({})}; }

/// The first tag that is not closed or closes nothing; empty when all match. Contents of <style>
/// and <script> are skipped, as a browser does.
std::string first_unmatched_tag(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return html.substr(at, 40);
    const std::string tag = html.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag.empty() || tag.front() == '!' || tag.back() == '/') continue;
    const bool closes = tag.front() == '/';
    const std::string name = tag.substr(closes ? 1 : 0, tag.find(' ') - (closes ? 1 : 0));
    if (closes) {
      if (open.empty() || open.back() != name) return tag;
      open.pop_back();
      continue;
    }
    open.push_back(name);
    if (name == "style" || name == "script") at = html.find("</" + name, at);
  }
  return open.empty() ? "" : open.back();
}

TEST(Json, HasExactlyTheKeysOfTheContract) {
  const ReportOptions options{"title", "ilc", "waylode evaluate", 1};
  const std::vector<ResultRow> rows = summarise(testing::demo_tracks(6), false);
  const auto report = nlohmann::ordered_json::parse(to_json(options, rows));
  EXPECT_EQ(report.size(), 3U);
  EXPECT_EQ(report["dataset"], "ilc");
  EXPECT_EQ(report["command"], "waylode evaluate");
  ASSERT_EQ(report["results"].size(), rows.size());
  std::vector<std::string> keys;
  for (const auto& [key, value] : report["results"][0].items()) keys.push_back(key);
  EXPECT_THAT(keys, ::testing::ElementsAre(
                        "method", "group", "n", "mean_m", "p50_m", "p75_m", "p90_m", "p95_m",
                        "ipin_p75_m", "floor_hit_ratio", "inside_68_ratio", "inside_95_ratio",
                        "unknown_ratio", "n_before_scan", "n_ok", "ok_mean_m", "after10s_mean_m",
                        "trace_floor_hit_ratio", "within_1_m", "within_1p5_m", "within_2_m",
                        "within_3_m", "region_95_median_m2", "walked_s", "cpu_s"));
}

TEST(Json, CarriesEachMetricUnderItsOwnKey) {
  Metrics metrics;
  double* const reals[] = {&metrics.mean_m,
                           &metrics.p50_m,
                           &metrics.p75_m,
                           &metrics.p90_m,
                           &metrics.p95_m,
                           &metrics.ipin_p75_m,
                           &metrics.floor_hit_ratio,
                           &metrics.inside_68_ratio,
                           &metrics.inside_95_ratio,
                           &metrics.unknown_ratio,
                           &metrics.ok_mean_m,
                           &metrics.after10s_mean_m,
                           &metrics.trace_floor_hit_ratio,
                           &metrics.within_1_m,
                           &metrics.within_1p5_m,
                           &metrics.within_2_m,
                           &metrics.within_3_m,
                           &metrics.region_95_median_m2,
                           &metrics.walked_s,
                           &metrics.cpu_s};
  for (std::size_t i = 0; i < std::size(reals); ++i) *reals[i] = 0.5 + static_cast<double>(i);
  metrics.n = 100;
  metrics.n_before_scan = 101;
  metrics.n_ok = 102;
  const std::vector<ResultRow> rows = {{"m", "g", metrics}};
  const auto row = nlohmann::json::parse(to_json({}, rows))["results"][0];
  const char* const keys[] = {"mean_m",
                              "p50_m",
                              "p75_m",
                              "p90_m",
                              "p95_m",
                              "ipin_p75_m",
                              "floor_hit_ratio",
                              "inside_68_ratio",
                              "inside_95_ratio",
                              "unknown_ratio",
                              "ok_mean_m",
                              "after10s_mean_m",
                              "trace_floor_hit_ratio",
                              "within_1_m",
                              "within_1p5_m",
                              "within_2_m",
                              "within_3_m",
                              "region_95_median_m2",
                              "walked_s",
                              "cpu_s"};
  for (std::size_t i = 0; i < std::size(keys); ++i) {
    EXPECT_EQ(row[keys[i]].get<double>(), 0.5 + static_cast<double>(i)) << keys[i];
  }
  EXPECT_EQ(row["n"], 100);
  EXPECT_EQ(row["n_before_scan"], 101);
  EXPECT_EQ(row["n_ok"], 102);
}

TEST(Json, SaysNullWhereThereIsNoNumber) {
  const std::vector<ResultRow> rows = {row_of_nothing()};
  const auto row = nlohmann::json::parse(to_json({}, rows))["results"][0];
  EXPECT_TRUE(row["mean_m"].is_null());
  EXPECT_TRUE(row["region_95_median_m2"].is_null());
  EXPECT_EQ(row["n"], 0);
}

TEST(Json, TakesNamesOfAnyBytes) {
  ResultRow row = row_of_nothing();
  row.group = "caf\xE9/F1 \"\n";
  const std::vector<ResultRow> rows = {row};
  const auto parsed = nlohmann::json::parse(to_json({}, rows));
  EXPECT_EQ(parsed["results"][0]["group"], "caf\xEF\xBF\xBD/F1 \"\n");
}

TEST(Text, AlignsColumnsWhateverTheNames) {
  ResultRow accented = row_of_nothing();
  accented.group = "caf\xC3\xA9/F1";  // Nine characters in ten bytes.
  ResultRow plain = row_of_nothing();
  plain.group = "cafe/F1";
  const std::vector<ResultRow> rows = {accented, plain};
  const std::string text = to_text(rows);
  EXPECT_THAT(text, StartsWith("method  group    n  mean m"));
  EXPECT_THAT(text, HasSubstr("\nwknn    caf\xC3\xA9/F1  0       -"));
  EXPECT_THAT(text, HasSubstr("\nwknn    cafe/F1  0       -"));
}

TEST(Html, ClosesEveryTag) {
  EXPECT_EQ(first_unmatched_tag(html_of({"t", "d", "c", 24}, testing::demo_tracks(40))), "");
  EXPECT_EQ(first_unmatched_tag(html_of({}, {})), "");
}

TEST(Html, NeedsNothingFromElsewhere) {
  const std::string html = html_of({"t", "d", "c", 24}, testing::demo_tracks(40));
  for (const char* reference : {"http", "src=", "url(", "@import", "<link", "//cdn"}) {
    EXPECT_THAT(html, Not(HasSubstr(reference)));
  }
}

TEST(Html, EscapesAllText) {
  std::vector<EvaluatedTrack> tracks = testing::demo_tracks(3);
  const std::string evil = "<b>\"x\" & 'y'</b>";
  for (EvaluatedTrack& track : tracks) {
    track.name += evil;
    track.group += evil;
    track.method += evil;
  }
  const std::string html = html_of({evil, evil, evil, 24}, tracks);
  EXPECT_THAT(html, Not(HasSubstr("<b>\"x")));
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;&quot;x&quot; &amp; &#39;y&#39;&lt;/b&gt;"));
  EXPECT_EQ(first_unmatched_tag(html), "");
}

TEST(Html, ShowsNoNumberThatIsNone) {
  std::vector<EvaluatedTrack> tracks = testing::demo_tracks(2);
  for (EvaluatedTrack& track : tracks) {
    for (TruthPoint& truth : track.truths) truth.scored = false;
  }
  const std::string html = html_of({"t", "d", "c", 24}, tracks);
  EXPECT_THAT(html, HasSubstr("No truth could be scored."));
  EXPECT_THAT(html, Not(HasSubstr(">nan")));
  EXPECT_EQ(first_unmatched_tag(html), "");
}

TEST(Html, DrawsNoMoreRecordingsThanAsked) {
  const auto figures = [](std::size_t most) {
    const std::string html = html_of({"t", "d", "c", most}, testing::demo_tracks(12));
    std::size_t count = 0;
    for (std::size_t at = html.find("<figure"); at != std::string::npos;
         at = html.find("<figure", at + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(figures(0), 0U);
  EXPECT_EQ(figures(5), 5U);
  EXPECT_EQ(figures(100), 12U);
}

TEST(Html, StaysSmallForManyRecordings) {
  const std::string html = html_of({"t", "d", "c", 250}, testing::demo_tracks(250));
  EXPECT_LT(html.size(), 2'000'000U);
}

/// Set WAYLODE_REPORT to a file name to look at the page.
TEST(Html, IsWrittenForTheEyeOnRequest) {
  const char* path = std::getenv("WAYLODE_REPORT");
  if (path == nullptr) GTEST_SKIP() << "set WAYLODE_REPORT to a file name to look at the page";
  const std::string html =
      html_of({"Indoor positioning of a simulated building", "made by hand, 60 recordings",
               "waylode evaluate mcap house.wlsite walks/*.mcap --methods wknn,fused,smoothed", 12},
              testing::demo_tracks(60));
  EXPECT_TRUE(core::write_file_atomically(path, html).has_value());
}

}  // namespace
}  // namespace waylode::eval
