// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/step_detector.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "waylode/core/rng.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using std::numbers::pi;

constexpr StepDetector::Options kOptions{.low_pass_hz = 3.0,
                                         .min_peak_mps2 = 0.55,
                                         .relative_peak_ratio = 0.4,
                                         .shortest_interval_s = 0.28,
                                         .longest_interval_s = 1.2};

struct Sinusoid {
  double amplitude_mps2;
  double frequency_hz;
  double rate_hz;
};

/// Of the detector's two first-order stages, each y += g (x - y), g = 1 - exp(-2 pi f_c dt).
double filter_gain(const Sinusoid& wave) {
  const double stage = 1.0 - std::exp(-2.0 * pi * kOptions.low_pass_hz / wave.rate_hz);
  const auto delay = std::polar(1.0, -2.0 * pi * wave.frequency_hz / wave.rate_hz);
  return std::norm(stage / (1.0 - (1.0 - stage) * delay));
}

/// Feeds the wave from `begin_s` for `duration_s`.
std::vector<Step> feed(StepDetector& detector, const Sinusoid& wave, double begin_s,
                       double duration_s) {
  std::vector<Step> steps;
  const auto count = static_cast<int>(duration_s * wave.rate_hz);
  for (int i = 0; i < count; ++i) {
    const double elapsed_s = i / wave.rate_hz;
    const double value = wave.amplitude_mps2 * std::sin(2.0 * pi * wave.frequency_hz * elapsed_s);
    const auto time = device_time_from_seconds(begin_s + elapsed_s);
    if (const auto step = detector.add({.time = time, .vertical_mps2 = value})) {
      EXPECT_LE(step->time, time);
      EXPECT_LE(core::to_seconds(time - step->time), 0.5 / wave.frequency_hz);
      steps.push_back(*step);
    }
  }
  return steps;
}

class StepDetectorOnSinusoids : public testing::TestWithParam<Sinusoid> {};

TEST_P(StepDetectorOnSinusoids, CountsEveryPeriod) {
  StepDetector detector(kOptions);
  constexpr double kDuration_s = 60.0;
  const auto steps = feed(detector, GetParam(), 100.0, kDuration_s);
  EXPECT_NEAR(static_cast<double>(steps.size()), GetParam().frequency_hz * kDuration_s, 1.0);
}

TEST_P(StepDetectorOnSinusoids, TellsSwingMeanAndIntervalOfTheSmoothedWave) {
  StepDetector detector(kOptions);
  const Sinusoid wave = GetParam();
  const auto steps = feed(detector, wave, 0.0, 30.0);
  const double swing_mps2 = 2.0 * wave.amplitude_mps2 * filter_gain(wave);
  // The sampled extremes lie at most half a sample beside the true ones.
  const double lowest_mps2 = swing_mps2 * std::cos(pi * wave.frequency_hz / wave.rate_hz);
  ASSERT_GT(steps.size(), 10U);
  double mean_interval_s = 0.0;
  for (std::size_t i = 5; i < steps.size(); ++i) {
    EXPECT_LE(steps[i].swing_mps2, swing_mps2 * 1.001);
    EXPECT_GE(steps[i].swing_mps2, lowest_mps2 * 0.999);
    EXPECT_NEAR(steps[i].mean_abs_mps2, swing_mps2 / pi, 0.1 * swing_mps2 / pi);
    EXPECT_NEAR(steps[i].interval_s, 1.0 / wave.frequency_hz, 1.01 / wave.rate_hz);
    mean_interval_s += steps[i].interval_s / static_cast<double>(steps.size() - 5);
  }
  EXPECT_NEAR(mean_interval_s, 1.0 / wave.frequency_hz, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Walks, StepDetectorOnSinusoids,
                         testing::Values(Sinusoid{1.2, 1.1, 50.0}, Sinusoid{3.0, 1.3, 25.0},
                                         Sinusoid{2.0, 1.7, 50.0}, Sinusoid{4.5, 1.9, 100.0},
                                         Sinusoid{6.0, 2.2, 25.0}, Sinusoid{1.5, 2.4, 200.0},
                                         Sinusoid{5.0, 2.9, 100.0}));

TEST(StepDetector, TellsNothingOfAFaintWave) {
  const Sinusoid wave{0.6, 1.8, 50.0};
  ASSERT_LT(wave.amplitude_mps2 * filter_gain(wave), kOptions.min_peak_mps2);
  StepDetector detector(kOptions);
  EXPECT_TRUE(feed(detector, wave, 0.0, 60.0).empty());
}

TEST(StepDetector, TellsNothingOfAPhoneAtRest) {
  StepDetector detector(kOptions);
  core::Rng rng(5);
  constexpr double kNoise_mps2 = 0.2;
  for (int i = 0; i < 6'000; ++i) {
    EXPECT_FALSE(detector.add(
        {.time = device_time_from_seconds(0.02 * i), .vertical_mps2 = kNoise_mps2 * rng.normal()}));
  }
}

TEST(StepDetector, ForgetsTheSignalBeforeAGap) {
  StepDetector detector(kOptions);
  double time_s = 0.0;
  for (; time_s < 0.5; time_s += 0.02)
    detector.add({.time = device_time_from_seconds(time_s), .vertical_mps2 = -8.0});
  const Sinusoid wave{2.0, 1.8, 50.0};
  const auto steps = feed(detector, wave, 30.0, 10.0);
  ASSERT_FALSE(steps.empty());
  EXPECT_GE(steps.front().time, device_time_from_seconds(30.0));
  EXPECT_LE(steps.front().swing_mps2, 2.0 * wave.amplitude_mps2 * filter_gain(wave));
}

TEST(StepDetector, CapsTheIntervalAfterAPause) {
  StepDetector detector(kOptions);
  const Sinusoid wave{2.0, 1.8, 50.0};
  EXPECT_EQ(feed(detector, wave, 0.0, 10.0).front().interval_s, kOptions.longest_interval_s);
  EXPECT_EQ(feed(detector, wave, 100.0, 10.0).front().interval_s, kOptions.longest_interval_s);
}

TEST(StepDetector, FollowsAGentleWalkAfterAVigorousOne) {
  StepDetector detector(kOptions);
  const Sinusoid vigorous{9.0, 2.4, 50.0};
  const Sinusoid gentle{1.4, 1.7, 50.0};
  ASSERT_LT(gentle.amplitude_mps2 * filter_gain(gentle),
            kOptions.relative_peak_ratio * vigorous.amplitude_mps2 * filter_gain(vigorous));
  feed(detector, vigorous, 0.0, 20.0);
  const auto steps = feed(detector, gentle, 20.0, 30.0);
  // All of them, but for those of the pause after which a new walk begins.
  EXPECT_NEAR(static_cast<double>(steps.size()), 1.7 * (30.0 - kOptions.longest_interval_s), 2.0);
}

/// Cadence and strength wander; some stretches are still.
std::vector<double> any_walk() {
  std::vector<double> values;
  double phase_rad = 0.0;
  for (const int draw : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 400))) {
    const double frequency_hz = 0.5 + 0.007 * draw;
    const double amplitude_mps2 = 0.05 * (draw % 100);
    for (int i = 0; i < 25; ++i) {
      phase_rad += 2.0 * pi * frequency_hz * 0.02;
      values.push_back(amplitude_mps2 * std::sin(phase_rad));
    }
  }
  return values;
}

