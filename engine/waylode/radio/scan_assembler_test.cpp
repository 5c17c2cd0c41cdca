// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/scan_assembler.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace waylode::radio {
namespace {

using core::device_time_from_ms;
using core::TransmitterId;

constexpr ScanAssembler::Options kOptions{
    .max_age_s = 6.0, .fresh_age_s = 3.0, .ble_window_s = 4.0};

sample::WifiReading heard(std::uint64_t number, float rssi_dbm, std::int64_t last_seen_ms) {
  sample::WifiReading reading;
  reading.transmitter = TransmitterId::wifi(number);
  reading.rssi_dbm = rssi_dbm;
  reading.last_seen = device_time_from_ms(last_seen_ms);
  return reading;
}

sample::BleReading advertised(std::uint64_t number, float rssi_dbm, std::int64_t time_ms) {
  sample::BleReading reading;
  reading.time = device_time_from_ms(time_ms);
  reading.transmitter = TransmitterId::bluetooth(number);
  reading.rssi_dbm = rssi_dbm;
  return reading;
}

sample::WifiScan scan_at(std::int64_t time_ms, std::vector<sample::WifiReading> readings) {
  return {device_time_from_ms(time_ms), std::move(readings)};
}

TEST(ScanAssembler, LeavesOutWhatThePhoneRepeatsFromItsCache) {
  const ScanAssembler assembler(kOptions);
  const Query query = assembler.assemble(scan_at(
      20'000, {heard(3, -60.0F, 13'999), heard(2, -61.0F, 14'000), heard(1, -62.0F, 19'500)}));
  ASSERT_EQ(query.readings.size(), 2U);
  EXPECT_EQ(query.readings[0].transmitter, TransmitterId::wifi(1));
  EXPECT_EQ(query.readings[0].rssi_dbm, -62.0F);
  EXPECT_FLOAT_EQ(query.readings[0].age_s, 0.5F);
  EXPECT_EQ(query.readings[1].transmitter, TransmitterId::wifi(2));
  EXPECT_FLOAT_EQ(query.readings[1].age_s, 6.0F);
  EXPECT_EQ(query.delivered, device_time_from_ms(20'000));
}

TEST(ScanAssembler, KeepsTheNewestReadingOfATransmitter) {
  const ScanAssembler assembler(kOptions);
  const Query query = assembler.assemble(scan_at(
      20'000, {heard(1, -60.0F, 18'000), heard(1, -70.0F, 19'000), heard(1, -80.0F, 17'000)}));
  ASSERT_EQ(query.readings.size(), 1U);
  EXPECT_EQ(query.readings[0].rssi_dbm, -70.0F);
  EXPECT_FLOAT_EQ(query.readings[0].age_s, 1.0F);
}

