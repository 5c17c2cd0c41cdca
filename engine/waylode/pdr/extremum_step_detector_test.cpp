// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/extremum_step_detector.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <complex>
#include <limits>

#include "waylode/pdr/testing/gait_fixture.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_ms;
using core::device_time_from_seconds;

struct Case {
  testing::Gait gait;
  ExtremumStepDetector::Options options;
};

class ExtremumStepDetectorOnWalks : public ::testing::TestWithParam<Case> {};

TEST_P(ExtremumStepDetectorOnWalks, CountsWithinThreePercent) {
  core::Rng rng(31);
  constexpr std::size_t kSteps = 300;
  ExtremumStepDetector detector(GetParam().options);
  const auto steps = testing::feed(detector, testing::walk(GetParam().gait, kSteps, rng).inputs);
  EXPECT_NEAR(static_cast<double>(steps.size()), kSteps, 0.03 * kSteps);
}

INSTANTIATE_TEST_SUITE_P(
    Rates, ExtremumStepDetectorOnWalks,
    ::testing::Values(Case{{.rate_hz = 100.0}, {}}, Case{{.rate_hz = 50.0}, {}},
                      Case{{.rate_hz = 100.0, .time_jitter_s = 0.004}, {}},
                      Case{{.rate_hz = 100.0}, {.hysteresis = false}},
                      Case{{.rate_hz = 100.0},
                           {.decimator = {.anti_alias = false}, .hysteresis = false}},
                      Case{{.cadence_hz = 2.2, .swing_mps2 = 11.0}, {}}));

TEST(ExtremumStepDetector, FiltersByTheMeanOfFour) {
  ExtremumStepDetector::Filter filter({.anti_alias = false});
  const double values[] = {1.0, 3.0, -2.0, 6.0, 10.0, -4.0};
  std::vector<TimedValue> means;
  for (int i = 0; i < 6; ++i) {
    if (const auto mean = filter.add(device_time_from_ms(40 * i), values[i]))
      means.push_back(*mean);
  }
  ASSERT_EQ(means.size(), 3U);
  EXPECT_DOUBLE_EQ(means[0].value, 2.0);
  EXPECT_DOUBLE_EQ(means[1].value, 4.25);
  EXPECT_DOUBLE_EQ(means[2].value, 2.5);
  // The mean of four at 25 Hz is 60 ms old.
  EXPECT_EQ(means[0].time, device_time_from_ms(60));
}

TEST(ExtremumStepDetector, FiltersAsTheMeanOfFourMust) {
  // |1 + z + z^2 + z^3| / 4 at 25 Hz: half the power at 2.85 Hz, a quarter at 5 Hz, 0 at 6.25 Hz.
  for (const double frequency_hz : {1.3, 2.85, 5.0, 6.25}) {
    ExtremumStepDetector::Filter filter({.anti_alias = false});
    double largest = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const double phase_rad = 2.0 * core::kPi * frequency_hz * 0.04 * i;
      const auto mean = filter.add(device_time_from_ms(40 * i), std::sin(phase_rad + 0.3));
      if (mean) largest = std::max(largest, std::abs(mean->value));
    }
    std::complex<double> transfer = 0.0;
    for (int k = 0; k < 4; ++k) {
      transfer += 0.25 * std::polar(1.0, -2.0 * core::kPi * frequency_hz * 0.04 * k);
    }
    // Samples may miss the crest where they come round to the same phases.
    EXPECT_LE(largest, std::abs(transfer) + 1e-9) << frequency_hz;
    EXPECT_GE(largest, 0.94 * std::abs(transfer)) << frequency_hz;
  }
}

/// The filter is linear, so a shape that spans many samples passes nearly as it is.
std::vector<StepInput> shape(const std::vector<double>& corners_mps2) {
  std::vector<StepInput> inputs;
  constexpr int kBetween = 60;
  for (std::size_t i = 1; i < corners_mps2.size(); ++i) {
    for (int k = 0; k < kBetween; ++k) {
      const double share = static_cast<double>(k) / kBetween;
      const double value = (1.0 - share) * corners_mps2[i - 1] + share * corners_mps2[i];
      inputs.push_back(
          {device_time_from_ms(10 * static_cast<std::int64_t>(inputs.size())), value, value});
    }
  }
  return inputs;
}