std::vector<std::pair<std::size_t, Step>> told(const std::vector<double>& values, double begin_s) {
  StepDetector detector(kOptions);
  std::vector<std::pair<std::size_t, Step>> steps;
  const auto begin = device_time_from_seconds(begin_s);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto time = begin + std::chrono::milliseconds(20 * i);
    if (const auto step = detector.add({.time = time, .vertical_mps2 = values[i]}))
      steps.emplace_back(i, *step);
  }
  return steps;
}

RC_GTEST_PROP(StepDetector, TellsOfAPrefixWhatItTellsOfTheWhole, ()) {
  const std::vector<double> whole = any_walk();
  const auto length = *rc::gen::inRange<std::size_t>(0, whole.size() + 1);
  const auto of_whole = told(whole, 0.0);
  const auto of_prefix =
      told({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}, 0.0);
  std::size_t by_then = 0;
  while (by_then < of_whole.size() && of_whole[by_then].first < length) ++by_then;
  RC_ASSERT(of_prefix.size() == by_then);
  for (std::size_t i = 0; i < by_then; ++i) {
    RC_ASSERT(of_prefix[i].second.time == of_whole[i].second.time);
    RC_ASSERT(of_prefix[i].second.swing_mps2 == of_whole[i].second.swing_mps2);
  }
}

RC_GTEST_PROP(StepDetector, DoesNotDependOnTheClocksZero, ()) {
  const std::vector<double> walk = any_walk();
  const auto early = told(walk, 0.0);
  const auto late = told(walk, 86'400.0);
  RC_ASSERT(early.size() == late.size());
  for (std::size_t i = 0; i < early.size(); ++i) {
    RC_ASSERT(late[i].second.time - early[i].second.time == core::from_seconds(86'400.0));
    RC_ASSERT(late[i].second.interval_s == early[i].second.interval_s);
    RC_ASSERT(late[i].second.swing_mps2 == early[i].second.swing_mps2);
  }
}

RC_GTEST_PROP(StepDetector, KeepsStepsApart, ()) {
  const auto steps = told(any_walk(), 0.0);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double apart_s = core::to_seconds(steps[i].second.time - steps[i - 1].second.time);
    RC_ASSERT(apart_s >= kOptions.shortest_interval_s);
    RC_ASSERT(steps[i].second.swing_mps2 >= kOptions.min_peak_mps2);
  }
}

TEST(StepDetector, RefusesOptionsOutOfRange) {
  using Options = StepDetector::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.low_pass_hz = value}.validate());
    EXPECT_FALSE(Options{.min_peak_mps2 = value}.validate());
    EXPECT_FALSE(Options{.relative_peak_ratio = value}.validate());
    EXPECT_FALSE(Options{.shortest_interval_s = value}.validate());
    EXPECT_FALSE(Options{.longest_interval_s = value}.validate());
  }
  EXPECT_FALSE(Options{.relative_peak_ratio = 1.0}.validate());
  EXPECT_FALSE((Options{.shortest_interval_s = 0.5, .longest_interval_s = 0.5}.validate()));
}

}  // namespace
}  // namespace waylode::pdr
