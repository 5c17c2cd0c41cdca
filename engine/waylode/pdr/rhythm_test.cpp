// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/rhythm.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace waylode::pdr {
namespace {

using std::numbers::pi;

constexpr double kSpacing_s = 0.04;
constexpr StepIntervalRange kRange{0.3, 0.85};

/// Both feet alike by `step`, one foot against the other by `stride`.
std::vector<double> gait(double cadence_hz, double step, double stride, std::size_t count = 75) {
  std::vector<double> signal;
  for (std::size_t i = 0; i < count; ++i) {
    const double phase_rad = 2.0 * pi * cadence_hz * kSpacing_s * static_cast<double>(i) + 0.4;
    signal.push_back(step * std::sin(phase_rad) + stride * std::sin(0.5 * phase_rad));
  }
  return signal;
}

class RhythmOfGaits : public testing::TestWithParam<double> {};

TEST_P(RhythmOfGaits, IsTheStepWhetherTheFeetAreAlikeOrNot) {
  const double cadence_hz = GetParam();
  for (const double stride : {0.0, 0.5, 1.3}) {
    const auto rhythm = find_rhythm(gait(cadence_hz, 1.0, stride), kSpacing_s, kRange);
    ASSERT_TRUE(rhythm);
    EXPECT_NEAR(rhythm->step_interval_s, 1.0 / cadence_hz, 0.03) << stride;
    EXPECT_GT(rhythm->stride_correlation_ratio, 0.9) << stride;
    // One step on, the sine of the step is itself and that of the stride is its negative.
    const double likeness = (1.0 - stride * stride) / (1.0 + stride * stride);
    EXPECT_NEAR(rhythm->step_correlation_ratio, likeness, 0.15) << stride;
  }
}

INSTANTIATE_TEST_SUITE_P(Cadences, RhythmOfGaits, testing::Values(1.35, 1.6, 1.87, 2.05, 2.2));

TEST(Rhythm, OfARunnerIsNotTheStride) {
  const auto rhythm = find_rhythm(gait(2.9, 1.0, 0.3), kSpacing_s, kRange);
  ASSERT_TRUE(rhythm);
  EXPECT_NEAR(rhythm->step_interval_s, 1.0 / 2.9, 0.02);
}

TEST(Rhythm, NeitherOffsetNorScaleMatter) {
  const std::vector<double> signal = gait(1.8, 1.0, 0.4);
  std::vector<double> other = signal;
  for (double& value : other) value = 7.0 * value - 3.0;
  const auto rhythm = find_rhythm(signal, kSpacing_s, kRange);
  const auto same = find_rhythm(other, kSpacing_s, kRange);
  ASSERT_TRUE(rhythm && same);
  EXPECT_NEAR(rhythm->step_interval_s, same->step_interval_s, 1e-9);
  EXPECT_NEAR(rhythm->stride_correlation_ratio, same->stride_correlation_ratio, 1e-9);
}

TEST(Rhythm, ThereIsNoneInTooLittleOrInAConstant) {
  EXPECT_FALSE(find_rhythm({}, kSpacing_s, kRange));
  // Two of the longest intervals are 42.5 samples, rounded to 43; ten more are needed.
  EXPECT_FALSE(find_rhythm(gait(1.8, 1.0, 0.0, 52), kSpacing_s, kRange));
  EXPECT_TRUE(find_rhythm(gait(1.8, 1.0, 0.0, 53), kSpacing_s, kRange));
  EXPECT_FALSE(find_rhythm(std::vector<double>(75, 0.0), kSpacing_s, kRange));
}

RC_GTEST_PROP(Rhythm, StaysInItsRange, ()) {
  const auto draws = *rc::gen::container<std::vector<int>>(75, rc::gen::inRange(-1000, 1000));
  const std::vector<double> signal(draws.begin(), draws.end());
  const auto rhythm = find_rhythm(signal, kSpacing_s, kRange);
  if (!rhythm) return;
  RC_ASSERT(rhythm->step_interval_s >= kRange.shortest_s - kSpacing_s);
  RC_ASSERT(rhythm->step_interval_s <= kRange.longest_s + kSpacing_s);
  RC_ASSERT(std::abs(rhythm->stride_correlation_ratio) <= 1.0 + 1e-9);
  RC_ASSERT(std::abs(rhythm->step_correlation_ratio) <= 1.0 + 1e-9);
}

}  // namespace
}  // namespace waylode::pdr
