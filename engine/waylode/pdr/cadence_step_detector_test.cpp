// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/cadence_step_detector.hpp"

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
using core::to_seconds;
using std::numbers::pi;
using Options = CadenceStepDetector::Options;

constexpr Options kOptions;

struct Gait {
  double cadence_hz;
  double step_mps2;    ///< Of what both feet do alike.
  double stride_mps2;  ///< Of what one foot does against the other.
  double rate_hz;

  double at(double time_s) const {
    const double phase_rad = 2.0 * pi * cadence_hz * time_s;
    return step_mps2 * std::sin(phase_rad) + stride_mps2 * std::sin(0.5 * phase_rad);
  }
};

/// A detector and what it told.
struct Walk {
  CadenceStepDetector detector{kOptions};
  std::vector<Step> steps;
  std::vector<core::DeviceTime> told;

  void add(double time_s, double value_mps2) {
    const core::DeviceTime time = device_time_from_seconds(time_s);
    if (const auto step = detector.add({time, value_mps2, value_mps2})) {
      steps.push_back(*step);
      told.push_back(time);
    }
  }
  void add(const Gait& gait, double begin_s, double duration_s) {
    for (int i = 0; i < static_cast<int>(duration_s * gait.rate_hz); ++i) {
      add(begin_s + i / gait.rate_hz, gait.at(i / gait.rate_hz));
    }
  }
  void stand(double begin_s, double duration_s, core::Rng& rng) {
    constexpr double kNoise_mps2 = 0.15;
    for (int i = 0; i < static_cast<int>(duration_s * 50.0); ++i) {
      add(begin_s + 0.02 * i, kNoise_mps2 * rng.normal());
    }
  }
  std::size_t count_between(double begin_s, double end_s) const {
    std::size_t count = 0;
    for (const Step& step : steps) {
      const double time_s = to_seconds(step.time.time_since_epoch());
      if (time_s >= begin_s && time_s < end_s) ++count;
    }
    return count;
  }
};

class CadenceStepDetectorOnGaits : public testing::TestWithParam<Gait> {};

TEST_P(CadenceStepDetectorOnGaits, CountsEveryStep) {
  Walk walk;
  constexpr double kDuration_s = 60.0;
  walk.add(GetParam(), 100.0, kDuration_s);
  // The first few may lie in the filters' beginning, the last is not told yet.
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), GetParam().cadence_hz * kDuration_s, 3.0);
}

