// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/getsensordata_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace waylode::log {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

struct Decoded {
  std::vector<sample::Sample> samples;
  LogReport report;
};

Decoded decode(std::string_view text, std::size_t chunk_bytes = std::string_view::npos) {
  Decoded decoded;
  const auto decoder = make_getsensordata_decoder(
      [&decoded](sample::Sample&& sample) { decoded.samples.push_back(std::move(sample)); });
  while (!text.empty()) {
    decoder->feed(text.substr(0, chunk_bytes));
    text.remove_prefix(std::min(chunk_bytes, text.size()));
  }
  decoder->finish();
  decoded.report = decoder->report();
  return decoded;
}

template <typename T>
const T& only(const Decoded& decoded) {
  EXPECT_THAT(decoded.samples, SizeIs(1));
  return std::get<T>(decoded.samples.at(0));
}

core::DeviceTime at_s(double time_s) { return core::device_time_from_seconds(time_s); }

TEST(GetSensorDataDecoder, ReadsMotionAndMagneticRecords) {
  const auto decoded = decode(
      "ACCE;0.0478;5258.0380;-0.75;7.5;5.25;3\n"
      "GYRO;0.0478;5258.0380;-0.25;-0.5;0.125;3\n"
      "MAGN;0.0478;5258.0380;0.5;-21.25;6.5;2\n");
  ASSERT_THAT(decoded.samples, SizeIs(3));
  const auto& force = std::get<sample::AccelerometerSample>(decoded.samples[0]);
  EXPECT_EQ(force.time, at_s(0.0478));
  EXPECT_EQ(force.specific_force_mps2, core::Vector3(-0.75, 7.5, 5.25));
  EXPECT_EQ(std::get<sample::GyroscopeSample>(decoded.samples[1]).angular_rate_radps,
            core::Vector3(-0.25, -0.5, 0.125));
  const auto& field = std::get<sample::MagnetometerSample>(decoded.samples[2]);
  EXPECT_EQ(field.field_ut, core::Vector3(0.5, -21.25, 6.5));
  EXPECT_EQ(field.accuracy, 2);
}

TEST(GetSensorDataDecoder, DatesSensorsByCaptureOnTheClockOfArrivals) {
  const auto decoded = decode(
      "ACCE;1.000;5000.000;0;0;9.8;3\n"
      "ACCE;1.050;5000.020;0;0;9.8;3\n"
      "ACCE;1.051;5000.040;0;0;9.8;3\n");
  ASSERT_THAT(decoded.samples, SizeIs(3));
  EXPECT_EQ(sample::time_of(decoded.samples[1]), at_s(1.020));
  EXPECT_EQ(sample::time_of(decoded.samples[2]), at_s(1.040));
}

TEST(GetSensorDataDecoder, DatesByArrivalWithoutSensorTimestamp) {
  const auto decoded = decode("PRES;1.5;0;976.25;3\nPRES;1.75;0;976.5;3\n");
  ASSERT_THAT(decoded.samples, SizeIs(2));
  EXPECT_EQ(sample::time_of(decoded.samples[1]), at_s(1.75));
  EXPECT_EQ(std::get<sample::BarometerSample>(decoded.samples[1]).pressure_hpa, 976.5);
}

TEST(GetSensorDataDecoder, ReadsTheAttitudeOfAhrs) {
  // Held level, turned by 120 degrees clockwise seen from above: vector part -sin(60 deg) on z,
  // the top edge (y) points to east sin 120, north cos 120.
  const auto decoded = decode("AHRS;0.1;50.0;0;0;-120;0;0;-0.8660254037844386;3\n");
  const auto& rotation = only<sample::RotationSample>(decoded).enu_from_device;
  const core::Vector3 east_north_up = rotation * core::Vector3::UnitY();
  EXPECT_NEAR(east_north_up.x(), std::sqrt(0.75), 1e-9);
  EXPECT_NEAR(east_north_up.y(), -0.5, 1e-9);
  EXPECT_NEAR(east_north_up.z(), 0.0, 1e-9);
}

TEST(GetSensorDataDecoder, GathersTheWifiRowsOfOneArrival) {
  const auto decoded = decode(
      "ACCE;2.000;5000.000;0;0;9.8;3\n"
      "WIFI;4.000;5001.500;Hall;20:23:00:00:00:01;2437;-56\n"
      "WIFI;4.000;5001.750;a;b;20:23:00:00:00:15;5180;-68;\n"
      "WIFI;6.000;0;;20:23:00:00:00:15;2452;-70\n");
  ASSERT_THAT(decoded.samples, SizeIs(3));
  const auto& scan = std::get<sample::WifiScan>(decoded.samples[1]);
  EXPECT_EQ(scan.time, at_s(4.0));
  EXPECT_THAT(scan.readings,
              ElementsAre(sample::WifiReading{core::TransmitterId::wifi(0x202300000001), -56.0F,
                                              2437, at_s(3.5), "Hall"},
                          sample::WifiReading{core::TransmitterId::wifi(0x202300000015), -68.0F,
                                              5180, at_s(3.75), "a;b"}));
  const auto& undated = std::get<sample::WifiScan>(decoded.samples[2]);
  EXPECT_EQ(undated.readings.at(0).last_seen, at_s(6.0));
}

