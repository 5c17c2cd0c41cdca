// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/step_counting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "waylode/pdr/cadence_step_detector.hpp"

namespace waylode::experiment {
namespace {

using core::device_time_from_seconds;

/// Tells a step at every n-th sample, said to lie a quarter of a second back.
class EveryNth : public pdr::StepSource {
 public:
  explicit EveryNth(int n) : n_(n) {}
  std::optional<pdr::Step> add(const pdr::StepInput& input) override {
    if (++count_ % n_ != 0) return std::nullopt;
    pdr::Step step;
    step.time = input.time - core::from_seconds(0.25);
    return step;
  }

 private:
  int n_;
  int count_ = 0;
};

StepRecording still(const std::string& placement, int samples, int steps) {
  StepRecording recording{placement + std::to_string(steps), placement, "phone", {}, {}};
  for (int i = 0; i < samples; ++i) {
    recording.samples.push_back({device_time_from_seconds(0.02 * i), {0.0, 0.0, 9.80665}});
  }
  for (int i = 0; i < steps; ++i) recording.steps.push_back(device_time_from_seconds(0.1 * i));
  return recording;
}

StepSourceFactory every(int n) {
  return [n] { return std::make_unique<EveryNth>(n); };
}

TEST(StepCounting, TellsErrorsByRecordingByPlacementAndOverAll) {
  // 20 told of 16, of 25 and of 20: +25 %, -20 %, 0 %.
  const StepCounting result = count_steps(
      {still("purse", 200, 16), still("hand", 200, 25), still("purse", 200, 20)}, every(10));
  ASSERT_EQ(result.recordings.size(), 3U);
  EXPECT_EQ(result.recordings[1].name, "hand25");
  EXPECT_EQ(result.recordings[1].counted, 20U);
  EXPECT_EQ(result.recordings[1].walked, 25U);
  EXPECT_DOUBLE_EQ(result.recordings[0].error_ratio, 0.25);
  EXPECT_DOUBLE_EQ(result.recordings[1].error_ratio, -0.20);
  EXPECT_NEAR(result.recordings[0].longest_delay_s, 0.25, 1e-9);
  ASSERT_EQ(result.placements.size(), 2U);
  EXPECT_EQ(result.placements[0].placement, "hand");
  EXPECT_DOUBLE_EQ(result.placements[0].mean_abs_error_ratio, 0.20);
  EXPECT_EQ(result.placements[1].recordings, 2U);
  EXPECT_DOUBLE_EQ(result.placements[1].mean_abs_error_ratio, 0.125);
  EXPECT_DOUBLE_EQ(result.mean_abs_error_ratio, 0.15);
  EXPECT_NEAR(result.mean_error_ratio, 0.05 / 3.0, 1e-12);
}

TEST(StepCounting, LeavesOutRecordingsWithoutATrueStep) {
  const StepCounting result =
      count_steps({still("hand", 100, 0), still("hand", 100, 8)}, every(10));
  ASSERT_EQ(result.recordings.size(), 1U);
  EXPECT_DOUBLE_EQ(result.mean_abs_error_ratio, 0.25);
}

TEST(StepCounting, MakesNoFigureOfNothing) {
  const StepCounting result = count_steps({}, every(10));
  EXPECT_TRUE(result.recordings.empty());
  EXPECT_TRUE(result.placements.empty());
  EXPECT_EQ(result.mean_abs_error_ratio, 0.0);
}

TEST(StepCounting, FeedsADetectorWhatItNeeds) {
  constexpr double kCadence_hz = 1.85;
  constexpr int kSteps = 74;
  StepRecording recording{"walk", "hand", "phone", {}, {}};
  for (int i = 0; i <= 2'000; ++i) {
    const double time_s = 0.02 * i;
    const double bounce_mps2 = 2.5 * std::sin(2.0 * std::numbers::pi * kCadence_hz * time_s);
    recording.samples.push_back({device_time_from_seconds(time_s),
                                 {0.6 * (9.81 + bounce_mps2), 0.0, 0.8 * (9.81 + bounce_mps2)}});
  }
  for (int i = 0; i < kSteps; ++i) {
    recording.steps.push_back(device_time_from_seconds((i + 0.25) / kCadence_hz));
  }
  const StepCounting result = count_steps({recording}, [] {
    return std::make_unique<pdr::CadenceStepDetector>(pdr::CadenceStepDetector::Options{});
  });
  ASSERT_EQ(result.recordings.size(), 1U);
  EXPECT_NEAR(static_cast<double>(result.recordings[0].counted), kSteps, 1.0);
}

}  // namespace
}  // namespace waylode::experiment
