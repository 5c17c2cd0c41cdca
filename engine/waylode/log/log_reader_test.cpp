// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/log_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include "test_support.hpp"

namespace waylode::log {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const SampleSink kDropSample = [](sample::Sample&&) {};

std::string compress(std::string_view text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  return packed;
}

/// `count` accelerometer records 20 ms apart whose x counts up.
std::string make_log(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += std::to_string(1574153941000 + 20 * i) + "\tTYPE_ACCELEROMETER\t" +
            std::to_string(i % 100) + "." + std::to_string(i * 7919 % 9973) + "\t0\t9.8\t3\n";
  }
  return text;
}

std::uint64_t accepted(const LogReport& report, const std::string& kind) {
  const auto found = report.accepted.find(kind);
  return found == report.accepted.end() ? 0 : found->second;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

TEST(LogReader, TellsZstdByContent) {
  const test::TemporaryFolder folder;
  write_file(folder.path() / "plain.zst", make_log(100));
  write_file(folder.path() / "packed.txt", compress(make_log(100)));
  for (const char* name : {"plain.zst", "packed.txt"}) {
    const auto report = read_log(folder.path() / name, kDropSample);
    ASSERT_TRUE(report) << core::to_string(report.error());
    EXPECT_EQ(report->format, LogFormat::kIlc);
    EXPECT_EQ(accepted(*report, "accelerometer"), 100U);
    EXPECT_EQ(report->bytes_read, make_log(100).size());
    EXPECT_EQ(report->truncated, std::nullopt);
  }
}

TEST(LogReader, ReadsZstdFramesOneAfterTheOther) {
  const auto report =
      read_log_bytes(compress(make_log(10)) + compress(make_log(20)), "two", kDropSample);
  ASSERT_TRUE(report);
  EXPECT_EQ(accepted(*report, "accelerometer"), 30U);
}

TEST(LogReader, GivesWhatATruncatedZstdHeldWholeAndSaysSo) {
  const std::string packed = compress(make_log(20'000));
  const auto report =
      read_log_bytes(std::string_view(packed).substr(0, packed.size() / 2), "cut", kDropSample);
  ASSERT_TRUE(report) << core::to_string(report.error());
  EXPECT_GT(accepted(*report, "accelerometer"), 1'000U);
  EXPECT_LT(accepted(*report, "accelerometer"), 20'000U);
  EXPECT_EQ(report->rejected_total(), 0U);
  EXPECT_THAT(report->truncated.value_or(""), HasSubstr("ends inside a frame"));
}

TEST(LogReader, SaysThatAZstdIsDamaged) {
  std::string packed = compress(make_log(20'000));
  std::fill_n(packed.begin() + std::ssize(packed) * 3 / 4, 64, '\x5A');
  const auto report = read_log_bytes(packed, "damaged", kDropSample);
  ASSERT_TRUE(report) << core::to_string(report.error());
  EXPECT_THAT(report->truncated.value_or(""), HasSubstr("damaged near byte"));
}

TEST(LogReader, RefusesAZstdOfWhichNothingIsWhole) {
  const auto report = read_log_bytes(compress(make_log(10)).substr(0, 8), "stub", kDropSample);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, core::ErrorCode::kLogCorrupt);
}

TEST(LogReader, RefusesAMissingFileAndAFolder) {
  const test::TemporaryFolder folder;
  const auto missing = read_log(folder.path() / "absent.txt", kDropSample);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, core::ErrorCode::kFileNotFound);
  EXPECT_EQ(missing.error().place, (folder.path() / "absent.txt").string());
  const auto not_a_file = read_log(folder.path(), kDropSample);
  ASSERT_FALSE(not_a_file);
  EXPECT_EQ(not_a_file.error().code, core::ErrorCode::kFileUnreadable);
}

TEST(LogReader, RefusesEmptyLogs) {
  for (const std::string& bytes :
       {std::string(), compress(""), std::string("#\tstartTime:1574153941533\n")}) {
    const auto report = read_log_bytes(bytes, "empty", kDropSample);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, core::ErrorCode::kLogEmpty);
    EXPECT_EQ(report.error().place, "empty");
  }
}

TEST(LogReader, RefusesWhatIsNoLogAndNamesTheFormats) {
  std::string binary(200'000, '\0');
  for (std::size_t i = 0; i < binary.size(); ++i) {
    binary[i] = static_cast<char>(i * 2654435761U >> 13U);
  }
  for (const std::string& bytes :
       {binary, std::string("\x7f"), std::string("PNG"), std::string("a,b,c\n1,2,3\n")}) {
    const auto report = read_log_bytes(bytes, "junk", kDropSample);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, core::ErrorCode::kLogUnrecognised);
    EXPECT_THAT(report.error().message, HasSubstr("ILC, GetSensorData or MCAP"));
  }
}

TEST(LogReader, RefusesALogWithoutOneGoodRecord) {
  const auto report =
      read_log_bytes("1574153941000\tTYPE_ACCELEROMETER\tx\ty\tz\t3\n", "bad", kDropSample);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, core::ErrorCode::kLogCorrupt);
  EXPECT_THAT(report.error().message, HasSubstr("not_a_number"));
}

TEST(LogReader, RecognisesALogBehindDamagedLines) {
  const auto report = read_log_bytes("@@@@\n%%%\n" + make_log(3), "damaged", kDropSample);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->rejected.at("not_a_record"), 2U);
  EXPECT_EQ(accepted(*report, "accelerometer"), 3U);
}

TEST(LogReader, PassesOverAByteOrderMark) {
  const auto report = read_log_bytes("\xEF\xBB\xBF" + make_log(3), "marked", kDropSample);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->rejected_total(), 0U);
  EXPECT_EQ(accepted(*report, "accelerometer"), 3U);
}

TEST(LogReader, ReadsTheBundledLogs) {
  const auto ilc = read_log(test::source_root() / "testdata/ilc_mini/mini.txt", kDropSample);
  ASSERT_TRUE(ilc) << core::to_string(ilc.error());
  EXPECT_EQ(ilc->format, LogFormat::kIlc);
  EXPECT_EQ(ilc->info.floor, "F1");
  EXPECT_EQ(ilc->rejected_total(), 0U);
  // 12 s at 10 Hz, both ends included; counts as the folder's README tells them.
  EXPECT_EQ(accepted(*ilc, "accelerometer"), 121U);
  EXPECT_EQ(accepted(*ilc, "wifi_scan"), 3U);
  EXPECT_EQ(accepted(*ilc, "waypoint"), 3U);
  const auto ipin =
      read_log(test::source_root() / "testdata/getsensordata_mini/mini.txt", kDropSample);
  ASSERT_TRUE(ipin) << core::to_string(ipin.error());
  EXPECT_EQ(ipin->format, LogFormat::kGetSensorData);
  EXPECT_EQ(ipin->info.device_model, "Pocket 1");
  EXPECT_EQ(ipin->rejected_total(), 0U);
  EXPECT_EQ(accepted(*ipin, "barometer"), 101U);
  EXPECT_EQ(accepted(*ipin, "wifi_scan"), 3U);
  EXPECT_EQ(accepted(*ipin, "waypoint"), 3U);
}

TEST(LogReader, HandsAnMcapFileToItsDecoder) {
  const auto report = read_log_bytes("\x89MCAP0\r\n", "magic only", kDropSample);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().code, core::ErrorCode::kLogUnrecognised);
}

