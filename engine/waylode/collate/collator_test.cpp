// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/collate/collator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace waylode::collate {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// `mark` tells samples of equal time apart.
sample::Sample at_ms(int time_ms, double mark = 0.0) {
  return sample::BarometerSample{core::device_time_from_ms(time_ms), mark};
}

std::vector<double> marks(const std::vector<sample::Sample>& samples) {
  std::vector<double> found;
  for (const auto& sample : samples) {
    found.push_back(std::get<sample::BarometerSample>(sample).pressure_hpa);
  }
  return found;
}

Collator make_collator(int max_lateness_ms = 100) {
  Collator::Options options;
  options.max_lateness = milliseconds(max_lateness_ms);
  return Collator::create(options).value();
}

TEST(Collator, OrdersWhatArrivesWithinTheLateness) {
  Collator collator = make_collator();
  collator.push(at_ms(50, 2));
  collator.push(at_ms(20, 1));
  EXPECT_THAT(collator.take_ready(), IsEmpty());
  collator.push(at_ms(130, 3));
  EXPECT_THAT(marks(collator.take_ready()), ElementsAre(1));
  EXPECT_THAT(marks(collator.flush()), ElementsAre(2, 3));
  EXPECT_EQ(collator.dropped_count(), 0U);
}

TEST(Collator, KeepsTheOrderOfArrivalAtEqualTimes) {
  Collator collator = make_collator();
  for (int mark = 0; mark < 9; ++mark) collator.push(at_ms(7, mark));
  EXPECT_THAT(marks(collator.flush()), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(Collator, DropsAndCountsWhatComesAfterItsSuccessorsLeft) {
  Collator collator = make_collator();
  collator.push(at_ms(100, 1));
  collator.push(at_ms(200, 2));
  EXPECT_THAT(marks(collator.take_ready()), ElementsAre(1));
  collator.push(at_ms(99, 3));
  collator.push(at_ms(100, 4));
  EXPECT_EQ(collator.dropped_count(), 1U);
  EXPECT_THAT(marks(collator.flush()), ElementsAre(4, 2));
}

TEST(Collator, DropsWhatIsOlderThanAFlush) {
  Collator collator = make_collator();
  collator.push(at_ms(500, 1));
  EXPECT_THAT(marks(collator.flush()), ElementsAre(1));
  collator.push(at_ms(499, 2));
  EXPECT_THAT(collator.flush(), IsEmpty());
  EXPECT_EQ(collator.dropped_count(), 1U);
}

TEST(Collator, LetsTheOldestGoWhenItHoldsTooMany) {
  Collator::Options options;
  options.max_held = 2;
  Collator collator = Collator::create(options).value();
  for (int i = 0; i < 5; ++i) collator.push(at_ms(5 - i, i));
  EXPECT_THAT(marks(collator.take_ready()), ElementsAre(4, 3, 2));
  EXPECT_EQ(collator.held_count(), 2U);
}

TEST(Collator, RefusesOptionsOutOfRange) {
  Collator::Options options;
  options.max_lateness = milliseconds(-1);
  EXPECT_EQ(Collator::create(options).error().code, core::ErrorCode::kInvalidOptions);
  options.max_lateness = std::chrono::seconds(61);
  EXPECT_FALSE(Collator::create(options));
  options = {};
  options.max_held = 0;
  EXPECT_FALSE(Collator::create(options));
}

TEST(Collator, LosesNothingAndEqualsAStableSortWhenLatenessIsKept) {
  const bool holds = rc::check("jitter below the lateness", [] {
    const auto jitters_ms = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 100));
    Collator collator = make_collator(100);
    std::vector<std::pair<int, double>> expected;
    std::vector<double> out;
    for (std::size_t i = 0; i < jitters_ms.size(); ++i) {
      const int time_ms = static_cast<int>(i) * 15 - jitters_ms[i];
      expected.emplace_back(time_ms, static_cast<double>(i));
      collator.push(at_ms(time_ms, static_cast<double>(i)));
      for (const double mark : marks(collator.take_ready())) out.push_back(mark);
    }
    for (const double mark : marks(collator.flush())) out.push_back(mark);
    std::stable_sort(expected.begin(), expected.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<double> expected_marks;
    for (const auto& [time_ms, mark] : expected) expected_marks.push_back(mark);
    RC_ASSERT(out == expected_marks);
    RC_ASSERT(collator.dropped_count() == 0U);
  });
  EXPECT_TRUE(holds);
}

}  // namespace
}  // namespace waylode::collate
