// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/step_length.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/rng.hpp"

namespace waylode::experiment {
namespace {

/// Walks whose steps obey L = 0.15 mean|a| T + 0.25 swing^(1/4) exactly.
std::vector<MeasuredWalk> improved_walks(int count) {
  core::Rng rng(3);
  std::vector<MeasuredWalk> walks;
  for (int w = 0; w < count; ++w) {
    MeasuredWalk walk;
    walk.name = "walk " + std::to_string(w);
    const double pace = rng.uniform(0.45, 0.75);
    const double bounce = rng.uniform(3.0, 12.0);
    const double mean = rng.uniform(1.0, 3.5);
    for (int s = 0; s < 40; ++s) {
      pdr::Step step;
      step.interval_s = pace * rng.uniform(0.95, 1.05);
      step.swing_mps2 = bounce * rng.uniform(0.9, 1.1);
      step.mean_abs_mps2 = mean * rng.uniform(0.9, 1.1);
      walk.distance_m +=
          0.15 * step.mean_abs_mps2 * step.interval_s + 0.25 * std::pow(step.swing_mps2, 0.25);
      walk.steps.push_back(step);
    }
    walks.push_back(walk);
  }
  return walks;
}

const StepLengthResult& find(const std::vector<StepLengthResult>& results, const char* model) {
  for (const StepLengthResult& result : results) {
    if (result.model == model) return result;
  }
  throw std::runtime_error(model);
}

TEST(CompareStepLengths, RecoversTheLawThatMadeTheWalks) {
  const auto results = compare_step_lengths(improved_walks(30), 5);
  ASSERT_TRUE(results);
  const StepLengthResult& improved = find(*results, "improved");
  ASSERT_EQ(improved.coefficients.size(), 2U);
  EXPECT_NEAR(improved.coefficients[0], 0.15, 1e-9);
  EXPECT_NEAR(improved.coefficients[1], 0.25, 1e-9);
  for (const double error : improved.relative_errors_pct) EXPECT_NEAR(error, 0.0, 1e-6);
}

TEST(CompareStepLengths, LeavesAnotherModelWithErrors) {
  const auto results = compare_step_lengths(improved_walks(30), 5);
  ASSERT_TRUE(results);
  double sum = 0.0;
  for (const double error : find(*results, "Weinberg").relative_errors_pct) sum += std::abs(error);
  EXPECT_GT(sum / 30.0, 1.0);
}

TEST(CompareStepLengths, TriesWalksOnlyWithWhatOtherFoldsTaught) {
  std::vector<MeasuredWalk> walks = improved_walks(20);
  // One walk twice as long as its steps say. Out of fold it cannot pull its own error down: it
  // reads half of what it should.
  walks[7].distance_m *= 2.0;
  const auto results = compare_step_lengths(walks, 20);
  ASSERT_TRUE(results);
  EXPECT_NEAR(find(*results, "improved").relative_errors_pct[7], -50.0, 1e-6);
}

TEST(CompareStepLengths, RefusesTooFewWalks) {
  const auto few = compare_step_lengths(improved_walks(4), 2);
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, core::ErrorCode::kSurveyInsufficient);
  EXPECT_FALSE(compare_step_lengths(improved_walks(6), 7));
  EXPECT_FALSE(compare_step_lengths({}, 5));
}

TEST(StepLengthOutcome, JudgesTheImprovedModelAgainstWeinberg) {
  const auto outcome = step_length_outcome(improved_walks(40));
  ASSERT_TRUE(outcome);
  int judged = 0;
  for (const Figure& figure : outcome->figures) {
    if (!figure.bar) continue;
    ++judged;
    EXPECT_TRUE(*figure.reached()) << figure.what;
    EXPECT_GT(figure.ours.low, 0.0) << figure.what;
  }
  EXPECT_EQ(judged, 3);
}

/// Vertical bounces of 4 m/s2 to both sides at 2 Hz: 2 steps a second.
std::vector<sample::Sample> bouncing_walk(double duration_s) {
  std::vector<sample::Sample> samples;
  for (int i = 0; i < static_cast<int>(duration_s * 50.0); ++i) {
    const double t_s = i / 50.0;
    sample::AccelerometerSample force;
    force.time = core::DeviceTime{} + core::from_seconds(t_s);
    force.specific_force_mps2 = {0.0, 0.0, 9.80665 + 4.0 * std::sin(4.0 * M_PI * t_s)};
    samples.emplace_back(force);
  }
  return samples;
}

TEST(MeasureWalk, CountsTheStepsBetweenTheMarksAndTheWayAlongThem) {
  const auto at_s = [](double t_s) { return core::DeviceTime{} + core::from_seconds(t_s); };
  const std::vector<Mark> marks = {
      {at_s(2.0), {0.0, 0.0}}, {at_s(10.0), {10.0, 0.0}}, {at_s(14.0), {10.0, 5.0}}};
  const auto walk = measure_walk("walk", bouncing_walk(20.0), marks);
  ASSERT_TRUE(walk);
  EXPECT_DOUBLE_EQ(walk->distance_m, 15.0);
  EXPECT_NEAR(static_cast<double>(walk->steps.size()), 24.0, 1.0);
}

TEST(MeasureWalk, PassesOverWalksThatTellNothing) {
  const auto at_s = [](double t_s) { return core::DeviceTime{} + core::from_seconds(t_s); };
  const auto samples = bouncing_walk(20.0);
  const std::vector<Mark> one = {{at_s(2.0), {0.0, 0.0}}};
  const std::vector<Mark> near = {{at_s(2.0), {0.0, 0.0}}, {at_s(10.0), {5.0, 0.0}}};
  const std::vector<Mark> far = {{at_s(2.0), {0.0, 0.0}}, {at_s(10.0), {500.0, 0.0}}};
  EXPECT_FALSE(measure_walk("one", samples, one));
  EXPECT_FALSE(measure_walk("near", samples, near));
  EXPECT_FALSE(measure_walk("far", samples, far));
  EXPECT_FALSE(measure_walk("silent", {}, far));
}

}  // namespace
}  // namespace waylode::experiment
