// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/outcome_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace waylode::experiment {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<Outcome> some_outcomes() {
  Outcome outcome;
  outcome.paper = "wu2019";
  outcome.title = "Room <1>";
  outcome.data = "simulation, 12 walks";
  outcome.figures.push_back({"W-X1",
                             "mean error, fused",
                             "m",
                             "0.8",
                             {0.75, 0.7, 0.81, 12},
                             Bar{Bar::Sense::kAtMost, 0.8},
                             ""});
  outcome.figures.push_back({"W-X2",
                             "less than fingerprints",
                             "%",
                             "42",
                             {40.5, 37.0, 44.0, 12},
                             Bar{Bar::Sense::kAtLeast, 42.0},
                             "close & honest"});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  outcome.figures.push_back({"W-X4", "corridor", "m", "", {nan, nan, nan, 0}, {}, ""});
  eval::LineChart chart;
  chart.title = "Errors";
  chart.x = eval::axis_over(0.0, 3.0, 5, "error (m)", "m");
  chart.y = eval::axis_over(0.0, 100.0, 5, "walks (%)", "%");
  chart.series.push_back({0, "fused", {{0.0, 0.0}, {1.0, 80.0}}, false});
  outcome.charts.push_back(chart);
  return {outcome};
}

TEST(OutcomeText, ShowsPaperOursBarAndVerdictOnOneLine) {
  const std::string text = to_text(some_outcomes());
  EXPECT_THAT(text, ::testing::ContainsRegex(
                        "W-X1 .*0\\.8 .*0\\.75 \\[0\\.70, 0\\.81\\] m .*<= 0\\.8 .*reached"));
  EXPECT_THAT(text, ::testing::ContainsRegex("W-X2 .*>= 42 .*missed"));
}

TEST(OutcomeText, ShowsADashForWhatCouldNotBeMeasured) {
  EXPECT_THAT(to_text(some_outcomes()), ::testing::ContainsRegex("W-X4 .*- \\[-, -\\] m"));
}

TEST(OutcomeJson, CarriesEveryFigureAndTheTally) {
  const auto json = nlohmann::json::parse(to_json(some_outcomes(), "waylode reproduce wu2019"));
  EXPECT_EQ(json["bars"]["reached"], 1);
  EXPECT_EQ(json["bars"]["judged"], 2);
  const auto& figures = json["outcomes"][0]["figures"];
  EXPECT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[1]["reached"], false);
  EXPECT_TRUE(figures[2]["value"].is_null());
  EXPECT_FALSE(figures[2].contains("bar"));
}

TEST(OutcomeHtml, EscapesTextAndDrawsTheCharts) {
  const std::string html = to_html(some_outcomes(), "waylode reproduce 'a & b'");
  EXPECT_THAT(html, HasSubstr("Room &lt;1&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("Room <1>")));
  EXPECT_THAT(html, HasSubstr("close &amp; honest"));
  EXPECT_THAT(html, HasSubstr("<svg class=\"chart\""));
  EXPECT_THAT(html, HasSubstr("1 of 2 bars reached"));
}

}  // namespace
}  // namespace waylode::experiment
