// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/capture_clock.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <chrono>
#include <vector>

namespace waylode::log::detail {
namespace {

using std::chrono::milliseconds;

core::DeviceTime arrival(int time_ms) { return core::DeviceTime(milliseconds(time_ms)); }

TEST(CaptureClock, TakesTheLeastDelayedArrivalForTheOffset) {
  CaptureClock clock;
  EXPECT_EQ(clock.map(arrival(50), milliseconds(9000)), arrival(50));
  // 10 ms less delay than the first: the offset shrinks by as much.
  EXPECT_EQ(clock.map(arrival(60), milliseconds(9020)), arrival(60));
  // 35 ms late: the sensor's own 20 ms count.
  EXPECT_EQ(clock.map(arrival(115), milliseconds(9040)), arrival(80));
  EXPECT_EQ(clock.map(arrival(116), milliseconds(9060)), arrival(100));
  EXPECT_EQ(clock.look_up(milliseconds(9100)), arrival(140));
}

TEST(CaptureClock, KeepsTheSensorsIntervalsThroughAStalledDelivery) {
  CaptureClock clock;
  clock.map(arrival(0), milliseconds(5000));
  for (int i = 1; i <= 100; ++i) {
    EXPECT_EQ(clock.map(arrival(3000 + i / 10), milliseconds(5000 + 20 * i)), arrival(20 * i));
  }
}

TEST(CaptureClock, StartsAfreshWhenTheCaptureClockStepsBack) {
  CaptureClock clock;
  clock.map(arrival(0), milliseconds(900'000));
  EXPECT_EQ(clock.map(arrival(20), milliseconds(7'000)), arrival(20));
  EXPECT_EQ(clock.map(arrival(45), milliseconds(7'020)), arrival(40));
}

TEST(CaptureClock, SurvivesOneCaptureFarAhead) {
  CaptureClock clock;
  clock.map(arrival(0), milliseconds(5'000));
  EXPECT_EQ(clock.map(arrival(20), milliseconds(90'000'000)), arrival(20));
  EXPECT_EQ(clock.map(arrival(40), milliseconds(5'040)), arrival(40));
  EXPECT_EQ(clock.map(arrival(65), milliseconds(5'060)), arrival(60));
}

TEST(CaptureClock, StartsAfreshWhenTheCaptureClockFreezes) {
  CaptureClock clock;
  clock.map(arrival(0), milliseconds(5'000));
  EXPECT_EQ(clock.map(arrival(9'000), milliseconds(5'000)), arrival(0));
  EXPECT_EQ(clock.map(arrival(11'000), milliseconds(5'000)), arrival(11'000));
}

TEST(CaptureClock, KnowsNothingBeforeTheFirstRecord) {
  EXPECT_EQ(CaptureClock().look_up(milliseconds(1)), std::nullopt);
}

TEST(CaptureClock, NeverAnswersAfterTheArrivalNorBackwards) {
  const bool holds = rc::check("whatever the captures are", [] {
    const auto steps_ms = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(0, 5'000), rc::gen::inRange(0, 1'000'000)));
    CaptureClock clock;
    core::DeviceTime last;
    int arrival_ms = 0;
    for (const auto& [step_ms, capture_ms] : steps_ms) {
      arrival_ms += step_ms;
      const core::DeviceTime mapped = clock.map(arrival(arrival_ms), milliseconds(capture_ms));
      RC_ASSERT(mapped <= arrival(arrival_ms));
      RC_ASSERT(mapped >= last);
      last = mapped;
    }
  });
  EXPECT_TRUE(holds);
}

}  // namespace
}  // namespace waylode::log::detail
