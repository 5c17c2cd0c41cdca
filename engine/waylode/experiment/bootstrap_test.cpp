// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/rng.hpp"

namespace waylode::experiment {
namespace {

TEST(Bootstrap, IsAsWideAsTheTheoryOfTheMeanSays) {
  core::Rng rng(7);
  std::vector<Unit> units;
  for (int i = 0; i < 400; ++i) units.push_back({rng.normal(5.0, 2.0)});
  const Interval interval = bootstrap(units, mean_of);
  // The standard error of a mean of 400 is 2 / 20 = 0.1; 95 % is 1.96 of it to each side.
  EXPECT_NEAR(interval.value, 5.0, 0.35);
  EXPECT_NEAR(interval.high - interval.low, 2.0 * 1.96 * 0.1, 0.06);
  EXPECT_EQ(interval.n, 400U);
}

TEST(Bootstrap, DrawsWalksWholeSoThatRepeatedValuesAreNoNews) {
  core::Rng rng(8);
  std::vector<Unit> single;
  std::vector<Unit> repeated;
  for (int i = 0; i < 60; ++i) {
    const double value = rng.normal();
    single.push_back({value});
    repeated.push_back(Unit(25, value));
  }
  const Interval once = bootstrap(single, mean_of);
  const Interval often = bootstrap(repeated, mean_of);
  EXPECT_NEAR(often.low, once.low, 1e-9);
  EXPECT_NEAR(often.high, once.high, 1e-9);
}

TEST(Bootstrap, ComparesMethodsOnTheSameDrawnWalks) {
  core::Rng rng(9);
  std::vector<std::vector<Unit>> methods(2);
  for (int i = 0; i < 50; ++i) {
    const double hardness = 1.0 + 4.0 * rng.uniform();
    methods[0].push_back({hardness});
    methods[1].push_back({0.5 * hardness});
  }
  const Interval saved = bootstrap(methods, [](std::span<const std::vector<double>> values) {
    return 100.0 * (1.0 - mean_of(values[1]) / mean_of(values[0]));
  });
  // Half on every walk is half on every draw of walks.
  EXPECT_NEAR(saved.value, 50.0, 1e-9);
  EXPECT_NEAR(saved.low, 50.0, 1e-9);
  EXPECT_NEAR(saved.high, 50.0, 1e-9);
}

TEST(Bootstrap, OfNothingIsNotANumber) {
  const Interval interval = bootstrap(std::span<const Unit>(), mean_of);
  EXPECT_TRUE(std::isnan(interval.value));
  EXPECT_EQ(interval.n, 0U);
}

TEST(Statistics, AgreeWithHandComputation) {
  const std::vector<double> values = {4.0, 1.0, 3.0, 10.0};
  EXPECT_DOUBLE_EQ(mean_of(values), 4.5);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.5), 3.5);
  EXPECT_DOUBLE_EQ(quantile_of(values, 1.0), 10.0);
  EXPECT_DOUBLE_EQ(percent_within(values, 3.0), 50.0);
  EXPECT_TRUE(std::isnan(percent_within({}, 3.0)));
}

TEST(Figure, ReachesItsBarFromTheRightSide) {
  Figure figure;
  figure.ours = {0.8, 0.7, 0.9, 100};
  EXPECT_FALSE(figure.reached().has_value());
  figure.bar = Bar{Bar::Sense::kAtMost, 0.8};
  EXPECT_TRUE(*figure.reached());
  figure.bar->limit = 0.79;
  EXPECT_FALSE(*figure.reached());
  figure.bar = Bar{Bar::Sense::kAtLeast, 0.79};
  EXPECT_TRUE(*figure.reached());
  figure.ours.value = std::nan("");
  EXPECT_FALSE(*figure.reached());
}

TEST(Tally, CountsJudgedFiguresOnly) {
  Outcome outcome;
  outcome.figures.resize(3);
  outcome.figures[0].ours.value = 1.0;
  outcome.figures[0].bar = Bar{Bar::Sense::kAtMost, 2.0};
  outcome.figures[1].ours.value = 3.0;
  outcome.figures[1].bar = Bar{Bar::Sense::kAtMost, 2.0};
  const Tally counted = tally({outcome, outcome});
  EXPECT_EQ(counted.judged, 4U);
  EXPECT_EQ(counted.reached, 2U);
}

}  // namespace
}  // namespace waylode::experiment
