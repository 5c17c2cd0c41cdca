// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/ilc_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
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
  const auto decoder = make_ilc_decoder(
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

core::DeviceTime at_ms(std::int64_t time_ms) { return core::device_time_from_ms(time_ms); }

constexpr std::string_view kAccelerometerLine =
    "1574153941669\tTYPE_ACCELEROMETER\t-0.825\t0.25\t9.5\t2\n";

TEST(IlcDecoder, ReadsAnAccelerometerRecord) {
  const auto decoded = decode(kAccelerometerLine);
  const auto& sample = only<sample::AccelerometerSample>(decoded);
  EXPECT_EQ(sample.time, at_ms(1574153941669));
  EXPECT_EQ(sample.specific_force_mps2, core::Vector3(-0.825, 0.25, 9.5));
  EXPECT_THAT(decoded.report.accepted, ElementsAre(Pair("accelerometer", 1)));
  EXPECT_EQ(decoded.report.bytes_read, kAccelerometerLine.size());
}

TEST(IlcDecoder, ReadsCalibratedAndUncalibratedSensors) {
  const auto decoded = decode(
      "1574153941669\tTYPE_GYROSCOPE\t0.5\t-1.25\t2E-4\t3\n"
      "1574153941670\tTYPE_MAGNETIC_FIELD\t1\t-27.5\t-28\t1\n"
      "1574153941671\tTYPE_MAGNETIC_FIELD_UNCALIBRATED\t1\t2\t3\t4\t5\t6\t3\n"
      "1574153941672\tTYPE_GYROSCOPE_UNCALIBRATED\t0.1\t0.2\t0.3\t0.4\t0.5\t0.6\t3\n"
      "1574153941673\tTYPE_ACCELEROMETER_UNCALIBRATED\t7\t8\t9\t0.0\t1.5\t0.0\t3\n");
  ASSERT_THAT(decoded.samples, SizeIs(5));
  EXPECT_EQ(std::get<sample::GyroscopeSample>(decoded.samples[0]).angular_rate_radps,
            core::Vector3(0.5, -1.25, 0.0002));
  const auto& magnetic = std::get<sample::MagnetometerSample>(decoded.samples[1]);
  EXPECT_EQ(magnetic.field_ut, core::Vector3(1, -27.5, -28));
  EXPECT_EQ(magnetic.accuracy, 1);
  const auto& raw_field = std::get<sample::UncalibratedMagnetometerSample>(decoded.samples[2]);
  EXPECT_EQ(raw_field.field_ut, core::Vector3(1, 2, 3));
  EXPECT_EQ(raw_field.bias_ut, core::Vector3(4, 5, 6));
  const auto& raw_rate = std::get<sample::UncalibratedGyroscopeSample>(decoded.samples[3]);
  EXPECT_EQ(raw_rate.angular_rate_radps, core::Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(raw_rate.bias_radps, core::Vector3(0.4, 0.5, 0.6));
  const auto& raw_force = std::get<sample::UncalibratedAccelerometerSample>(decoded.samples[4]);
  EXPECT_EQ(raw_force.specific_force_mps2, core::Vector3(7, 8, 9));
  EXPECT_EQ(raw_force.bias_mps2, core::Vector3(0, 1.5, 0));
}

TEST(IlcDecoder, CompletesTheRotationVector) {
  // A third of a turn about z: vector part sin(60 deg) on z, so x goes to (cos 120, sin 120).
  const auto decoded = decode("1574153941669\tTYPE_ROTATION_VECTOR\t0\t0\t0.8660254037844386\t3\n");
  const auto& rotation = only<sample::RotationSample>(decoded).enu_from_device;
  const core::Vector3 east_north_up = rotation * core::Vector3::UnitX();
  EXPECT_NEAR(east_north_up.x(), -0.5, 1e-9);
  EXPECT_NEAR(east_north_up.y(), std::sqrt(0.75), 1e-9);
  EXPECT_NEAR(east_north_up.z(), 0.0, 1e-9);
}

TEST(IlcDecoder, TakesAVectorPartThatRoundingMadeTooLong) {
  const auto decoded = decode("1574153941669\tTYPE_ROTATION_VECTOR\t0\t0\t1.00001\t3\n");
  EXPECT_NEAR(only<sample::RotationSample>(decoded).enu_from_device.norm(), 1.0, 1e-12);
}

TEST(IlcDecoder, GathersTheWifiRowsOfOneDelivery) {
  const auto decoded = decode(
      "1574153943476\tTYPE_WIFI\tHall\t04:40:a9:fb:32:a1\t-61\t5745\t1574153942664\n"
      "1574153943476\tTYPE_WIFI\t\t04:40:A9:FB:32:A2\t-62\t2412\t1574153943476\n"
      "1574153945480\tTYPE_WIFI\tHall\t04:40:a9:fb:32:a1\t-63\t5745\t1574153945000\n");
  ASSERT_THAT(decoded.samples, SizeIs(2));
  const auto& first = std::get<sample::WifiScan>(decoded.samples[0]);
  EXPECT_EQ(first.time, at_ms(1574153943476));
  ASSERT_THAT(first.readings, SizeIs(2));
  EXPECT_EQ(first.readings[0], (sample::WifiReading{core::TransmitterId::wifi(0x0440A9FB32A1),
                                                    -61.0F, 5745, at_ms(1574153942664), "Hall"}));
  EXPECT_EQ(first.readings[1].transmitter, core::TransmitterId::wifi(0x0440A9FB32A2));
  EXPECT_EQ(first.readings[1].ssid, "");
  EXPECT_THAT(std::get<sample::WifiScan>(decoded.samples[1]).readings, SizeIs(1));
}

TEST(IlcDecoder, DeliversAScanBeforeRecordsMuchLater) {
  const auto decoded = decode(
      "1574153943000\tTYPE_WIFI\tA\t04:40:a9:fb:32:a1\t-61\t5745\t1574153942664\n"
      "1574153943150\tTYPE_ACCELEROMETER\t0\t0\t9.8\t3\n"
      "1574153943000\tTYPE_WIFI\tB\t04:40:a9:fb:32:a2\t-61\t5745\t1574153942664\n"
      "1574153943250\tTYPE_ACCELEROMETER\t0\t0\t9.8\t3\n");
  ASSERT_THAT(decoded.samples, SizeIs(3));
  EXPECT_STREQ(sample::kind_of(decoded.samples[0]), "accelerometer");
  EXPECT_THAT(std::get<sample::WifiScan>(decoded.samples[1]).readings, SizeIs(2));
}

TEST(IlcDecoder, KeepsTabsInsideANetworkName) {
  const auto decoded =
      decode("1574153943476\tTYPE_WIFI\ta\tb;#\t04:40:a9:fb:32:a1\t-61\t5745\t1574153942664\n");
  EXPECT_EQ(only<sample::WifiScan>(decoded).readings.at(0).ssid, "a\tb;#");
}

TEST(IlcDecoder, RejectsAReadingSeenAfterItsDelivery) {
  const auto decoded =
      decode("1574153943476\tTYPE_WIFI\tA\t04:40:a9:fb:32:a1\t-61\t5745\t1574153943477\n");
  EXPECT_THAT(decoded.samples, IsEmpty());
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair("last_seen_after_delivery", 1)));
}

