// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/adaptive_peak_detector.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "waylode/pdr/testing/gait_fixture.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using Detector = AdaptivePeakDetector;

struct Case {
  testing::Gait gait;
  Detector::Gait expected;
};

class AdaptivePeakDetectorOnWalks : public ::testing::TestWithParam<Case> {};

TEST_P(AdaptivePeakDetectorOnWalks, CountsWithinTwoPercent) {
  core::Rng rng(11);
  constexpr std::size_t kSteps = 400;
  Detector detector({});
  const auto steps = testing::feed(detector, testing::walk(GetParam().gait, kSteps, rng).inputs);
  EXPECT_NEAR(static_cast<double>(steps.size()), kSteps, 0.02 * kSteps);
}

TEST_P(AdaptivePeakDetectorOnWalks, NamesTheGait) {
  core::Rng rng(12);
  Detector detector({});
  const auto walk = testing::walk(GetParam().gait, 60, rng, 0.0, 0.0);
  testing::feed(detector, walk.inputs);
  EXPECT_EQ(detector.gait(), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Gaits, AdaptivePeakDetectorOnWalks,
    ::testing::Values(Case{{.cadence_hz = 1.35, .swing_mps2 = 3.2}, Detector::Gait::kSlow},
                      Case{{.cadence_hz = 1.8, .swing_mps2 = 7.0}, Detector::Gait::kNormal},
                      Case{{.cadence_hz = 1.85, .swing_mps2 = 8.5, .rate_hz = 50.0},
                           Detector::Gait::kNormal},
                      Case{{.cadence_hz = 2.25, .swing_mps2 = 14.0}, Detector::Gait::kFast},
                      Case{{.cadence_hz = 2.8, .swing_mps2 = 32.0}, Detector::Gait::kRun}));

TEST(AdaptivePeakDetector, CountsNothingOfAPhoneAtRest) {
  core::Rng rng(5);
  Detector detector({});
  for (int i = 0; i < 12'000; ++i) {
    const auto time = device_time_from_seconds(0.01 * i);
    EXPECT_FALSE(detector.add({.time = time, .vertical_mps2 = 0.35 * rng.normal()}));
  }
  EXPECT_EQ(detector.gait(), Detector::Gait::kStill);
}

TEST(AdaptivePeakDetector, CountsNothingOfLoneBumps) {
  // One strong bump of 0.3 s in every four seconds.
  Detector detector({});
  for (int i = 0; i < 6'000; ++i) {
    const double since_s = 0.01 * (i % 400);
    const double value = since_s < 0.3 ? 4.0 * std::sin(core::kPi * since_s / 0.3) : -0.1;
    EXPECT_FALSE(
        detector.add({.time = device_time_from_seconds(0.01 * i), .vertical_mps2 = value}));
  }
}

TEST(AdaptivePeakDetector, TellsTheFirstStepsOnceTheWalkIsKnown) {
  Detector detector({});
  const auto steps = testing::feed(detector, testing::sinusoid(3.0, 1.8, 100.0, 10.0));
  ASSERT_EQ(steps.size(), 18U);
  // The first crest is at a quarter period, 0.139 s; the two low-pass stages delay it by
  // 2 atan(1.8 / 3) / (2 pi 1.8) = 0.096 s once settled, less at the start.
  EXPECT_NEAR(core::to_seconds(steps[0].time.time_since_epoch()), 0.22, 0.05);
  EXPECT_EQ(steps[0].interval_s, 1.5);
  for (std::size_t i = 2; i < steps.size(); ++i) {
    EXPECT_NEAR(steps[i].interval_s, 1.0 / 1.8, 0.015);
  }
}

TEST(AdaptivePeakDetector, MeasuresTheSmoothedWave) {
  Detector detector({});
  const auto steps = testing::feed(detector, testing::sinusoid(3.0, 1.8, 200.0, 20.0));
  // Each stage passes 1 / sqrt(1 + (1.8 / 3)^2) of it.
  const double amplitude_mps2 = 3.0 / (1.0 + 0.6 * 0.6);
  ASSERT_GT(steps.size(), 20U);
  for (std::size_t i = 10; i < steps.size(); ++i) {
    EXPECT_NEAR(steps[i].swing_mps2, 2.0 * amplitude_mps2, 0.03 * amplitude_mps2);
    EXPECT_NEAR(steps[i].lowest_mps2, -amplitude_mps2, 0.03 * amplitude_mps2);
    EXPECT_NEAR(steps[i].mean_abs_mps2, 2.0 / core::kPi * amplitude_mps2, 0.03 * amplitude_mps2);
    EXPECT_NEAR(steps[i].mean_mps2, 0.0, 0.03 * amplitude_mps2);
  }
}

TEST(AdaptivePeakDetector, HoldsToTheGaitBeforeUntilItHasLasted) {
  // Four normal peaks, then fast ones: with full weight the first fast ones do not turn it.
  Detector::Options options;
  options.history_weight = 0.95;
  options.history_tau_s = 1000.0;
  Detector steadfast(options);
  options.history_tau_s = 0.5;
  Detector fickle(options);
  std::vector<StepInput> inputs = testing::sinusoid(3.6, 1.8, 100.0, 10.0);
  const auto fast = testing::sinusoid(8.0, 2.25, 100.0, 20.0, 10.0);
  inputs.insert(inputs.end(), fast.begin(), fast.end());
  testing::feed(steadfast, inputs);
  testing::feed(fickle, inputs);
  EXPECT_EQ(steadfast.gait(), Detector::Gait::kStill);  // What it began with.
  EXPECT_EQ(fickle.gait(), Detector::Gait::kFast);
}

TEST(AdaptivePeakDetector, StartsAnewAfterAHoleAndAPause) {
  Detector detector({});
  EXPECT_FALSE(testing::feed(detector, testing::sinusoid(3.0, 1.8, 100.0, 10.0)).empty());
  detector.add({.time = device_time_from_seconds(40.0), .vertical_mps2 = 0.0});
  EXPECT_EQ(detector.gait(), Detector::Gait::kStill);
  const auto again = testing::feed(detector, testing::sinusoid(3.0, 1.8, 100.0, 10.0, 50.0));
  ASSERT_FALSE(again.empty());
  EXPECT_EQ(again.front().interval_s, 1.5);
  EXPECT_GE(again.front().time, device_time_from_seconds(50.0));
}

TEST(AdaptivePeakDetector, PassesOverWhatIsNoNumber) {
  Detector clean({});
  Detector spoilt({});
  std::size_t clean_count = 0;
  std::size_t spoilt_count = 0;
  for (const StepInput& input : testing::sinusoid(3.0, 1.8, 100.0, 20.0)) {
    clean_count += clean.add(input).has_value() ? 1U : 0U;
    spoilt_count += spoilt.add(input).has_value() ? 1U : 0U;
    StepInput bad = input;
    bad.vertical_mps2 = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(spoilt.add(bad));
    bad.vertical_mps2 = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(spoilt.add(bad));
  }
  EXPECT_EQ(clean_count, spoilt_count);
}

TEST(AdaptivePeakDetector, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(Detector::Options{}.validate());
  const auto refused = [](auto&& spoil) {
    Detector::Options options;
    spoil(options);
    return !options.validate();
  };
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(refused([&](auto& o) { o.low_pass_hz = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.history_weight = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.history_tau_s = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.relative_peak_ratio = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.noise_peak_mps2 = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.shortest_interval_s = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.longest_interval_s = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.bands[2].peak_mps2 = value; }));
    EXPECT_TRUE(refused([&](auto& o) { o.bands[3].cadence_sigma_hz = value; }));
  }
  EXPECT_TRUE(refused([](auto& o) { o.history_weight = 1.0; }));
}

}  // namespace
}  // namespace waylode::pdr