TEST(GetSensorDataDecoder, DatesAReadingByArrivalWhenItsCaptureIsOnAnotherClock) {
  const auto decoded = decode(
      "ACCE;2.000;5000.000;0;0;9.8;3\n"
      "WIFI;4.000;7001.500;x;20:23:00:00:00:01;2437;-56\n"
      "WIFI;4.000;1001.500;x;20:23:00:00:00:02;2437;-56\n"
      "WIFI;4.000;5002.100;x;20:23:00:00:00:03;2437;-56\n");
  const auto& scan = std::get<sample::WifiScan>(decoded.samples.back());
  ASSERT_THAT(scan.readings, SizeIs(3));
  for (const auto& reading : scan.readings) EXPECT_EQ(reading.last_seen, at_s(4.0));
}

TEST(GetSensorDataDecoder, ReadsWifiRowsWithoutFrequency) {
  const auto decoded = decode("WIFI;4.0;0;net;20:23:00:00:00:01;-56;\n");
  const auto& reading = only<sample::WifiScan>(decoded).readings.at(0);
  EXPECT_EQ(reading.frequency_mhz, 0);
  EXPECT_EQ(reading.rssi_dbm, -56.0F);
  EXPECT_EQ(reading.ssid, "net");
}

TEST(GetSensorDataDecoder, ReadsBeacons) {
  const auto decoded = decode(
      "BLE4;19.5;iBeacon;BE:AC:20:23:00:01;-99;-59;1;7;11111111-1111-BEAC-2023-111111111111\n"
      "BLE4;20.5;iBeacon;BE:AC:20:23:00:02;-87;0;0;0;\n"
      "BLE4;21.5;Eddystone;BE:AC:20:23:00:03;-80;0x00a1b2;3.0;21;5;6\n");
  ASSERT_THAT(decoded.samples, SizeIs(3));
  EXPECT_EQ(std::get<sample::BleReading>(decoded.samples[0]),
            (sample::BleReading{at_s(19.5), core::TransmitterId::bluetooth(0xBEAC20230001), -99.0F,
                                -59.0F, "11111111-1111-beac-2023-111111111111/1/7"}));
  EXPECT_EQ(std::get<sample::BleReading>(decoded.samples[1]),
            (sample::BleReading{at_s(20.5), core::TransmitterId::bluetooth(0xBEAC20230002), -87.0F,
                                std::nullopt, ""}));
  EXPECT_EQ(std::get<sample::BleReading>(decoded.samples[2]).beacon, "0x00a1b2");
}

TEST(GetSensorDataDecoder, ReadsTruthAndGnss) {
  const auto decoded = decode(
      "GNSS;0.5;1686735550.5;49.25;11.125;389.8;7.4;6.5;0.1;15;10\n"
      "POSI;60.75;1;49.5;11.25;-1;100\n");
  ASSERT_THAT(decoded.samples, SizeIs(2));
  const auto& gnss = std::get<sample::GnssSample>(decoded.samples[0]);
  EXPECT_EQ(gnss, (sample::GnssSample{at_s(0.5), {49.25, 11.125}, 6.5}));
  EXPECT_EQ(decoded.report.info.start_utc, core::UtcTime(core::from_seconds(1686735550.0)));
  const auto& truth = std::get<sample::WaypointSample>(decoded.samples[1]);
  EXPECT_EQ(truth.time, at_s(60.75));
  EXPECT_EQ(truth.geo_position, (core::GeoPoint{49.5, 11.25}));
  EXPECT_EQ(truth.position_m, std::nullopt);
  EXPECT_EQ(truth.floor, "-1");
}

TEST(GetSensorDataDecoder, ReadsThePhoneFromTheComments) {
  const auto decoded = decode(
      "% Manufacturer:            \tsamsung\r\n% Model:                   \tSM-G930F \n"
      "% Accelerometer data: \t'ACCE;AppTimestamp(s);SensorTimestamp(s);Acc_X(m/s^2)'\n");
  EXPECT_EQ(decoded.report.info.device_brand, "samsung");
  EXPECT_EQ(decoded.report.info.device_model, "SM-G930F");
  EXPECT_EQ(decoded.report.rejected_total(), 0U);
}

TEST(GetSensorDataDecoder, IgnoresKindsItDoesNotUseByName) {
  const auto decoded = decode("LIGH;0.1;5258.1;769.0;3\nSOUN;0.4;168.63;0.00515;48.21\n");
  EXPECT_THAT(decoded.report.ignored, ElementsAre(Pair("LIGH", 1), Pair("SOUN", 1)));
}