TEST(IlcDecoder, ReadsAnIBeacon) {
  const auto decoded = decode(
      "1574153955955\tTYPE_BEACON\tFB349B5F-8000-0080-0010-00003CFE0000\t19623\t24590\t-75\t-94\t"
      "5.25\t30:AE:A4:A1:EB:69\t1574153955955\n");
  const auto& reading = only<sample::BleReading>(decoded);
  EXPECT_EQ(reading.transmitter, core::TransmitterId::bluetooth(0x30AEA4A1EB69));
  EXPECT_EQ(reading.rssi_dbm, -94.0F);
  EXPECT_EQ(reading.tx_power_dbm, -75.0F);
  EXPECT_EQ(reading.beacon, "fb349b5f-8000-0080-0010-00003cfe0000/19623/24590");
}

TEST(IlcDecoder, KeepsABeaconThatBroadcastsAnImpossiblePower) {
  for (const char* power : {"0", "46"}) {
    const auto decoded = decode(std::string("5\tTYPE_BEACON\tFB349B5F-8000\t1\t2\t") + power +
                                "\t-94\t5.25\t30:AE:A4:A1:EB:69\t5\n");
    EXPECT_EQ(only<sample::BleReading>(decoded).rssi_dbm, -94.0F);
    EXPECT_EQ(only<sample::BleReading>(decoded).tx_power_dbm, std::nullopt);
  }
}