TEST(LogReader, LoadsARecordingInOrderOfTime) {
  const test::TemporaryFolder folder;
  write_file(folder.path() / "log.txt",
             "2000\tTYPE_WAYPOINT\t1\t1\n1000\tTYPE_WAYPOINT\t2\t2\n2000\tTYPE_WAYPOINT\t3\t3\n");
  const auto recording = load_recording(folder.path() / "log.txt");
  ASSERT_TRUE(recording);
  ASSERT_THAT(recording->samples, SizeIs(3));
  const double expected_x_m[] = {2, 1, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& waypoint = std::get<sample::WaypointSample>(recording->samples[i]);
    EXPECT_EQ(waypoint.position_m->x(), expected_x_m[i]);
  }
}

TEST(LogReader, ReadsARealIlcLogWithoutRejections) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  const auto folder = *root / "ilc" / "site1" / "F1" / "path_data_files";
  const auto report = read_log(std::filesystem::directory_iterator(folder)->path(), kDropSample);
  ASSERT_TRUE(report) << core::to_string(report.error());
  EXPECT_EQ(report->rejected_total(), 0U);
  EXPECT_GT(accepted(*report, "accelerometer"), 100U);
  EXPECT_GT(accepted(*report, "wifi_scan"), 1U);
  EXPECT_GT(accepted(*report, "waypoint"), 1U);
}

}  // namespace
}  // namespace waylode::log
