// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/fingerprint_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <string>

#include "test_support.hpp"

namespace waylode::log {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kHeader = "WAP001,WAP003,LONGITUDE,LATITUDE,FLOOR,BUILDINGID,SPACEID\n";

std::string compress(std::string_view text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  return packed;
}

TEST(FingerprintTable, ReadsRowsByTheNamesOfTheColumns) {
  const auto rows = read_uji_table_bytes(
      "FLOOR,WAP001,LATITUDE,WAP520,LONGITUDE,BUILDINGID\n"
      "2,-97,4864920.75,100,-7541.25,B\r\n"
      "0,100,4864921,-0.5,-7542,1\n",
      "t");
  ASSERT_TRUE(rows) << core::to_string(rows.error());
  ASSERT_THAT(*rows, SizeIs(2));
  EXPECT_EQ(rows->at(0).building, "B");
  EXPECT_EQ(rows->at(0).floor, "2");
  EXPECT_EQ(rows->at(0).position_m, core::Vector2(-7541.25, 4864920.75));
  ASSERT_THAT(rows->at(0).readings, SizeIs(1));
  EXPECT_EQ(rows->at(0).readings[0].transmitter, core::TransmitterId::column(1));
  EXPECT_EQ(rows->at(0).readings[0].rssi_dbm, -97.0F);
  EXPECT_EQ(rows->at(1).readings.at(0).transmitter, core::TransmitterId::column(520));
}

TEST(FingerprintTable, KeepsRowsWhereNothingWasHeard) {
  const auto rows = read_uji_table_bytes(std::string(kHeader) + "100,100,1,2,0,0,7", "t");
  ASSERT_TRUE(rows);
  EXPECT_THAT(rows->at(0).readings, IsEmpty());
}

TEST(FingerprintTable, ReadsACompressedTable) {
  const auto rows =
      read_uji_table_bytes(compress(std::string(kHeader) + "-50,100,1,2,0,0,7\n"), "t");
  ASSERT_TRUE(rows);
  EXPECT_THAT(*rows, SizeIs(1));
}

TEST(FingerprintTable, RefusesATruncatedCompressedTable) {
  std::string text = kHeader;
  for (int i = 0; i < 20'000; ++i) text += "-50,100," + std::to_string(i * 7919) + ",2,0,0,7\n";
  const std::string packed = compress(text);
  const auto rows = read_uji_table_bytes(packed.substr(0, packed.size() / 2), "t");
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, core::ErrorCode::kTableInvalid);
  EXPECT_THAT(rows.error().message, HasSubstr("ends inside a frame"));
}

TEST(FingerprintTable, RefusesAMissingFile) {
  const test::TemporaryFolder folder;
  const auto rows = read_uji_table(folder.path() / "absent.csv");
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, core::ErrorCode::kFileNotFound);
}

struct BadTable {
  const char* place;
  const char* message;
  std::string text;
};

class FingerprintTableRefuses : public ::testing::TestWithParam<BadTable> {};

TEST_P(FingerprintTableRefuses, WithPlaceAndReason) {
  const auto rows = read_uji_table_bytes(GetParam().text, "t.csv");
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, core::ErrorCode::kTableInvalid);
  EXPECT_EQ(rows.error().place, GetParam().place);
  EXPECT_THAT(rows.error().message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Tables, FingerprintTableRefuses,
    ::testing::Values(
        BadTable{"t.csv:0", "empty", ""},
        BadTable{"t.csv:1", "no column FLOOR", "WAP001,LONGITUDE,LATITUDE,BUILDINGID\n"},
        BadTable{"t.csv:1", "no column WAP1", "LONGITUDE,LATITUDE,FLOOR,BUILDINGID\n"},
        BadTable{"t.csv:1", "not WAP and a number", "WAPx,LONGITUDE,LATITUDE,FLOOR,BUILDINGID\n"},
        BadTable{"t.csv:1", "already", "FLOOR,WAP1,LONGITUDE,LATITUDE,FLOOR,BUILDINGID\n"},
        BadTable{"t.csv:1", "same number", "WAP1,WAP01,LONGITUDE,LATITUDE,FLOOR,BUILDINGID\n"},
        BadTable{"t.csv:2", "5 cells, but the header names 7",
                 std::string(kHeader) + "-50,100,1,2,0\n"},
        BadTable{"t.csv:2", "8 cells", std::string(kHeader) + "-50,100,1,2,0,0,7,8\n"},
        BadTable{"t.csv:3", "column 1 holds \"loud\"",
                 std::string(kHeader) + "-50,100,1,2,0,0,7\nloud,100,1,2,0,0,7\n"},
        BadTable{"t.csv:2", "not an RSSI", std::string(kHeader) + "50,100,1,2,0,0,7\n"},
        BadTable{"t.csv:2", "not an RSSI", std::string(kHeader) + ",100,1,2,0,0,7\n"},
        BadTable{"t.csv:2", "column 3 holds \"nan\"",
                 std::string(kHeader) + "-50,100,nan,2,0,0,7\n"},
        BadTable{"t.csv:2", "not a name", std::string(kHeader) + "-50,100,1,2,,0,7\n"},
        BadTable{"t.csv:2", "too long", std::string(kHeader) + std::string(100'000, '1') + "\n"},
        BadTable{"t.csv:1", "no column LONGITUDE", "\x7f\x45\x4c\x46 binary"}));

TEST(FingerprintTable, ReadsUjiIndoorLocAsPublished) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  const auto rows = read_uji_table(*root / "ujiindoorloc" / "trainingData.csv.zst");
  ASSERT_TRUE(rows) << core::to_string(rows.error());
  EXPECT_THAT(*rows, SizeIs(19'937));
  const auto silent = std::count_if(rows->begin(), rows->end(),
                                    [](const auto& row) { return row.readings.empty(); });
  EXPECT_EQ(silent, 76);
  const auto validation = read_uji_table(*root / "ujiindoorloc" / "validationData.csv.zst");
  ASSERT_TRUE(validation) << core::to_string(validation.error());
  EXPECT_THAT(*validation, SizeIs(1'111));
}

}  // namespace
}  // namespace waylode::log
