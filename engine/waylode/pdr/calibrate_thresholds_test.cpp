// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/calibrate_thresholds.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

#include "waylode/pdr/extremum_step_detector.hpp"
#include "waylode/pdr/testing/gait_fixture.hpp"

namespace waylode::pdr {
namespace {

constexpr ThresholdOptions kStepping{.search = ThresholdOptions::Search::kStepping,
                                     .stepping_mps2 = 0.001};

// Peaks 4, 3, 5, 1.5; troughs -2, -3.5, -2.5, -0.5; centre (5 - 3.5) / 2 = 0.75.
const std::vector<double> kWalk = {0, 4, -2, 3, -3.5, 5, -2.5, 1.5, -0.5, 0};

TEST(CalibrateThresholds, LiesMidwayBetweenTheLastThatCountsAndTheNext) {
  const auto thresholds = calibrate_thresholds(kWalk, 3);
  ASSERT_TRUE(thresholds);
  EXPECT_TRUE(thresholds->calibration_ok);
  EXPECT_DOUBLE_EQ(thresholds->peak_threshold_mps2, (3.0 + 1.5) / 2.0);
  EXPECT_DOUBLE_EQ(thresholds->trough_threshold_mps2, (-2.0 - 0.5) / 2.0);
}

TEST(CalibrateThresholds, TakesTheCentreWhereNoFurtherExtremeIs) {
  const auto thresholds = calibrate_thresholds(kWalk, 4);
  ASSERT_TRUE(thresholds);
  EXPECT_TRUE(thresholds->calibration_ok);
  EXPECT_DOUBLE_EQ(thresholds->peak_threshold_mps2, (1.5 + 0.75) / 2.0);
  EXPECT_DOUBLE_EQ(thresholds->trough_threshold_mps2, (-0.5 + 0.75) / 2.0);
}

TEST(CalibrateThresholds, StepsToTheSameThresholdsAsPrinted) {
  for (const std::size_t steps : {1U, 2U, 3U, 4U}) {
    const auto closed = calibrate_thresholds(kWalk, steps);
    const auto stepped = calibrate_thresholds(kWalk, steps, kStepping);
    ASSERT_TRUE(closed && stepped);
    EXPECT_TRUE(stepped->calibration_ok);
    EXPECT_NEAR(stepped->peak_threshold_mps2, closed->peak_threshold_mps2, 0.001);
    EXPECT_NEAR(stepped->trough_threshold_mps2, closed->trough_threshold_mps2, 0.001);
  }
}

RC_GTEST_PROP(CalibrateThresholds, StepsToTheSameOnAnyWalk, ()) {
  core::Rng rng(*rc::gen::inRange<std::uint64_t>(0, 100'000));
  std::vector<double> walk{0.0};
  const auto steps = *rc::gen::inRange<std::size_t>(2, 20);
  for (std::size_t i = 0; i < steps; ++i) {
    walk.push_back(rng.uniform(2.0, 4.0));
    walk.push_back(rng.uniform(-4.0, -2.0));
    walk.push_back(rng.uniform(0.0, 1.0));  // A ripple after every step.
    walk.push_back(rng.uniform(-1.0, 0.0));
  }
  walk.push_back(0.5);
  walk.push_back(0.4);
  const auto closed = calibrate_thresholds(walk, steps);
  const auto stepped = calibrate_thresholds(walk, steps, kStepping);
  RC_ASSERT(closed && stepped);
  RC_ASSERT(closed->calibration_ok && stepped->calibration_ok);
  RC_ASSERT(std::abs(closed->peak_threshold_mps2 - stepped->peak_threshold_mps2) <= 0.001);
  RC_ASSERT(std::abs(closed->trough_threshold_mps2 - stepped->trough_threshold_mps2) <= 0.001);
}

TEST(CalibrateThresholds, SaysWhenNoThresholdFits) {
  // Two peaks of the same height: 1 of 2 cannot be parted.
  const std::vector<double> equal = {0, 3, -2, 3, -2.5, 0};
  const auto one = calibrate_thresholds(equal, 1);
  ASSERT_TRUE(one);
  EXPECT_FALSE(one->calibration_ok);
  EXPECT_LT(one->peak_threshold_mps2, 3.0);
  // More steps than there are peaks: as many as there are.
  const auto many = calibrate_thresholds(kWalk, 9);
  ASSERT_TRUE(many);
  EXPECT_FALSE(many->calibration_ok);
  EXPECT_LT(many->peak_threshold_mps2, 1.5);
  EXPECT_FALSE(calibrate_thresholds(kWalk, 9, kStepping)->calibration_ok);
}

TEST(CalibrateThresholds, FindsTheCountOfAWalkWithOneJolt) {
  // The jolt lifts the centre above all other peaks, where the printed search does not look.
  const std::vector<double> jolt = {0, 2, -2, 30, -3, 2.5, -2.2, 1.0, -1.0, 0};
  const auto thresholds = calibrate_thresholds(jolt, 3);
  ASSERT_TRUE(thresholds);
  EXPECT_DOUBLE_EQ(thresholds->peak_threshold_mps2, 1.5);
  EXPECT_DOUBLE_EQ(thresholds->trough_threshold_mps2, -1.5);
  EXPECT_TRUE(thresholds->calibration_ok);
  EXPECT_FALSE(calibrate_thresholds(jolt, 3, kStepping)->calibration_ok);
}

TEST(CalibrateThresholds, RefusesWhatIsNoWalk) {
  EXPECT_FALSE(calibrate_thresholds({}, 3));
  EXPECT_FALSE(calibrate_thresholds(std::vector<double>{1.0}, 3));
  EXPECT_FALSE(calibrate_thresholds(std::vector<double>(50, 2.0), 3));
  EXPECT_FALSE(calibrate_thresholds(kWalk, 0));
  std::vector<double> spoilt = kWalk;
  spoilt[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(calibrate_thresholds(spoilt, 3));
  spoilt[4] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(calibrate_thresholds(spoilt, 3));
  EXPECT_FALSE(calibrate_thresholds(kWalk, 3, {.stepping_mps2 = 0.0}));
}

TEST(CalibrateThresholds, ServesTheDetectorOnAWalkItHasNotSeen) {
  core::Rng rng(41);
  const testing::Gait weak{.cadence_hz = 1.6, .swing_mps2 = 2.6, .noise_mps2 = 0.2};
  ExtremumStepDetector::Filter filter({});
  std::vector<double> filtered;
  for (const StepInput& input : testing::walk(weak, 50, rng).inputs) {
    if (const auto value = filter.add(input.time, input.vertical_mps2)) {
      filtered.push_back(value->value);
    }
  }
  const auto thresholds = calibrate_thresholds(filtered, 50);
  ASSERT_TRUE(thresholds);
  ExtremumStepDetector::Options options;
  options.peak_threshold_mps2 = thresholds->peak_threshold_mps2;
  options.trough_threshold_mps2 = thresholds->trough_threshold_mps2;
  ExtremumStepDetector detector(options);
  const auto steps = testing::feed(detector, testing::walk(weak, 300, rng).inputs);
  EXPECT_NEAR(static_cast<double>(steps.size()), 300.0, 9.0);
}

}  // namespace
}  // namespace waylode::pdr