TEST_P(CadenceStepDetectorOnGaits, TellsStepsInOrderAndInTime) {
  Walk walk;
  walk.add(GetParam(), 0.0, 30.0);
  ASSERT_GT(walk.steps.size(), 20U);
  // The peak that confirms is itself known a fraction of a second late.
  const double known_s = 0.3 * kOptions.longest_interval_s + 0.1;
  for (std::size_t i = 0; i < walk.steps.size(); ++i) {
    const double delay_s = to_seconds(walk.told[i] - walk.steps[i].time);
    EXPECT_GE(delay_s, 0.0);
    EXPECT_LE(delay_s, kOptions.longest_delay_s + known_s);
    if (i == 0) continue;
    EXPECT_GT(walk.steps[i].time, walk.steps[i - 1].time);
    // A step that shows no peak of its own waits for the next foot's.
    const bool under_way = i > 10;
    EXPECT_TRUE(!under_way || delay_s <= known_s + 1.0 / GetParam().cadence_hz) << delay_s;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Placements, CadenceStepDetectorOnGaits,
    testing::Values(Gait{1.85, 2.5, 0.0, 50.0},  // In the hand.
                    Gait{1.4, 1.1, 0.3, 100.0},  // The same, slowly.
                    Gait{1.15, 1.6, 0.0, 50.0},  // More slowly than the range of intervals.
                    Gait{2.1, 3.5, 2.0, 200.0},  // In a trouser pocket.
                    Gait{1.9, 1.5, 2.0, 100.0},  // On a swinging arm: the stride dominates.
                    Gait{1.75, 1.2, 1.7, 50.0},  // The same.
                    Gait{2.9, 9.0, 1.0, 50.0},   // Running.
                    Gait{1.8, 2.0, 0.5, 27.0}));

TEST(CadenceStepDetector, DescribesTheStepsOfASine) {
  const Gait gait{1.9, 2.7, 0.0, 50.0};
  Walk walk;
  walk.add(gait, 0.0, 30.0);
  // Of two stages y += g (x - y), g = 1 - exp(-2 pi f_c dt).
  const double stage = 1.0 - std::exp(-2.0 * pi * kOptions.low_pass_hz / gait.rate_hz);
  const auto sample_delay = std::polar(1.0, -2.0 * pi * gait.cadence_hz / gait.rate_hz);
  const double amplitude_mps2 =
      gait.step_mps2 * std::norm(stage / (1.0 - (1.0 - stage) * sample_delay));
  ASSERT_GT(walk.steps.size(), 20U);
  for (std::size_t i = 10; i < walk.steps.size(); ++i) {
    const Step& step = walk.steps[i];
    EXPECT_NEAR(step.swing_mps2, 2.0 * amplitude_mps2, 0.03 * amplitude_mps2);
    EXPECT_NEAR(step.lowest_mps2, -amplitude_mps2, 0.03 * amplitude_mps2);
    EXPECT_NEAR(step.mean_abs_mps2, 2.0 / pi * amplitude_mps2, 0.1 * amplitude_mps2);
    EXPECT_NEAR(step.mean_mps2, 0.0, 0.12 * amplitude_mps2);
    EXPECT_NEAR(step.interval_s, 1.0 / gait.cadence_hz, 0.03);
  }
}

TEST(CadenceStepDetector, TellsNothingOfAPhoneAtRest) {
  Walk walk;
  core::Rng rng(5);
  walk.stand(0.0, 300.0, rng);
  for (int i = 0; i < 2'000; ++i) walk.add(400.0 + 0.02 * i, 1.7);
  EXPECT_TRUE(walk.steps.empty());
}

TEST(CadenceStepDetector, TellsNothingOfAShake) {
  Walk walk;
  core::Rng rng(6);
  walk.stand(0.0, 5.0, rng);
  const Gait shake{2.3, 8.0, 0.0, 50.0};
  walk.add(shake, 5.0, 0.8);  // Less than two swings.
  walk.stand(5.8, 10.0, rng);
  EXPECT_TRUE(walk.steps.empty());
}

TEST(CadenceStepDetector, TellsNothingOfUnevenHandling) {
  Walk walk;
  // Bumps at intervals that never repeat within a rhythm's window.
  double bump_s = 1.0;
  std::vector<double> bumps_s;
  for (const double interval_s : {0.45, 1.10, 0.70, 1.45, 0.35, 0.95, 0.55, 1.30, 0.40, 0.80}) {
    bumps_s.push_back(bump_s += interval_s);
  }
  for (int i = 0; i < 600; ++i) {
    double value_mps2 = 0.0;
    for (const double centre_s : bumps_s) {
      const double beside_s = std::abs(0.02 * i - centre_s);
      if (beside_s < 0.15) value_mps2 += 2.0 * (1.0 + std::cos(pi * beside_s / 0.15));
    }
    walk.add(0.02 * i, value_mps2);
  }
  EXPECT_TRUE(walk.steps.empty());
}

TEST(CadenceStepDetector, CountsEachOfSeveralWalksAndNoStanding) {
  Walk walk;
  core::Rng rng(7);
  const Gait gait{1.8, 2.4, 0.6, 50.0};
  for (int i = 0; i < 6; ++i) {
    const double begin_s = 30.0 * i;
    walk.add(gait, begin_s, 15.0);
    walk.stand(begin_s + 15.0, 15.0, rng);
    EXPECT_NEAR(static_cast<double>(walk.count_between(begin_s, begin_s + 15.5)), 15.0 * 1.8, 2.5);
    EXPECT_EQ(walk.count_between(begin_s + 15.5, begin_s + 30.0), 0U);
  }
}

TEST(CadenceStepDetector, CountsAShortClearWalk) {
  Walk walk;
  core::Rng rng(8);
  walk.stand(0.0, 5.0, rng);
  walk.add(Gait{1.8, 3.0, 0.0, 50.0}, 5.0, 5.0 / 1.8);
  walk.stand(5.0 + 5.0 / 1.8, 5.0, rng);
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), 5.0, 1.0);
}

