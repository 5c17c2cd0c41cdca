// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/domain_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace waylode::radio {
namespace {

using core::device_time_from_ms;
using core::TransmitterId;
using testing::ElementsAre;
using testing::IsEmpty;
using Mode = DomainFilter::Mode;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

DomainFilter filter_of(Mode mode) { return DomainFilter({.mode = mode}); }

/// 99 readings of -57 to -53 dBm (20 each, 19 of the last), then one of -85.
std::vector<float> steady_with_one_fade() {
  std::vector<float> readings;
  for (int i = 0; i < 99; ++i) readings.push_back(-57.0F + static_cast<float>(i % 5));
  readings.push_back(-85.0F);
  return readings;
}

TEST(SignalStatistics, AreThoseWorkedOutByHand) {
  const std::vector<float> readings = {-50.0F, -62.0F, -55.0F, -53.0F};
  const auto statistics = signal_statistics(readings);
  ASSERT_TRUE(statistics);
  EXPECT_EQ(statistics->count, 4U);
  EXPECT_FLOAT_EQ(statistics->mean_dbm, -55.0F);
  EXPECT_EQ(statistics->min_dbm, -62.0F);
  EXPECT_EQ(statistics->max_dbm, -50.0F);
  EXPECT_FLOAT_EQ(statistics->median_dbm, -54.0F);
  EXPECT_FLOAT_EQ(statistics->mad_db, 2.5F);                // Of 4, 8, 1, 1.
  EXPECT_FLOAT_EQ(statistics->sigma_db, std::sqrt(26.0F));  // (25 + 49 + 0 + 4) / 3.
}

TEST(SignalStatistics, PassOverWhatIsNotFinite) {
  EXPECT_FALSE(signal_statistics({}));
  EXPECT_FALSE(signal_statistics(std::vector<float>{kNan, -kInfinity}));
  const auto one = signal_statistics(std::vector<float>{kNan, -61.0F, kInfinity});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->count, 1U);
  EXPECT_EQ(one->mean_dbm, -61.0F);
  EXPECT_EQ(one->sigma_db, 0.0F);
  EXPECT_EQ(one->mad_db, 0.0F);
}

TEST(DomainFilter, ByHalfRangePutsTheMeanForAnOutlierOnOneSide) {
  const std::vector<float> readings = steady_with_one_fade();
  // Sum: 20 (-57 - 56 - 55 - 54) - 19 * 53 - 85 = -5532; half of the range 32 is 16.
  const auto outcome = filter_of(Mode::kHalfRange).apply(readings);
  EXPECT_THAT(outcome.replaced, ElementsAre(99U));
  EXPECT_FLOAT_EQ(outcome.rssi_dbm[99], -55.32F);
  EXPECT_NEAR(static_cast<double>(signal_statistics(outcome.rssi_dbm)->mean_dbm),
              (-5447.0 - 55.32) / 100.0, 1e-4);
}

TEST(DomainFilter, ByHalfRangeIsMisledByOutliersOnBothSides) {
  // 97 at -55, two at -85 and one at -25: mean -55.3, half range 30. Only -25 is 30.3 away.
  std::vector<float> readings(97, -55.0F);
  readings.insert(readings.end(), {-85.0F, -85.0F, -25.0F});
  EXPECT_THAT(filter_of(Mode::kHalfRange).apply(readings).replaced, ElementsAre(99U));
  EXPECT_THAT(filter_of(Mode::kMad).apply(readings).replaced, ElementsAre(97U, 98U, 99U));
}

TEST(DomainFilter, ByMadPutsTheMedianForOutliers) {
  const auto outcome = filter_of(Mode::kMad).apply(steady_with_one_fade());
  EXPECT_THAT(outcome.replaced, ElementsAre(99U));
  EXPECT_EQ(outcome.rssi_dbm[99], -55.0F);
}

TEST(DomainFilter, ByMadKeepsWhatIsWithinThreeSigma) {
  // Median -54, absolute deviations 4 2 1 0 1 2 14: MAD 2, so 8.8956 dB to either side.
  const std::vector<float> readings = {-58.0F, -56.0F, -55.0F, -54.0F, -53.0F, -52.0F, -40.0F};
  EXPECT_THAT(filter_of(Mode::kMad).apply(readings).replaced, ElementsAre(6U));
  std::vector<float> nearer = readings;
  nearer[6] = -45.2F;
  EXPECT_THAT(filter_of(Mode::kMad).apply(nearer).replaced, IsEmpty());
  nearer[6] = -45.0F;
  EXPECT_THAT(filter_of(Mode::kMad).apply(nearer).replaced, ElementsAre(6U));
}