TEST(IlcDecoder, ReadsAWaypoint) {
  const auto decoded = decode("1574153941548\tTYPE_WAYPOINT\t40.25\t-116.5\n");
  const auto& waypoint = only<sample::WaypointSample>(decoded);
  EXPECT_EQ(waypoint.position_m, core::Vector2(40.25, -116.5));
  EXPECT_EQ(waypoint.geo_position, std::nullopt);
  EXPECT_EQ(waypoint.floor, "");
}

TEST(IlcDecoder, ReadsTheHeader) {
  const auto decoded = decode(
      "#\tstartTime:1574153941533\n"
      "#\tSiteID:5dbc\tSiteName:Hof: \xE6\x9D\xAD\tFloorId:5d\tFloorName:F4\n"
      "#\tBrand:OPPO\tModel:PBCM10\tAndroidName:8.1.0\tAPILevel:27\t\n"
      "#\tendTime:1574153979319\n");
  const auto& info = decoded.report.info;
  EXPECT_EQ(info.start_utc, core::UtcTime(std::chrono::milliseconds(1574153941533)));
  EXPECT_EQ(info.site, "Hof: \xE6\x9D\xAD");
  EXPECT_EQ(info.floor, "F4");
  EXPECT_EQ(info.device_brand, "OPPO");
  EXPECT_EQ(info.device_model, "PBCM10");
}

TEST(IlcDecoder, IgnoresKindsItDoesNotUseByName) {
  const auto decoded = decode(
      "1574153941540\tTYPE_DIST1\t12.8\t8.3\t-6.8\n"
      "1574153941788\tTYPE_BLUE\t\t28:7E:ED:7A:9A:76\t-94\n"
      "1574153941789\tTYPE_BLUE\t\t28:7E:ED:7A:9A:76\t-95\n");
  EXPECT_THAT(decoded.report.ignored, ElementsAre(Pair("TYPE_BLUE", 2), Pair("TYPE_DIST1", 1)));
  EXPECT_EQ(decoded.report.rejected_total(), 0U);
}

TEST(IlcDecoder, SplitsRecordsRunTogether) {
  const auto decoded = decode(
      "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t9\t21574153941689\tTYPE_WAYPOINT\t40.5\t"
      "116.251574153941700\tTYPE_GYROSCOPE\t0.5\t0.25\t0.125\t3\n");
  ASSERT_THAT(decoded.samples, SizeIs(3));
  EXPECT_EQ(std::get<sample::WaypointSample>(decoded.samples[1]).position_m,
            core::Vector2(40.5, 116.25));
  EXPECT_EQ(sample::time_of(decoded.samples[2]), at_ms(1574153941700));
  EXPECT_EQ(decoded.report.recovered_run_on, 2U);
  EXPECT_EQ(decoded.report.rejected_total(), 0U);
}