TEST(CadenceStepDetector, StartsAnewAfterAGap) {
  Walk walk;
  const Gait gait{1.8, 2.4, 0.6, 50.0};
  walk.add(gait, 0.0, 20.0);
  walk.add(gait, 35.0, 20.0);
  EXPECT_EQ(walk.count_between(20.0, 35.0), 0U);
  EXPECT_NEAR(static_cast<double>(walk.count_between(0.0, 20.0)), 36.0, 2.5);
  EXPECT_NEAR(static_cast<double>(walk.count_between(35.0, 60.0)), 36.0, 2.5);
  for (const Step& step : walk.steps) {
    if (step.time < device_time_from_seconds(35.0)) continue;
    EXPECT_EQ(step.interval_s, kOptions.pause_s);
    break;
  }
}

TEST(CadenceStepDetector, PassesOverWhatIsNoMeasurement) {
  const Gait gait{1.9, 2.1, 0.9, 50.0};
  Walk clean;
  clean.add(gait, 10.0, 30.0);
  Walk dirty;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1'500; ++i) {
    const double time_s = 10.0 + i / gait.rate_hz;
    dirty.add(time_s, gait.at(i / gait.rate_hz));
    const core::DeviceTime time = device_time_from_seconds(time_s);
    // Steps may be handed out at these too, but never more or others.
    for (const StepInput& bad :
         {StepInput{time, nan, 1.0}, StepInput{time, 1.0, nan}, StepInput{time, infinite, 0.0},
          StepInput{time, 0.0, -infinite}, StepInput{time, 1e9, 1e9},
          StepInput{time - core::from_seconds(0.5), 5.0, 5.0}}) {
      if (const auto step = dirty.detector.add(bad)) dirty.steps.push_back(*step);
    }
  }
  ASSERT_EQ(clean.steps.size(), dirty.steps.size());
  for (std::size_t i = 0; i < clean.steps.size(); ++i) {
    EXPECT_EQ(clean.steps[i].time, dirty.steps[i].time);
    EXPECT_EQ(clean.steps[i].swing_mps2, dirty.steps[i].swing_mps2);
  }
}

TEST(CadenceStepDetector, TakesTimesThatRepeat) {
  const Gait gait{1.9, 2.1, 0.9, 50.0};
  Walk walk;
  for (int i = 0; i < 1'500; ++i) {
    walk.add(0.02 * i, gait.at(0.02 * i));
    walk.add(0.02 * i, gait.at(0.02 * i));
  }
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), 57.0, 2.5);
}

TEST(CadenceStepDetector, TakesJitter) {
  const Gait gait{1.9, 2.1, 0.9, 100.0};
  Walk walk;
  core::Rng rng(9);
  for (double time_s = 0.0; time_s < 30.0; time_s += 0.004 + 0.016 * rng.uniform()) {
    walk.add(time_s, gait.at(time_s));
  }
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), 57.0, 2.5);
}

/// Cadence and strength wander; some stretches are still.
std::vector<double> any_walk() {
  std::vector<double> values;
  double phase_rad = 0.0;
  for (const int draw : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 400))) {
    const double frequency_hz = 1.2 + 0.003 * draw;
    const double amplitude_mps2 = 0.05 * (draw % 80);
    for (int i = 0; i < 100; ++i) {
      phase_rad += 2.0 * pi * frequency_hz * 0.02;
      values.push_back(amplitude_mps2 * (std::sin(phase_rad) + 0.4 * std::sin(0.5 * phase_rad)));
    }
  }
  return values;
}