TEST(DomainFilter, ByMadToleratesTheStepOfWholeDecibels) {
  std::vector<float> readings(20, -60.0F);
  readings.push_back(-62.0F);  // Within 3 * 1.4826 * 0.5 = 2.2 dB.
  readings.push_back(-63.0F);
  EXPECT_THAT(filter_of(Mode::kMad).apply(readings).replaced, ElementsAre(21U));
}

TEST(DomainFilter, TakenLiterallyTakesNothingAway) {
  EXPECT_THAT(filter_of(Mode::kLiteral).apply(steady_with_one_fade()).replaced, IsEmpty());
}

RC_GTEST_PROP(DomainFilter, TakenLiterallyTakesNothingAwayFromWhatPhonesTell, ()) {
  // While the weakest is at most 3 times the strongest, |max + min| / 2 is no less than the range.
  const auto raw =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-99, -32)));
  const std::vector<float> readings(raw.begin(), raw.end());
  RC_ASSERT(filter_of(Mode::kLiteral).apply(readings).replaced.empty());
}

TEST(DomainFilter, SwitchedOffReturnsWhatItWasGiven) {
  const std::vector<float> readings = steady_with_one_fade();
  const auto outcome = filter_of(Mode::kOff).apply(readings);
  EXPECT_EQ(outcome.rssi_dbm, readings);
  EXPECT_THAT(outcome.replaced, IsEmpty());
}

TEST(DomainFilter, LeavesOneReadingAndEqualReadingsAlone) {
  for (const Mode mode : {Mode::kOff, Mode::kHalfRange, Mode::kMad, Mode::kLiteral}) {
    EXPECT_THAT(filter_of(mode).apply({}).rssi_dbm, IsEmpty());
    EXPECT_THAT(filter_of(mode).apply(std::vector<float>{-71.0F}).rssi_dbm, ElementsAre(-71.0F));
    const std::vector<float> equal(7, -71.3F);
    EXPECT_THAT(filter_of(mode).apply(equal).replaced, IsEmpty());
    EXPECT_THAT(filter_of(mode).apply(std::vector<float>{kNan, -71.0F, kInfinity}).rssi_dbm,
                ElementsAre(-71.0F));
  }
}

RC_GTEST_PROP(DomainFilter, NeverWidensTheRange, ()) {
  const auto raw =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-100, -20)));
  const Mode mode = *rc::gen::element(Mode::kHalfRange, Mode::kMad, Mode::kLiteral);
  const std::vector<float> readings(raw.begin(), raw.end());
  const auto outcome = filter_of(mode).apply(readings);
  RC_ASSERT(outcome.rssi_dbm.size() == readings.size());
  RC_ASSERT(std::ranges::min(outcome.rssi_dbm) >= std::ranges::min(readings));
  RC_ASSERT(std::ranges::max(outcome.rssi_dbm) <= std::ranges::max(readings));
}

TEST(DomainFilter, RefusesOptionsOutOfRange) {
  using Options = DomainFilter::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const float factor : {0.0F, -1.0F, kNan}) {
    EXPECT_FALSE(Options{.mad_factor = factor}.validate());
  }
  for (const float mad_db : {-0.1F, kNan}) EXPECT_FALSE(Options{.min_mad_db = mad_db}.validate());
}

sample::WifiReading reading(std::uint64_t address, float rssi_dbm) {
  sample::WifiReading result;
  result.transmitter = TransmitterId::wifi(address);
  result.rssi_dbm = rssi_dbm;
  return result;
}

TEST(RemoveDuplicates, KnowsThemByTimeAndTransmitterNotByStrength) {
  std::vector<sample::WifiScan> scans = {
      {device_time_from_ms(1'000), {reading(1, -50.0F), reading(2, -50.0F), reading(1, -51.0F)}},
      {device_time_from_ms(2'000), {reading(1, -50.0F)}},                      // Same strength.
      {device_time_from_ms(1'000), {reading(2, -50.0F), reading(3, -70.0F)}},  // Told again.
      {device_time_from_ms(2'000), {reading(1, -50.0F)}},
      {device_time_from_ms(3'000), {}}};
  EXPECT_EQ(remove_duplicates(scans), 3U);
  ASSERT_EQ(scans.size(), 4U);
  EXPECT_THAT(scans[0].readings, ElementsAre(reading(1, -50.0F), reading(2, -50.0F)));
  EXPECT_THAT(scans[1].readings, ElementsAre(reading(1, -50.0F)));
  EXPECT_THAT(scans[2].readings, ElementsAre(reading(3, -70.0F)));
  EXPECT_THAT(scans[3].readings, IsEmpty());  // It was empty when it came.
  EXPECT_EQ(remove_duplicates(scans), 0U);
}

}  // namespace
}  // namespace waylode::radio