TEST(ScanAssembler, DatesTheScanByTheMedianOfItsFreshReadings) {
  const ScanAssembler assembler(kOptions);
  const Query query = assembler.assemble(
      scan_at(20'000, {heard(1, -60.0F, 19'900), heard(2, -60.0F, 17'100), heard(3, -60.0F, 18'300),
                       heard(4, -60.0F, 15'000), heard(5, -60.0F, 14'500)}));
  EXPECT_EQ(query.measured, device_time_from_ms(18'300));
}

TEST(ScanAssembler, DatesAScanWithoutFreshReadingsByAllOfThem) {
  const ScanAssembler assembler(kOptions);
  const Query query = assembler.assemble(scan_at(
      20'000, {heard(1, -60.0F, 16'000), heard(2, -60.0F, 14'100), heard(3, -60.0F, 15'700)}));
  EXPECT_EQ(query.measured, device_time_from_ms(15'700));
}

TEST(ScanAssembler, JoinsTheAdvertisementsOfTheWindow) {
  ScanAssembler assembler(kOptions);
  assembler.add(advertised(1, -70.0F, 15'999));
  assembler.add(advertised(2, -71.0F, 16'000));
  assembler.add(advertised(3, -72.0F, 18'000));
  assembler.add(advertised(3, -73.0F, 19'000));
  assembler.add(advertised(4, -74.0F, 20'000));
  const Query query = assembler.assemble(scan_at(20'000, {heard(9, -50.0F, 19'000)}));
  ASSERT_EQ(query.readings.size(), 4U);
  EXPECT_EQ(query.readings[0].transmitter, TransmitterId::wifi(9));
  EXPECT_EQ(query.readings[1].transmitter, TransmitterId::bluetooth(2));
  EXPECT_FLOAT_EQ(query.readings[1].age_s, 4.0F);
  EXPECT_EQ(query.readings[2].transmitter, TransmitterId::bluetooth(3));
  EXPECT_EQ(query.readings[2].rssi_dbm, -73.0F);
  EXPECT_EQ(query.readings[3].transmitter, TransmitterId::bluetooth(4));
  EXPECT_EQ(query.measured, device_time_from_ms(19'000));  // Bluetooth does not date the scan.
}

TEST(ScanAssembler, DoesNotLookIntoTheFuture) {
  ScanAssembler assembler(kOptions);
  assembler.add(advertised(1, -70.0F, 20'001));
  EXPECT_TRUE(assembler.assemble(scan_at(20'000, {})).readings.empty());
}

TEST(ScanAssembler, LeavesBluetoothOutWithoutAWindow) {
  ScanAssembler::Options options = kOptions;
  options.ble_window_s = 0.0;
  ASSERT_TRUE(options.validate());
  ScanAssembler assembler(options);
  assembler.add(advertised(1, -70.0F, 20'000));
  EXPECT_TRUE(assembler.assemble(scan_at(20'000, {})).readings.empty());
}

TEST(ScanAssembler, AssemblesBluetoothAlone) {
  ScanAssembler assembler(kOptions);
  assembler.add(advertised(1, -70.0F, 17'000));
  assembler.add(advertised(2, -71.0F, 18'500));
  assembler.add(advertised(3, -72.0F, 19'900));
  const Query query = assembler.assemble_bluetooth(device_time_from_ms(20'000));
  ASSERT_EQ(query.readings.size(), 3U);
  EXPECT_EQ(query.readings[1].rssi_dbm, -71.0F);
  EXPECT_EQ(query.delivered, device_time_from_ms(20'000));
  EXPECT_NEAR(core::to_seconds(query.delivered - query.measured), 1.5, 1e-6);  // The median.
  const Query silence = assembler.assemble_bluetooth(device_time_from_ms(60'000));
  EXPECT_TRUE(silence.readings.empty());
  EXPECT_EQ(silence.measured, device_time_from_ms(60'000));
}

TEST(ScanAssembler, MakesAnEmptyQueryOfNothingUsable) {
  const ScanAssembler assembler(kOptions);
  for (const auto& scan : {scan_at(20'000, {}), scan_at(20'000, {heard(1, -60.0F, 1'000)})}) {
    const Query query = assembler.assemble(scan);
    EXPECT_TRUE(query.readings.empty());
    EXPECT_EQ(query.measured, device_time_from_ms(20'000));
    EXPECT_EQ(query.delivered, device_time_from_ms(20'000));
  }
}

TEST(ScanAssembler, LeavesHotspotsOutWhenGivenAClassifier) {
  const HotspotClassifier hotspots;
  sample::WifiReading phone = heard(0x0200'0000'0007ULL, -40.0F, 19'000);  // Local address.
  phone.ssid = "iPhone von Eva";
  const sample::WifiScan scan = scan_at(20'000, {phone, heard(2, -61.0F, 19'500)});
  EXPECT_EQ(ScanAssembler(kOptions).assemble(scan).readings.size(), 2U);
  const Query query = ScanAssembler(kOptions, &hotspots).assemble(scan);
  ASSERT_EQ(query.readings.size(), 1U);
  EXPECT_EQ(query.readings[0].transmitter, TransmitterId::wifi(2));
  EXPECT_EQ(query.measured, device_time_from_ms(19'500));
}

TEST(ScanAssembler, RefusesOptionsOutOfRange) {
  using Options = ScanAssembler::Options;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Options{}.validate());
  for (const double age_s : {0.0, -1.0, 61.0, kNan}) {
    EXPECT_FALSE(Options{.max_age_s = age_s}.validate());
  }
  for (const double age_s : {0.0, kNan}) EXPECT_FALSE(Options{.fresh_age_s = age_s}.validate());
  for (const double window_s : {-0.1, 61.0, kNan}) {
    EXPECT_FALSE(Options{.ble_window_s = window_s}.validate());
  }
}

}  // namespace
}  // namespace waylode::radio
