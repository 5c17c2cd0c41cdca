// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/floor_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

namespace waylode::fusion {
namespace {

using observation::FloorHypothesis;
using observation::RadioObservation;

/// Hypotheses by falling likelihood, as the contract of RadioObservation has it.
RadioObservation votes(std::vector<std::pair<std::uint16_t, double>> log_likelihoods) {
  std::ranges::sort(log_likelihoods, std::greater{}, &std::pair<std::uint16_t, double>::second);
  RadioObservation observation;
  for (const auto& [floor, log_likelihood] : log_likelihoods) {
    FloorHypothesis hypothesis;
    hypothesis.floor.index = floor;
    hypothesis.log_likelihood = log_likelihood;
    observation.floors.push_back(hypothesis);
  }
  return observation;
}

FloorFilter::Options options_of(double change_probability, double vote_weight) {
  FloorFilter::Options options;
  options.change_probability = change_probability;
  options.vote_weight = vote_weight;
  return options;
}

TEST(AdvanceFloorChain, MatchesHandComputation) {
  // Predicted: 0.9 * (0.7, 0.2, 0.1) + 0.1 / 3; voted 1 : 2 : 4.
  const auto result =
      advance_floor_chain({0.7, 0.2, 0.1}, {0.0, std::log(2.0), std::log(4.0)}, 0.1);
  const double a = 0.63 + 0.1 / 3.0;
  const double b = 2.0 * (0.18 + 0.1 / 3.0);
  const double c = 4.0 * (0.09 + 0.1 / 3.0);
  ASSERT_EQ(result.size(), 3U);
  EXPECT_NEAR(result[0], a / (a + b + c), 1e-12);
  EXPECT_NEAR(result[1], b / (a + b + c), 1e-12);
  EXPECT_NEAR(result[2], c / (a + b + c), 1e-12);
}

TEST(AdvanceFloorChain, SurvivesVotesOfAnySize) {
  const auto result = advance_floor_chain({1.0, 0.0}, {-5000.0, -3000.0}, 1e-3);
  EXPECT_NEAR(result[1], 1.0, 1e-12);
  EXPECT_EQ(result[0] + result[1], 1.0);
}

RC_GTEST_PROP(AdvanceFloorChain, IsADistributionAndKnowsNoOffset, ()) {
  const auto raw = *rc::gen::container<std::vector<int>>(5, rc::gen::inRange(-300, 300));
  std::vector<double> votes_of_scan(raw.begin(), raw.end());
  std::vector<double> probabilities = {0.1, 0.2, 0.3, 0.15, 0.25};
  const auto result = advance_floor_chain(probabilities, votes_of_scan, 0.01);
  RC_ASSERT(std::abs(std::accumulate(result.begin(), result.end(), 0.0) - 1.0) < 1e-12);
  for (double& vote : votes_of_scan) vote += 77.0;
  const auto same = advance_floor_chain(probabilities, votes_of_scan, 0.01);
  for (std::size_t i = 0; i < 5; ++i) {
    RC_ASSERT(result[i] >= 0.0);
    RC_ASSERT(std::abs(result[i] - same[i]) < 1e-12);
  }
}

TEST(FloorFilter, KnowsNothingBeforeTheFirstScan) {
  const FloorFilter filter(options_of(0.01, 1.0), 4);
  EXPECT_EQ(filter.most_likely(), std::nullopt);
  EXPECT_EQ(filter.probabilities(), std::vector<double>(4, 0.25));
}

TEST(FloorFilter, TakesTheFirstScanByBayesRule) {
  FloorFilter filter(options_of(0.2, 0.5), 2);
  filter.add(votes({{1, std::log(9.0)}, {0, 0.0}}));
  // Half the vote: likelihood ratio 3.
  EXPECT_NEAR(filter.probabilities()[1], 0.75, 1e-12);
  EXPECT_EQ(filter.most_likely(), core::FloorId{1});
}

TEST(FloorFilter, TakesAFloorTheScanDoesNotNameForNoBetterThanTheWorstNamed) {
  EXPECT_EQ(FloorFilter::weighted_log_likelihoods(votes({{2, -1.0}, {0, -6.0}}), 4,
                                                  options_of(0.01, 0.5)),
            (std::vector<double>{-3.0, -3.0, -0.5, -3.0}));
}

TEST(FloorFilter, TakesAFloorTheScanDoesNotNameForATenthOfTheBestAtMost) {
  const double tenth = 0.5 * (-1.0 - std::log(10.0));
  EXPECT_EQ(FloorFilter::weighted_log_likelihoods(votes({{2, -1.0}, {0, -1.5}}), 4,
                                                  options_of(0.01, 0.5)),
            (std::vector<double>{-0.75, tenth, -0.5, tenth}));
}

TEST(FloorFilter, LearnsTheFloorFromScansThatKnowItAlone) {
  FloorFilter filter(options_of(0.01, 1.0), 3);
  filter.add(votes({{2, 0.0}}));
  EXPECT_EQ(filter.most_likely(), core::FloorId{2});
  EXPECT_NEAR(filter.probabilities()[2], 1.0 / 1.2, 1e-12);
}

TEST(FloorFilter, HoldsItsFloorAgainstOneContraryScanAndYieldsToMany) {
  FloorFilter filter(options_of(0.01, 1.0), 2);
  for (int i = 0; i < 10; ++i) filter.add(votes({{0, 0.0}, {1, -2.0}}));
  filter.add(votes({{1, 0.0}, {0, -2.0}}));
  EXPECT_EQ(filter.most_likely(), core::FloorId{0});
  for (int i = 0; i < 5; ++i) filter.add(votes({{1, 0.0}, {0, -2.0}}));
  EXPECT_EQ(filter.most_likely(), core::FloorId{1});
}

TEST(FloorFilter, StaysCertainOfTheOnlyFloor) {
  FloorFilter filter(options_of(0.01, 1.0), 1);
  filter.add(votes({{0, -40.0}}));
  EXPECT_EQ(filter.probabilities(), std::vector<double>{1.0});
}

TEST(FloorFilter, RejectsOptionsThatMakeNoSense) {
  EXPECT_TRUE(options_of(0.5, 1.0).validate());
  for (const auto& bad : {options_of(0.0, 1.0), options_of(1.0, 1.0), options_of(0.1, 0.0)}) {
    const auto valid = bad.validate();
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::fusion