std::vector<std::pair<std::size_t, Step>> told(const std::vector<double>& values, double begin_s) {
  CadenceStepDetector detector(kOptions);
  std::vector<std::pair<std::size_t, Step>> steps;
  const auto begin = device_time_from_seconds(begin_s);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto time = begin + std::chrono::milliseconds(20 * i);
    if (const auto step = detector.add({time, values[i], values[i]})) steps.emplace_back(i, *step);
  }
  return steps;
}

RC_GTEST_PROP(CadenceStepDetector, TellsOfAPrefixWhatItTellsOfTheWhole, ()) {
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

RC_GTEST_PROP(CadenceStepDetector, DoesNotDependOnTheClocksZero, ()) {
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

RC_GTEST_PROP(CadenceStepDetector, TellsStepsApartAndSound, ()) {
  const auto steps = told(any_walk(), 0.0);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i].second;
    RC_ASSERT(step.swing_mps2 >= 0.0 && step.mean_abs_mps2 >= std::abs(step.mean_mps2));
    RC_ASSERT(step.interval_s > 0.0 && step.interval_s <= kOptions.pause_s);
    if (i == 0) continue;
    const double apart_s = to_seconds(step.time - steps[i - 1].second.time);
    RC_ASSERT(apart_s > 0.5 * kOptions.shortest_interval_s);
  }
}

RC_GTEST_PROP(CadenceStepDetector, CountsAlikeAtAnyRate, ()) {
  const double cadence_hz = 1.3 + 0.01 * *rc::gen::inRange(0, 100);
  const double step_mps2 = 1.5 + 0.1 * *rc::gen::inRange(0, 40);
  const double stride_mps2 = 0.1 * *rc::gen::inRange(0, 7) * step_mps2;
  std::vector<double> counts;
  for (const double rate_hz : {50.0, 100.0, 400.0}) {
    Walk walk;
    walk.add(Gait{cadence_hz, step_mps2, stride_mps2, rate_hz}, 0.0, 30.0);
    counts.push_back(static_cast<double>(walk.steps.size()));
  }
  RC_ASSERT(std::abs(counts[0] - counts[1]) <= 2.0);
  RC_ASSERT(std::abs(counts[0] - counts[2]) <= 2.0);
}

TEST(CadenceStepDetector, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.low_pass_hz = value}.validate());
    EXPECT_FALSE(Options{.high_pass_hz = value}.validate());
    EXPECT_FALSE(Options{.shortest_interval_s = value}.validate());
    EXPECT_FALSE(Options{.longest_interval_s = value}.validate());
    EXPECT_FALSE(Options{.rhythm_window_s = value}.validate());
    EXPECT_FALSE(Options{.start_correlation_ratio = value}.validate());
    EXPECT_FALSE(Options{.stay_correlation_ratio = value}.validate());
    EXPECT_FALSE(Options{.longest_delay_s = value}.validate());
    EXPECT_FALSE(Options{.min_prominence_mps2 = value}.validate());
    EXPECT_FALSE(Options{.clear_prominence_mps2 = value}.validate());
    EXPECT_FALSE(Options{.relative_prominence_ratio = value}.validate());
    EXPECT_FALSE(Options{.pause_s = value}.validate());
  }
  EXPECT_FALSE(Options{.first_steps = 1}.validate());
  EXPECT_FALSE(Options{.rhythm_window_s = 2.0}.validate());
  EXPECT_FALSE(Options{.start_correlation_ratio = 0.3}.validate());
  EXPECT_FALSE(Options{.pause_s = 0.8}.validate());
}

}  // namespace
}  // namespace waylode::pdr
