// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/time.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace waylode::core {
namespace {

TEST(Time, CountsNanoseconds) {
  EXPECT_EQ(device_time_from_ms(1500).time_since_epoch().count(), 1'500'000'000);
  EXPECT_EQ(device_time_from_ms(-3) - device_time_from_ms(4), std::chrono::milliseconds(-7));
  EXPECT_EQ(to_seconds(std::chrono::milliseconds(-2750)), -2.75);
}

TEST(Time, RoundsSecondsToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.1).count(), 100'000'000);
  EXPECT_EQ(from_seconds(1.6e-9).count(), 2);
  EXPECT_EQ(from_seconds(-1.6e-9).count(), -2);
  EXPECT_EQ(from_seconds(-0.3e-9).count(), 0);
  EXPECT_EQ(device_time_from_seconds(2.5), device_time_from_ms(2500));
}

RC_GTEST_PROP(Time, SurvivesSecondsInDoubleForAMonth, ()) {
  constexpr std::int64_t kMonth_ms = 31LL * 24 * 3600 * 1000;
  const Duration duration = std::chrono::milliseconds(*rc::gen::inRange(-kMonth_ms, kMonth_ms));
  RC_ASSERT(from_seconds(to_seconds(duration)) - duration < Duration(500));
  RC_ASSERT(duration - from_seconds(to_seconds(duration)) < Duration(500));
}

}  // namespace
}  // namespace waylode::core