TEST(IlcDecoder, SplitsARecordOffWifiIgnoredAndHeaderLines) {
  const auto decoded = decode(
      "#\tVersionCode:4031574153941600\tTYPE_WAYPOINT\t1\t2\n"
      "1574153941788\tTYPE_BLUE\t\t28:7E:ED:7A:9A:76\t-941574153941790\tTYPE_WAYPOINT\t3\t4\n"
      "1574153943476\tTYPE_WIFI\tA\t04:40:a9:fb:32:a1\t-61\t5745\t1574153942664"
      "1574153943476\tTYPE_WIFI\tB\t04:40:a9:fb:32:a2\t-61\t5745\t1574153942664\n");
  EXPECT_THAT(decoded.report.accepted, ElementsAre(Pair("waypoint", 2), Pair("wifi_scan", 1)));
  EXPECT_EQ(decoded.report.recovered_run_on, 3U);
  EXPECT_THAT(std::get<sample::WifiScan>(decoded.samples.back()).readings, SizeIs(2));
}

TEST(IlcDecoder, CountsTheBadPartOfARunOnLineAndKeepsTheOther) {
  const auto decoded = decode(
      "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t1574153941689\tTYPE_WAYPOINT\t40.5\t116.25\n");
  EXPECT_THAT(decoded.report.accepted, ElementsAre(Pair("waypoint", 1)));
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair("wrong_field_count", 1)));
  EXPECT_EQ(decoded.report.recovered_run_on, 1U);
}

TEST(IlcDecoder, SplitsNothingWhereTheSecondTimeIsTooShort) {
  const auto decoded =
      decode("1574153941669\tTYPE_ACCELEROMETER\t1\t2\t9\t2153941689\tTYPE_WAYPOINT\t40.5\t1\n");
  EXPECT_THAT(decoded.samples, IsEmpty());
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair("wrong_field_count", 1)));
}

struct BadLine {
  const char* reason;
  const char* line;
};

class IlcDecoderRejects : public ::testing::TestWithParam<BadLine> {};

TEST_P(IlcDecoderRejects, ABadRecordByReason) {
  const auto decoded = decode(std::string(GetParam().line) + "\n");
  EXPECT_THAT(decoded.samples, IsEmpty());
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair(GetParam().reason, 1)));
}

