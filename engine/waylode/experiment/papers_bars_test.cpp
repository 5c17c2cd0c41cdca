// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <set>

#include "waylode/experiment/papers.hpp"

/// The bars that the papers' figures set, in the rooms that are judged.
namespace waylode::experiment {
namespace {

std::string name_of(const Outcome& outcome, const Figure& figure) {
  return outcome.title + ": " + figure.id + " " + figure.what;
}

/// Runs the presets; every judged figure must be a number within its interval. Bars are checked but
/// for figures whose id and name begin like one of `open`, which only have to be there.
void expect_bars(const char* paper, std::initializer_list<const char*> presets,
                 std::set<std::string> judged_ids, const std::vector<std::string>& open = {}) {
  std::set<std::string> seen_open;
  for (const char* preset : presets) {
    SimulationRequest request;
    request.preset = preset;
    const auto outcomes = run_simulated(paper, request, {});
    ASSERT_TRUE(outcomes) << outcomes.error().message;
    ASSERT_EQ(outcomes->size(), 1U) << preset;
    const Outcome& outcome = outcomes->front();
    EXPECT_EQ(outcome.paper, paper);
    EXPECT_GT(tally(*outcomes).judged, 0U) << outcome.title;
    for (const Figure& figure : outcome.figures) {
      const std::string name = name_of(outcome, figure);
      EXPECT_TRUE(std::isfinite(figure.ours.value)) << name;
      EXPECT_LE(figure.ours.low, figure.ours.value) << name;
      EXPECT_GE(figure.ours.high, figure.ours.value) << name;
      EXPECT_GT(figure.ours.n, 1U) << name;
      if (!figure.bar) continue;
      judged_ids.erase(figure.id);
      const std::string label = figure.id + " " + figure.what;
      bool is_open = false;
      for (const std::string& start : open) {
        if (!label.starts_with(start)) continue;
        is_open = true;
        seen_open.insert(start);
      }
      if (is_open) continue;
      EXPECT_TRUE(*figure.reached())
          << name << " is " << figure.ours.value << " [" << figure.ours.low << ", "
          << figure.ours.high << "], the bar " << figure.bar->limit;
    }
  }
  EXPECT_TRUE(judged_ids.empty()) << *judged_ids.begin() << " is not judged";
  EXPECT_EQ(seen_open.size(), open.size());
}

TEST(RunSimulated, ReachesWusBars) { expect_bars("wu2019", {"I", "A"}, {"W-X1", "W-X2", "W-X3"}); }

TEST(RunSimulated, ReachesWusBarInTheCorridor) { expect_bars("wu2019", {"corridor"}, {"W-X4"}); }

TEST(RunSimulated, ReachesZhousBars) {
  // What fusion reaches at realistic errors is told in docs/methods, not judged here.
  expect_bars("zhou2016", {"A"}, {"Z-X1", "Z-X2", "Z-X4"}, {"Z-X4"});
}

TEST(RunSimulated, ReachesZhaosBars) {
  expect_bars("zhao2019", {"kernel", "corridor", "harsh"}, {"R-X4", "R-X6"});
}

TEST(RunSimulated, ReachesZhongsBars) {
  expect_bars("zhong2017", {"crowd", "turns", "photo", "many"}, {"D-X1", "D-X2", "D-X3"},
              {"D-X3 length error"});
}

}  // namespace
}  // namespace waylode::experiment
