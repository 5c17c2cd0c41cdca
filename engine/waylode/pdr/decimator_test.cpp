// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/decimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "waylode/core/rng.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_ms;
using core::device_time_from_seconds;
using std::numbers::pi;

TEST(Decimator, TakesOneInFourOf100HzAsPrinted) {
  Decimator decimator({.anti_alias = false});
  std::vector<double> taken;
  for (int i = 0; i < 40; ++i) {
    const auto value = decimator.add(device_time_from_ms(10 * i), i);
    if (value) taken.push_back(value->value);
  }
  EXPECT_EQ(taken, (std::vector<double>{0, 4, 8, 12, 16, 20, 24, 28, 32, 36}));
}

TEST(Decimator, TakesOneInTwoOf50HzAsPrinted) {
  Decimator decimator({.anti_alias = false});
  std::vector<double> taken;
  for (int i = 0; i < 10; ++i) {
    const auto value = decimator.add(device_time_from_ms(20 * i), i);
    if (value) taken.push_back(value->value);
  }
  EXPECT_EQ(taken, (std::vector<double>{0, 2, 4, 6, 8}));
}

class DecimatorAtAnyRate : public ::testing::TestWithParam<bool> {};

TEST_P(DecimatorAtAnyRate, ComesOutAt25HzDespiteJitter) {
  core::Rng rng(3);
  for (const double rate_hz : {50.0, 73.0, 100.0, 200.0}) {
    Decimator decimator({.anti_alias = GetParam()});
    double count = 0.0;
    for (int i = 0; i < static_cast<int>(20.0 * rate_hz); ++i) {
      const double time_s = (i + 0.3 * rng.uniform()) / rate_hz;
      if (decimator.add(device_time_from_seconds(time_s), 1.0)) ++count;
    }
    EXPECT_NEAR(count, 20.0 * 25.0, 3.0) << rate_hz;
  }
}

TEST_P(DecimatorAtAnyRate, PassesASlowStreamAtItsOwnRate) {
  Decimator decimator({.anti_alias = GetParam()});
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    const auto value = decimator.add(device_time_from_ms(100 * i), 0.1 * i);
    if (!value) continue;
    ++count;
    EXPECT_TRUE(std::isfinite(value->value));
  }
  EXPECT_GE(count, 98);
}

TEST_P(DecimatorAtAnyRate, DoesNotRepeatItselfAfterAHole) {
  Decimator decimator({.anti_alias = GetParam()});
  for (int i = 0; i < 20; ++i) decimator.add(device_time_from_ms(10 * i), 7.0);
  std::vector<core::DeviceTime> times;
  for (int i = 0; i < 20; ++i) {
    const auto value = decimator.add(device_time_from_ms(60'000 + 10 * i), -2.0);
    if (!value) continue;
    times.push_back(value->time);
    if (i > 6) {
      EXPECT_NEAR(value->value, -2.0, 1e-12);
    }
  }
  ASSERT_GE(times.size(), 3U);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_LT(times[i - 1], times[i]);
}

INSTANTIATE_TEST_SUITE_P(BothReadings, DecimatorAtAnyRate, ::testing::Bool());

/// Largest output for a sinusoid in.
double gain_of(const Decimator::Options& options, double frequency_hz) {
  Decimator decimator(options);
  double largest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const auto value = decimator.add(device_time_from_ms(10 * i),
                                     std::sin(2.0 * pi * frequency_hz * 0.01 * i + 0.4));
    if (value && i > 50) largest = std::max(largest, std::abs(value->value));
  }
  return largest;
}

TEST(Decimator, KeepsAWalkAndTakesAwayWhatWouldPassForOne) {
  // 23.4 Hz thinned to 25 Hz looks like 1.6 Hz.
  EXPECT_GT(gain_of({}, 1.6), 0.95);
  EXPECT_LT(gain_of({}, 23.4), 0.05);
  EXPECT_GT(gain_of({.anti_alias = false}, 23.4), 0.95);
}

TEST(Decimator, AveragesWithHannWeights) {
  // Transfer of a Hann window of length T: sinc(f T) / (1 - (f T)^2), at f T = 5 * 0.12 = 0.6.
  const double x = 0.6;
  const double expected = std::sin(pi * x) / (pi * x) / (1.0 - x * x);
  EXPECT_NEAR(gain_of({}, 5.0), expected, 0.02);
}

TEST(Decimator, TellsTheTimeItsValueIsOf) {
  Decimator decimator({});
  for (int i = 0; i < 400; ++i) {
    const auto value = decimator.add(device_time_from_ms(10 * i), 3.0 * 0.01 * i);
    // A ramp comes out as itself.
    if (value && i > 20) {
      EXPECT_NEAR(value->value, 3.0 * core::to_seconds(value->time.time_since_epoch()), 1e-9);
    }
  }
}

TEST(Decimator, RefusesOptionsOutOfRange) {
  using Options = Decimator::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.interval_s = 0.0}.validate());
  EXPECT_FALSE(Options{.interval_s = std::numeric_limits<double>::quiet_NaN()}.validate());
}

}  // namespace
}  // namespace waylode::pdr
