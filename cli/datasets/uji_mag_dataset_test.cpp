// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/uji_mag_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace waylode::cli {
namespace {

using testing::HasSubstr;

const std::string kReadings =
    "1000 -8.5 -34.25 -21.5 0.1 0.2 0.3 90.0 -30.0 0.0 \n"
    "1100 1 2 3 0 0 0 0.0 0.0 90.0 \n"
    "\n"
    "1200 1 2 3 0 0 0 1e1 0.0 0.0\r\n"
    "1300 1 2 3 0 0 0 -170 330 0\n";
const std::string kStretches =
    "<2>\n"
    "39.9939 -0.0738 39.9939 -0.0737 0 1\n"
    "39.9939 -0.0737 39.9940 -0.0737 2 3";

TEST(UjiMagDataset, ReadsAWalk) {
  const auto walk = parse_uji_mag_walk(kReadings + kStretches, "a.txt");
  ASSERT_TRUE(walk) << core::to_string(walk.error());
  ASSERT_EQ(walk->readings.size(), 4U);
  const auto& first = walk->readings[0];
  EXPECT_EQ(first.time, core::device_time_from_ms(1000));
  EXPECT_EQ(first.field_ut, core::Vector3(-8.5, -34.25, -21.5));
  // Azimuth east; the top edge tilted up by 30 degrees.
  EXPECT_NEAR(first.heading_rad, 0.0, 1e-12);
  EXPECT_NEAR((first.up_in_device - core::Vector3(0.0, 0.5, std::sqrt(0.75))).norm(), 0.0, 1e-12);
  // Rolled by 90 degrees: the left edge is up.
  EXPECT_NEAR((walk->readings[1].up_in_device - core::Vector3(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  // 330 degrees are -30.
  EXPECT_NEAR((walk->readings[3].up_in_device - first.up_in_device).norm(), 0.0, 1e-12);
  ASSERT_EQ(walk->stretches.size(), 2U);
  EXPECT_NEAR(walk->stretches[0].from_m.norm(), 0.0, 1e-6);
  // 0.0001 degrees of longitude at 40 degrees north: 8.54 m; of latitude: 11.10 m.
  EXPECT_NEAR(walk->stretches[1].from_m.x(), 8.54, 0.02);
  EXPECT_NEAR(walk->stretches[1].to_m.y(), 11.10, 0.02);
  EXPECT_EQ(walk->stretches[1].first, 2U);
  EXPECT_EQ(walk->stretches[1].last, 3U);
}

TEST(UjiMagDataset, TakesTheOddEndsOfItsFiles) {
  const auto walk =
      parse_uji_mag_walk(kReadings + "49<1>\n39.9939 -0.0738 39.9939 -0.0737 0 4\n", "a.txt");
  ASSERT_TRUE(walk) << core::to_string(walk.error());
  EXPECT_EQ(walk->stretches[0].last, 3U);
}

TEST(UjiMagDataset, RefusesWhatIsNotAsItShouldBe) {
  const auto refused = [](const std::string& text, const std::string& place) {
    const auto walk = parse_uji_mag_walk(text, "a.txt");
    ASSERT_FALSE(walk) << text;
    EXPECT_EQ(walk.error().code, core::ErrorCode::kTableInvalid);
    EXPECT_THAT(walk.error().place, HasSubstr(place));
  };
  const std::string stretch = "39.9939 -0.0738 39.9939 -0.0737 ";
  refused("", "a.txt");
  refused(kReadings, "a.txt");
  refused("1000 1 2 3\n" + kReadings + kStretches, "a.txt:1");
  refused("x 1 2 3 0 0 0 0 0 0\n" + kStretches, "a.txt:1");
  refused("900 1 nan 3 0 0 0 0 0 0\n" + kReadings + kStretches, "a.txt:1");
  refused("900 1 2 inf 0 0 0 0 0 0\n" + kReadings + kStretches, "a.txt:1");
  refused(kReadings + kReadings + kStretches, "a.txt:6");  // The time goes back.
  refused(kReadings + "<x>\n", "a.txt:6");
  refused(kReadings + "7\n", "a.txt:6");
  refused(kReadings + "<0>\n", "a.txt");
  refused(kReadings + "<1>\n", "a.txt");
  refused(kReadings + "<2>\n" + stretch + "0 1\n", "a.txt:7");
  refused(kReadings + "<1>\n" + stretch + "1 1\n", "a.txt:7");
  refused(kReadings + "<1>\n" + stretch + "-1 1\n", "a.txt:7");
  refused(kReadings + "<1>\n" + stretch + "0 5\n", "a.txt:7");
  refused(kReadings + "<1>\n" + "139.9 -0.0738 39.9939 -0.0737 0 1\n", "a.txt:7");
  refused(kReadings + "<2>\n" + stretch + "0 2\n" + stretch + "2 3\n", "a.txt:8");
}

TEST(UjiMagDataset, NeedsAnArchiveOfItsOwn) {
  const auto dataset = load_uji_mag_dataset("no/such/archive.tar");
  ASSERT_FALSE(dataset);
  EXPECT_EQ(dataset.error().code, core::ErrorCode::kFileNotFound);
}

}  // namespace
}  // namespace waylode::cli
