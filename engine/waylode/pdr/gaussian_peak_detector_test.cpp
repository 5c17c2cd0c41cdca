// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/gaussian_peak_detector.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "waylode/pdr/testing/gait_fixture.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;

struct Case {
  double cadence_hz;
  double rate_hz;
};

class GaussianPeakDetectorOnWalks : public ::testing::TestWithParam<Case> {};

TEST_P(GaussianPeakDetectorOnWalks, CountsWithinTwoPercent) {
  core::Rng rng(21);
  const testing::Gait gait{.cadence_hz = GetParam().cadence_hz, .rate_hz = GetParam().rate_hz};
  constexpr std::size_t kSteps = 400;
  GaussianPeakDetector detector({});
  const auto steps = testing::feed(detector, testing::walk(gait, kSteps, rng).inputs);
  EXPECT_NEAR(static_cast<double>(steps.size()), kSteps, 0.02 * kSteps);
}

TEST_P(GaussianPeakDetectorOnWalks, LosesMostStepsAsPrinted) {
  core::Rng rng(22);
  const testing::Gait gait{.cadence_hz = GetParam().cadence_hz, .rate_hz = GetParam().rate_hz};
  constexpr std::size_t kSteps = 400;
  GaussianPeakDetector detector(GaussianPeakDetector::as_printed());
  const auto steps = testing::feed(detector, testing::walk(gait, kSteps, rng).inputs);
  EXPECT_LT(steps.size(), kSteps / 2);
}

INSTANTIATE_TEST_SUITE_P(Cadences, GaussianPeakDetectorOnWalks,
                         ::testing::Values(Case{1.42, 50.0}, Case{1.8, 50.0}, Case{2.2, 50.0},
                                           Case{1.42, 100.0}, Case{2.2, 100.0}, Case{1.8, 25.0}));

TEST(GaussianPeakDetector, TellsPeaksAtTheirTimeAndSoonAfter) {
  GaussianPeakDetector detector({});
  std::size_t count = 0;
  for (const StepInput& input : testing::sinusoid(3.0, 1.6, 100.0, 20.0)) {
    const auto step = detector.add(input);
    if (!step) continue;
    // Crests at (n + 1/4) periods; smoothing is centred, so it does not shift them.
    const double periods = core::to_seconds(step->time.time_since_epoch()) * 1.6 - 0.25;
    EXPECT_NEAR(periods, std::round(periods), 0.01 * 1.6);
    EXPECT_LE(core::to_seconds(input.time - step->time), 0.1 + 0.021);
    ++count;
  }
  EXPECT_EQ(count, 32U);
}

TEST(GaussianPeakDetector, HearsNothingBelowItsThreshold) {
  GaussianPeakDetector detector({});
  EXPECT_TRUE(testing::feed(detector, testing::sinusoid(0.49, 1.8, 50.0, 20.0)).empty());
  EXPECT_FALSE(testing::feed(detector, testing::sinusoid(0.60, 1.8, 50.0, 20.0, 60.0)).empty());
}

TEST(GaussianPeakDetector, StartsAnewAfterAHole) {
  GaussianPeakDetector detector({});
  testing::feed(detector, testing::sinusoid(3.0, 1.8, 50.0, 5.0));
  const auto again = testing::feed(detector, testing::sinusoid(3.0, 1.8, 50.0, 5.0, 30.0));
  ASSERT_EQ(again.size(), 9U);
  EXPECT_EQ(again.front().interval_s, 1.2);
  // From the first full window's middle, 0.1 s into the wave, to the crest; not from before.
  const double gain = std::exp(-0.5 * std::pow(2.0 * core::kPi * 1.8 * 0.2 / 6.0, 2));
  const double swing_mps2 = 3.0 * gain * (1.0 - std::sin(2.0 * core::kPi * 1.8 * 0.1));
  EXPECT_NEAR(again.front().swing_mps2, swing_mps2, 0.05);
}

TEST(GaussianPeakDetector, PassesOverWhatIsNoNumberAndConstantInput) {
  GaussianPeakDetector detector({});
  for (int i = 0; i < 500; ++i) {
    const auto time = device_time_from_seconds(0.02 * i);
    EXPECT_FALSE(
        detector.add({.time = time, .vertical_mps2 = std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_FALSE(detector.add({.time = time, .vertical_mps2 = 2.0}));
  }
}

TEST(GaussianPeakDetector, RefusesOptionsOutOfRange) {
  using Options = GaussianPeakDetector::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_TRUE(GaussianPeakDetector::as_printed().validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.window_s = value}.validate());
    EXPECT_FALSE(Options{.min_peak_mps2 = value}.validate());
    EXPECT_FALSE(Options{.sample_interval_s = value}.validate());
    EXPECT_FALSE(Options{.shortest_interval_s = value}.validate());
    EXPECT_FALSE(Options{.longest_interval_s = value}.validate());
  }
  EXPECT_FALSE(Options{.window_s = 0.0}.validate());
}

}  // namespace
}  // namespace waylode::pdr