TEST(ExtremumStepDetector, NeedsThePeakAndTheTrough) {
  const auto count = [](const std::vector<double>& corners) {
    ExtremumStepDetector detector({});
    return testing::feed(detector, shape(corners)).size();
  };
  EXPECT_EQ(count({0, 2, -2, 0}), 1U);
  EXPECT_EQ(count({0, 2, -0.3, 0}), 0U);    // No trough.
  EXPECT_EQ(count({0, 0.4, -2, 0}), 0U);    // No peak.
  EXPECT_EQ(count({0, -2, 0, -2, 0}), 0U);  // Troughs alone.
  EXPECT_EQ(count({0, 2, -2, 2, -2, 2, -2, 0}), 3U);
}

TEST(ExtremumStepDetector, LosesTheStepWithARippleOnlyAsPrinted) {
  // Peak, dent that stays above q, smaller rise below p, trough.
  const auto ripple = shape({0, 3, -0.2, 0.3, -3, 0});
  ExtremumStepDetector forgiving({});
  ExtremumStepDetector literal({.hysteresis = false});
  EXPECT_EQ(testing::feed(forgiving, ripple).size(), 1U);
  EXPECT_EQ(testing::feed(literal, ripple).size(), 0U);
}

TEST(ExtremumStepDetector, TellsTheTimeOfThePeak) {
  for (const bool hysteresis : {true, false}) {
    ExtremumStepDetector detector({.hysteresis = hysteresis});
    const auto steps = testing::feed(detector, shape({0, 3, -3, 3, -3, 0}));
    ASSERT_EQ(steps.size(), 2U);
    EXPECT_NEAR(core::to_seconds(steps[0].time.time_since_epoch()), 0.6, 0.041);
    EXPECT_NEAR(core::to_seconds(steps[1].time.time_since_epoch()), 1.8, 0.041);
    EXPECT_NEAR(steps[1].interval_s, 1.2, 0.041);
  }
}

RC_GTEST_PROP(ExtremumStepDetector, LosesNoStepBetweenPieces, ()) {
  // The tail after the last trough is carried over: it matters not how the stream is cut.
  core::Rng rng(*rc::gen::inRange<std::uint64_t>(0, 1000));
  const auto inputs = testing::walk({}, 20, rng).inputs;
  ExtremumStepDetector whole({});
  const auto expected = testing::feed(whole, inputs);
  ExtremumStepDetector in_pieces({});
  std::vector<Step> steps;
  std::size_t begin = 0;
  while (begin < inputs.size()) {
    const std::size_t end = std::min(inputs.size(), begin + *rc::gen::inRange<std::size_t>(1, 200));
    for (const Step& step :
         testing::feed(in_pieces, {inputs.begin() + static_cast<std::ptrdiff_t>(begin),
                                   inputs.begin() + static_cast<std::ptrdiff_t>(end)})) {
      steps.push_back(step);
    }
    begin = end;
  }
  RC_ASSERT(steps.size() == expected.size());
  for (std::size_t i = 0; i < steps.size(); ++i) RC_ASSERT(steps[i].time == expected[i].time);
  RC_ASSERT(steps.size() >= 18U);
}

TEST(ExtremumStepDetector, IsQuietAtRestAndPassesOverWhatIsNoNumber) {
  core::Rng rng(7);
  ExtremumStepDetector detector({});
  for (int i = 0; i < 6000; ++i) {
    const auto time = device_time_from_ms(10 * i);
    EXPECT_FALSE(detector.add({.time = time, .vertical_mps2 = 0.35 * rng.normal()}));
    EXPECT_FALSE(
        detector.add({.time = time, .vertical_mps2 = std::numeric_limits<double>::quiet_NaN()}));
  }
}

TEST(ExtremumStepDetector, ForgetsTheSignalBeforeAHole) {
  ExtremumStepDetector detector({});
  testing::feed(detector, shape({0, 3, 0.5}));
  std::vector<StepInput> after = shape({-3, -3, -3});
  for (StepInput& input : after) input.time += core::from_seconds(60.0);
  EXPECT_TRUE(testing::feed(detector, after).empty());
}

TEST(ExtremumStepDetector, RefusesOptionsOutOfRange) {
  using Options = ExtremumStepDetector::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.decimator = {.interval_s = -1.0}}.validate());
  EXPECT_FALSE((Options{.peak_threshold_mps2 = -1.0, .trough_threshold_mps2 = -1.0}.validate()));
  EXPECT_FALSE(Options{.longest_interval_s = 0.0}.validate());
  EXPECT_FALSE(Options{.peak_threshold_mps2 = std::numeric_limits<double>::quiet_NaN()}.validate());
}

}  // namespace
}  // namespace waylode::pdr
