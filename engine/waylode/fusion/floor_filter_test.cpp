// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/floor_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
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

observation::VerticalMotion climb_of(double climb_m, double sigma_m) {
  observation::VerticalMotion motion;
  motion.climb_m = climb_m;
  motion.sigma_m = sigma_m;
  return motion;
}

FloorFilter::Options storeys(double storey_m, double sigma_m, double false_climb_ratio) {
  FloorFilter::Options options;
  options.storey_m = storey_m;
  options.storey_sigma_m = sigma_m;
  options.false_climb_ratio = false_climb_ratio;
  return options;
}

std::vector<double> after_climb(const std::vector<double>& probabilities,
                                const observation::VerticalMotion& motion,
                                const FloorFilter::Options& options) {
  std::vector<int> levels(probabilities.size());
  std::iota(levels.begin(), levels.end(), -1);
  return climb_floor_chain(probabilities, climb_fits(levels, motion, options));
}

TEST(ClimbFloorChain, MatchesHandComputation) {
  // Variance 0.09 standing, 0.25 per storey more: 0.34 one storey off. Climb 3.6 of storeys of 4.
  const auto result = after_climb({0.7, 0.3}, climb_of(3.6, 0.3), storeys(4.0, 0.5, 0.1));
  const double up = std::exp(-0.5 * 0.16 / 0.34) / std::sqrt(0.34);
  const double none = std::exp(-0.5 * 12.96 / 0.09) / 0.3;
  const double down = std::exp(-0.5 * 57.76 / 0.34) / std::sqrt(0.34);
  const double lower = 0.7 * (0.1 + 0.9 * none / up) + 0.3 * 0.9 * down / up;
  const double upper = 0.3 * (0.1 + 0.9 * none / up) + 0.7 * 0.9;
  ASSERT_EQ(result.size(), 2U);
  EXPECT_NEAR(result[0], lower / (lower + upper), 1e-12);
  EXPECT_NEAR(result[1], upper / (lower + upper), 1e-12);
}

TEST(ClimbFloorChain, DoubtsAStartFromWhichTheClimbLeadsNowhere) {
  // From the upper floor a storey up is not on the map: of that start a hundredth remains, so the
  // upper floor holds 0.99 + 0.01 of the sum 0.01 + 0.99 + 0.01 of even starts.
  const auto result = after_climb({0.5, 0.5}, climb_of(4.5, 0.1), storeys(4.5, 0.1, 0.01));
  EXPECT_NEAR(result[1], 1.0 / 1.01, 1e-9);
}

TEST(ClimbFloorChain, StaysWhereItWasForAnAbsurdClimb) {
  const auto result = after_climb({0.6, 0.3, 0.1}, climb_of(1e6, 0.5), storeys(4.5, 0.8, 0.01));
  EXPECT_NEAR(result[0], 0.6, 1e-9);
  EXPECT_NEAR(result[1], 0.3, 1e-9);
}

TEST(ClimbFloorChain, CountsLevelsNotFloors) {
  const auto options = storeys(4.0, 0.1, 0.01);
  const std::vector<int> levels = {-2, 0};
  const auto one = climb_floor_chain({1.0, 0.0}, climb_fits(levels, climb_of(4.0, 0.1), options));
  EXPECT_NEAR(one[0], 1.0, 1e-9);
  // Two storeys: 0.99 have moved, 0.01 may be a false climb.
  const auto two = climb_floor_chain({1.0, 0.0}, climb_fits(levels, climb_of(8.0, 0.1), options));
  EXPECT_NEAR(two[1], 0.99, 1e-9);
}

TEST(FloorFilter, LetsEachReportOfAClimbReplaceTheOneBefore) {
  const std::vector<int> levels = {0, 1, 2};
  const auto heard = votes({{0, 0.0}, {1, -1.2}, {2, -3.1}});
  FloorFilter told_once(storeys(4.0, 0.5, 0.02), levels);
  FloorFilter told_often(storeys(4.0, 0.5, 0.02), levels);
  for (FloorFilter* filter : {&told_once, &told_often}) filter->add(heard);
  for (const double climb_m : {1.7, 5.0}) told_often.add(climb_of(climb_m, 0.4));
  for (FloorFilter* filter : {&told_once, &told_often}) filter->add(climb_of(3.8, 0.4));
  EXPECT_EQ(told_often.probabilities(), told_once.probabilities());
  EXPECT_EQ(told_once.most_likely(), core::FloorId{1});

  observation::VerticalMotion next = climb_of(4.3, 0.4);
  next.begin = core::device_time_from_seconds(30.0);
  told_once.add(next);
  EXPECT_EQ(told_once.most_likely(), core::FloorId{2});
}

TEST(FloorFilter, PassesOverClimbsThatAreNotNumbersOrComeTooEarly) {
  FloorFilter filter(FloorFilter::Options(), 2);
  filter.add(climb_of(4.5, 0.5));
  EXPECT_EQ(filter.probabilities(), (std::vector<double>{0.5, 0.5}));
  filter.add(votes({{0, 0.0}, {1, -3.0}}));
  const std::vector<double> before = filter.probabilities();
  filter.add(climb_of(std::nan(""), 0.5));
  filter.add(climb_of(4.5, std::nan("")));
  filter.add(climb_of(4.5, 0.0));
  filter.add(climb_of(std::numeric_limits<double>::infinity(), 0.5));
  EXPECT_EQ(filter.probabilities(), before);
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