INSTANTIATE_TEST_SUITE_P(
    Lines, IlcDecoderRejects,
    ::testing::Values(
        BadLine{"not_a_record", "garbage"}, BadLine{"not_a_record", "1574153941669\tACCELEROMETER"},
        BadLine{"not_a_record", "1574153941669\tTYPE_odd\t1"},
        BadLine{"bad_time", "-5\tTYPE_WAYPOINT\t1\t2"},
        BadLine{"bad_time", "99999999999999999\tTYPE_WAYPOINT\t1\t2"},
        BadLine{"bad_time", "1574153941.5\tTYPE_WAYPOINT\t1\t2"},
        BadLine{"wrong_field_count", "1574153941669\tTYPE_WAYPOINT\t1"},
        BadLine{"wrong_field_count", "1574153941669\tTYPE_WIFI\t04:40:a9:fb:32:a1\t-61\t1\t2"},
        BadLine{"wrong_field_count", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t3"},
        BadLine{"not_a_number", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\tnan\t3"},
        BadLine{"not_a_number", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\tinf\t3"},
        BadLine{"not_a_number", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t 3\t3"},
        BadLine{"not_a_number", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t\t3"},
        BadLine{"not_a_number", "1574153941669\tTYPE_ACCELEROMETER\t1,0\t2\t3\t3"},
        BadLine{"out_of_range", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t1e9\t3"},
        BadLine{"out_of_range", "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t3\t7"},
        BadLine{"out_of_range", "1574153941669\tTYPE_GYROSCOPE\t1\t200\t3\t3"},
        BadLine{"out_of_range", "1574153941669\tTYPE_ROTATION_VECTOR\t0.9\t0.9\t0\t3"},
        BadLine{"out_of_range", "1574153941669\tTYPE_WAYPOINT\t1e30\t2"},
        BadLine{"out_of_range", "1574153941669\tTYPE_WIFI\tA\t04:40:a9:fb:32:a1\t-300\t1\t5"},
        BadLine{"bad_address", "1574153941669\tTYPE_WIFI\tA\t04:40:a9:fb:32\t-30\t1\t5"},
        BadLine{"bad_beacon_id",
                "5\tTYPE_BEACON\tFB349B5F\t70000\t2\t-75\t-94\t5\t30:AE:A4:A1:EB:69\t5"}));

TEST(IlcDecoder, AcceptsWindowsLineEnds) {
  std::string text(kAccelerometerLine);
  text.insert(text.size() - 1, "\r");
  EXPECT_THAT(decode("\r\n" + text).report.accepted, ElementsAre(Pair("accelerometer", 1)));
}

TEST(IlcDecoder, DropsAHugeLineAndGoesOn) {
  const std::string text = "1574153941669\tTYPE_WIFI\t" + std::string(1'000'000, 'x') + "\n" +
                           std::string(kAccelerometerLine);
  for (const std::size_t chunk_bytes : {std::string_view::npos, std::size_t{4096}}) {
    const auto decoded = decode(text, chunk_bytes);
    EXPECT_THAT(decoded.samples, SizeIs(1));
    EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair("line_too_long", 1)));
  }
}

TEST(IlcDecoder, SaysThatTheLastLineIsCutShort) {
  const std::string text = std::string(kAccelerometerLine) + "1574153941700\tTYPE_ACCELER";
  const auto decoded = decode(text);
  EXPECT_THAT(decoded.samples, SizeIs(1));
  EXPECT_EQ(decoded.report.rejected_total(), 0U);
  EXPECT_EQ(
      decoded.report.truncated,
      "the last line, at byte " + std::to_string(kAccelerometerLine.size()) + ", is cut short");
}

TEST(IlcDecoder, DoesNotTrustALastFieldThatMayBeCutShort) {
  for (const char* line :
       {"1574153941548\tTYPE_WAYPOINT\t40.25\t11",
        "1574153943476\tTYPE_WIFI\tA\t04:40:a9:fb:32:a1\t-61\t5745\t157415394"}) {
    const auto decoded = decode(line);
    EXPECT_THAT(decoded.samples, IsEmpty()) << line;
    EXPECT_TRUE(decoded.report.truncated) << line;
  }
}

TEST(IlcDecoder, TakesAWholeLastLineWithoutLineEnd) {
  const auto decoded = decode(kAccelerometerLine.substr(0, kAccelerometerLine.size() - 1));
  EXPECT_THAT(decoded.samples, SizeIs(1));
  EXPECT_EQ(decoded.report.truncated, std::nullopt);
}

TEST(IlcDecoder, GivesTheSameHoweverTheBytesAreCut) {
  const std::string text =
      "#\tstartTime:1574153941533\r\n"
      "1574153943476\tTYPE_WIFI\tA\t04:40:a9:fb:32:a1\t-61\t5745\t1574153942664\n"
      "1574153943476\tTYPE_WIFI\tB\t04:40:a9:fb:32:a2\t-62\t5745\t1574153942665\n"
      "1574153941669\tTYPE_ACCELEROMETER\t1\t2\t9\t21574153941689\tTYPE_WAYPOINT\t40.5\t1.5\n"
      "junk\n\n1574153941669\tTYPE_ACCELEROMETER\t1\t2\t9\t";
  const auto whole = decode(text);
  ASSERT_THAT(whole.samples, SizeIs(3));
  for (std::size_t chunk_bytes = 1; chunk_bytes < text.size(); ++chunk_bytes) {
    const auto chunked = decode(text, chunk_bytes);
    EXPECT_EQ(chunked.samples, whole.samples) << chunk_bytes;
    EXPECT_EQ(chunked.report, whole.report) << chunk_bytes;
  }
}

}  // namespace
}  // namespace waylode::log
