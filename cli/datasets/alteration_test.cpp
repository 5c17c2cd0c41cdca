// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/alteration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace waylode::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

core::DeviceTime at_s(double time_s) { return core::device_time_from_seconds(time_s); }

sample::WifiScan scan_at(double time_s, std::initializer_list<double> heard_s) {
  sample::WifiScan scan;
  scan.time = at_s(time_s);
  for (const double last_seen_s : heard_s) {
    sample::WifiReading reading;
    reading.rssi_dbm = -60.0F;
    reading.last_seen = at_s(last_seen_s);
    scan.readings.push_back(reading);
  }
  return scan;
}

sample::BleReading beacon_at(double time_s) {
  sample::BleReading reading;
  reading.time = at_s(time_s);
  reading.rssi_dbm = -70.5F;
  return reading;
}

template <typename Kind>
std::vector<double> times_s(const std::vector<sample::Sample>& samples) {
  std::vector<double> times;
  for (const sample::Sample& sample : samples) {
    if (const auto* kind = std::get_if<Kind>(&sample)) {
      times.push_back(core::to_seconds(kind->time.time_since_epoch()));
    }
  }
  return times;
}

TEST(ThinScans, KeepsTheFirstAndThoseAPeriodApart) {
  std::vector<sample::Sample> samples;
  for (const double time_s : {1.0, 3.0, 5.5, 6.0, 9.0, 11.5}) {
    samples.emplace_back(scan_at(time_s, {time_s}));
  }
  samples.emplace_back(sample::BarometerSample{at_s(12.0), 1013.0});
  thin_scans(samples, 5.0, true);
  EXPECT_THAT(times_s<sample::WifiScan>(samples), ElementsAre(1.0, 6.0, 11.5));
  EXPECT_THAT(times_s<sample::BarometerSample>(samples), ElementsAre(12.0));
}

TEST(ThinScans, ScanWithoutReadingsDoesNotUseUpThePeriod) {
  std::vector<sample::Sample> samples = {scan_at(1.0, {}), scan_at(3.0, {2.5}), scan_at(9.0, {}),
                                         scan_at(13.0, {13.0})};
  thin_scans(samples, 10.0, true);
  EXPECT_THAT(times_s<sample::WifiScan>(samples), ElementsAre(3.0, 13.0));
}

TEST(ThinScans, ReadingsOfScansThatDidNotHappenGo) {
  std::vector<sample::Sample> samples = {scan_at(40.0, {39.0, 34.0, 33.9, 12.0})};
  thin_scans(samples, 30.0, true);
  const auto& scan = std::get<sample::WifiScan>(samples.at(0));
  ASSERT_EQ(scan.readings.size(), 2U);
  EXPECT_EQ(scan.readings[1].last_seen, at_s(34.0));
}

TEST(ThinScans, BluetoothIsHeardInWindowsOrLeftAlone) {
  std::vector<sample::Sample> samples;
  for (const double time_s : {0.5, 1.0, 2.4, 2.5, 7.0, 10.5, 12.0, 13.0, 20.0}) {
    samples.emplace_back(beacon_at(time_s));
  }
  std::vector<sample::Sample> untouched = samples;
  thin_scans(samples, 10.0, true);
  EXPECT_THAT(times_s<sample::BleReading>(samples), ElementsAre(0.5, 1.0, 2.4, 10.5, 12.0));
  thin_scans(untouched, 10.0, false);
  EXPECT_EQ(untouched.size(), 9U);
}

TEST(ThinScans, NoPeriodKeepsEverything) {
  const std::vector<sample::Sample> recorded = {scan_at(1.0, {}), scan_at(1.0, {0.9, -30.0}),
                                                scan_at(1.5, {1.5}), beacon_at(2.0)};
  for (const double period_s : {0.0, -3.0, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()}) {
    std::vector<sample::Sample> samples = recorded;
    thin_scans(samples, period_s, true);
    EXPECT_EQ(samples, recorded);
  }
  std::vector<sample::Sample> none;
  thin_scans(none, 5.0, true);
  EXPECT_THAT(none, IsEmpty());
}

TEST(ShiftRssi, ShiftsWifiAndBluetooth) {
  std::vector<sample::Sample> samples = {scan_at(1.0, {0.9, 0.8}), beacon_at(2.0)};
  alter(samples, {.device_offset_db = -8.0});
  const auto& scan = std::get<sample::WifiScan>(samples[0]);
  EXPECT_EQ(scan.readings[0].rssi_dbm, -68.0F);
  EXPECT_EQ(scan.readings[1].rssi_dbm, -68.0F);
  EXPECT_EQ(std::get<sample::BleReading>(samples[1]).rssi_dbm, -78.5F);
}

}  // namespace
}  // namespace waylode::cli
