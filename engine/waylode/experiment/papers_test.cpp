// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/papers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace waylode::experiment {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> presets_of(const Paper& paper) {
  std::vector<std::string> names = {""};
  for (const char letter : paper.presets) {
    if (letter == ',') {
      names.emplace_back();
    } else if (letter != ' ') {
      names.back() += letter;
    }
  }
  return names;
}

TEST(Papers, AreTheFourOfTheSpecification) {
  std::vector<std::string_view> names;
  for (const Paper& paper : papers()) names.push_back(paper.name);
  EXPECT_THAT(names, ElementsAre("wu2019", "zhou2016", "zhao2019", "zhong2017"));
}

TEST(RunSimulated, RefusesAPaperItDoesNotKnow) {
  for (const char* name : {"", "wu", "wu2018", "all"}) {
    const auto refused = run_simulated(name, {}, {});
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidArgument);
    EXPECT_EQ(refused.error().place, name);
    for (const Paper& paper : papers()) {
      EXPECT_THAT(refused.error().message, HasSubstr(std::string(paper.name)));
    }
  }
}

TEST(RunSimulated, RefusesAPresetThePaperDoesNotHave) {
  for (const Paper& paper : papers()) {
    for (const char* preset : {"", "Z", "A, H", "kernel,", ", "}) {
      SimulationRequest request;
      request.preset = preset;
      const auto refused = run_simulated(paper.name, request, {});
      ASSERT_FALSE(refused) << paper.name << " " << preset;
      EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidArgument);
      EXPECT_EQ(refused.error().place, std::string("--preset ") + preset);
      EXPECT_THAT(refused.error().message, HasSubstr(paper.presets));
    }
  }
}

TEST(RunSimulated, KnowsEveryPresetItLists) {
  for (const Paper& paper : papers()) {
    for (const std::string& preset : presets_of(paper)) {
      SimulationRequest request;
      request.preset = preset;
      request.seeds = 0;  // Refused for this alone, so that nothing runs.
      const auto refused = run_simulated(paper.name, request, {});
      ASSERT_FALSE(refused) << paper.name << " " << preset;
      EXPECT_EQ(refused.error().place, "--seeds") << paper.name << " " << preset;
    }
  }
}

TEST(RunSimulated, GivesTheSameFiguresEveryTime) {
  SimulationRequest request;
  request.preset = "kernel";
  request.seeds = 2;
  const auto first = run_simulated("zhao2019", request, {});
  const auto again = run_simulated("zhao2019", request, {});
  request.first_seed = 50;
  const auto others = run_simulated("zhao2019", request, {});
  ASSERT_TRUE(first && again && others);
  ASSERT_EQ(first->size(), 1U);
  ASSERT_FALSE(first->front().figures.empty());
  bool differs = false;
  for (std::size_t i = 0; i < first->front().figures.size(); ++i) {
    EXPECT_EQ(first->front().figures[i].ours, again->front().figures[i].ours);
    differs |= first->front().figures[i].ours != others->front().figures[i].ours;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace waylode::experiment