TEST(GetSensorDataDecoder, SplitsRecordsRunTogether) {
  const auto decoded = decode(
      "ACCE;1.0;5000.0;1;2;9;3GYRO;1.0;5000.0;0.5;0.25;0.125;3\n"
      "SOUN;0.4;168.63;0.00515;48.21POSI;60.75;1;49.5;11.25;0;100\n"
      "WIFI;4.0;0;a;20:23:00:00:00:01;2437;-56WIFI;4.0;0;b;20:23:00:00:00:02;2437;-57\n");
  EXPECT_THAT(decoded.report.accepted, ElementsAre(Pair("accelerometer", 1), Pair("gyroscope", 1),
                                                   Pair("waypoint", 1), Pair("wifi_scan", 1)));
  EXPECT_EQ(decoded.report.recovered_run_on, 3U);
  EXPECT_EQ(decoded.report.rejected_total(), 0U);
  EXPECT_THAT(std::get<sample::WifiScan>(decoded.samples.back()).readings, SizeIs(2));
}

struct BadLine {
  const char* reason;
  const char* line;
};

class GetSensorDataDecoderRejects : public ::testing::TestWithParam<BadLine> {};

TEST_P(GetSensorDataDecoderRejects, ABadRecordByReason) {
  const auto decoded = decode(std::string(GetParam().line) + "\n");
  EXPECT_THAT(decoded.samples, IsEmpty());
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair(GetParam().reason, 1)));
}

INSTANTIATE_TEST_SUITE_P(
    Lines, GetSensorDataDecoderRejects,
    ::testing::Values(
        BadLine{"not_a_record", "garbage"}, BadLine{"not_a_record", "ACCE"},
        BadLine{"not_a_record", "ABCD;1;2;3"}, BadLine{"bad_time", "ACCE;-1;5000;1;2;3;3"},
        BadLine{"bad_time", "ACCE;1;nan;1;2;3;3"}, BadLine{"bad_time", "ACCE;1e300;1;1;2;3;3"},
        BadLine{"bad_time", "ACCE;"}, BadLine{"bad_time", "ACCE;1"},
        BadLine{"wrong_field_count", "ACCE;1;5000;1;2;3"},
        BadLine{"wrong_field_count", "GNSS;1;5000;1;2;3"},
        BadLine{"wrong_field_count", "POSI;1;1;49;11;0"},
        BadLine{"wrong_field_count", "WIFI;1;0;-50"},
        BadLine{"not_a_number", "ACCE;1;5000;1;x;3;3"},
        BadLine{"not_a_number", "ACCE;1;5000;1;inf;3;3"},
        BadLine{"not_a_number", "WIFI;1;0;a;20:23:00:00:00:01;2437;x"},
        BadLine{"out_of_range", "ACCE;1;5000;1;2;4000;3"},
        BadLine{"out_of_range", "PRES;1;5000;12;3"},
        BadLine{"out_of_range", "AHRS;1;5000;0;0;0;0.9;0.9;0.9;3"},
        BadLine{"out_of_range", "POSI;1;1;149;11;0;1"},
        BadLine{"out_of_range", "GNSS;1;5;49;11;0;0;-6;0;1;1"},
        BadLine{"bad_address", "WIFI;1;0;a;20:23:00:00:00;2437;-50"},
        BadLine{"bad_beacon_id", "BLE4;1;iBeacon;BE:AC:20:23:00:01;-99;0;1;1;not-hex!"},
        BadLine{"bad_beacon_id", "BLE4;1;AltBeacon;BE:AC:20:23:00:01;-99;0"}));

TEST(GetSensorDataDecoder, SaysThatTheLastLineIsCutShort) {
  for (const char* line : {"ACCE;1.0;5000.0;1;2;", "WIFI;4.0;0;a;20:23:00:00:00:01;2437;-5"}) {
    const auto decoded = decode(line);
    EXPECT_THAT(decoded.samples, IsEmpty()) << line;
    EXPECT_EQ(decoded.report.truncated, "the last line, at byte 0, is cut short");
  }
}

TEST(GetSensorDataDecoder, GivesTheSameHoweverTheBytesAreCut) {
  const std::string text =
      "% Model: \tA\r\nACCE;1.0;5000.0;1;2;9;3GYRO;1.0;5000.0;0.5;0.25;0.125;3\r\n"
      "WIFI;4.0;5002.9;a;20:23:00:00:00:01;2437;-56\nWIFI;4.0;0;b;20:23:00:00:00:02;2437;-5\n"
      "junk\nPOSI;60.75;1;49.5;11.25;0;10";
  const auto whole = decode(text);
  ASSERT_THAT(whole.samples, SizeIs(4));
  for (std::size_t chunk_bytes = 1; chunk_bytes < text.size(); ++chunk_bytes) {
    const auto chunked = decode(text, chunk_bytes);
    EXPECT_EQ(chunked.samples, whole.samples) << chunk_bytes;
    EXPECT_EQ(chunked.report, whole.report) << chunk_bytes;
  }
}

}  // namespace
}  // namespace waylode::log
