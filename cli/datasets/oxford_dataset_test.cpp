// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/oxford_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "test_support.hpp"

namespace waylode::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Files = std::map<std::string, std::string>;

constexpr const char* kAccelerometer =
    "1000,3,0.5,-9.25,1e-1\n3000,3,1,2,3\n5000,2,-1,0,4\n9000,3,0,0,9\n";
// Edges: right at 1500, left at 2500, both at 4500; after the end: right at 9500.
constexpr const char* kSwitches =
    "500,1,0\n1500,1,1\n2000,0,1\n2500,1,1\n4000,0,0\n4500,1,1\n5000,1,0\n9500,1,1\n";
constexpr const char* kStats =
    "#dir, user, phone, position, surface, duration(s), steps \n"
    "Pixel_A_Hard_ArmBand_1, A, Pixel, ArmBand, Hard, 152, 4\n";

Files one_recording() {
  return {{"data/Pixel_A_Hard_ArmBand_1/accelerometer.csv", kAccelerometer},
          {"data/Pixel_A_Hard_ArmBand_1/stepcounter.csv", kSwitches},
          {"stats.csv", kStats}};
}

core::DeviceTime at_ns(std::int64_t time_ns) { return core::DeviceTime{core::Duration(time_ns)}; }

TEST(OxfordDataset, GivesSamplesAndTheEdgesOfEitherSwitchWhileTheyRan) {
  const auto dataset = parse_oxford_dataset(one_recording(), "here");
  ASSERT_TRUE(dataset) << to_string(dataset.error());
  EXPECT_TRUE(dataset->notes.empty());
  ASSERT_EQ(dataset->recordings.size(), 1U);
  const experiment::StepRecording& recording = dataset->recordings.front();
  EXPECT_EQ(recording.name, "Pixel_A_Hard_ArmBand_1");
  EXPECT_EQ(recording.placement, "armband");
  EXPECT_EQ(recording.phone, "Pixel");
  ASSERT_EQ(recording.samples.size(), 4U);
  EXPECT_EQ(recording.samples[0], (sample::AccelerometerSample{at_ns(1000), {0.5, -9.25, 0.1}}));
  EXPECT_THAT(recording.steps, ElementsAre(at_ns(1500), at_ns(2500), at_ns(4500), at_ns(4500)));
}

TEST(OxfordDataset, NotesACountThatStatsContradict) {
  Files files = one_recording();
  files["data/Pixel_A_Hard_ArmBand_1/stepcounter.csv"] = "1500,0,0\n2000,0,1\n";
  const auto dataset = parse_oxford_dataset(files, "here");
  ASSERT_TRUE(dataset);
  EXPECT_THAT(dataset->notes, ElementsAre("Pixel_A_Hard_ArmBand_1: 1 steps by the switches, 4 by "
                                          "stats.csv"));
}

TEST(OxfordDataset, LeavesOutWhatStatsDoNotListOrLacksAnAccelerometer) {
  Files files = one_recording();
  files["data/_Patient_3/accelerometer.csv"] = kAccelerometer;
  files["data/_Patient_3/stepcounter.csv"] = kSwitches;
  files["data/Bare/stepcounter.csv"] = kSwitches;
  files["stats.csv"] = std::string(kStats) + "Bare, B, Pixel, Purse, Hard, 1, 4\n";
  const auto dataset = parse_oxford_dataset(files, "here");
  ASSERT_TRUE(dataset);
  EXPECT_EQ(dataset->recordings.size(), 1U);
  EXPECT_THAT(dataset->notes, ElementsAre(HasSubstr("Bare: left out"), HasSubstr("_Patient_3")));
}

TEST(OxfordDataset, WithoutStatsTheNameTellsPlacementAndPhone) {
  Files files = one_recording();
  files.erase("stats.csv");
  files["data/walk/accelerometer.csv"] = kAccelerometer;
  files["data/walk/stepcounter.csv"] = kSwitches;
  const auto dataset = parse_oxford_dataset(files, "here");
  ASSERT_TRUE(dataset);
  ASSERT_EQ(dataset->recordings.size(), 2U);
  EXPECT_EQ(dataset->recordings[0].placement, "armband");
  EXPECT_EQ(dataset->recordings[0].phone, "Pixel");
  EXPECT_EQ(dataset->recordings[1].placement, "");
}

TEST(OxfordDataset, NamesFileAndLineOfWhatIsWrong) {
  const auto expect_refused = [](const char* file, const std::string& text, int line) {
    Files files = one_recording();
    const std::string path = std::string("data/Pixel_A_Hard_ArmBand_1/") + file;
    files[path] = text;
    const auto dataset = parse_oxford_dataset(files, "here");
    ASSERT_FALSE(dataset) << text;
    EXPECT_EQ(dataset.error().code, core::ErrorCode::kTableInvalid);
    EXPECT_EQ(dataset.error().place, path + ":" + std::to_string(line));
  };
  const std::string good = "1000,3,0.5,-9.25,1\n";
  for (const char* bad : {"2000,3,1,2\n", "2000,3,1,2,3,4\n", "2000,3,1,2,x\n", "2000,3,1,2,nan\n",
                          "2000,3,1,inf,3\n", "2e3,3,1,2,3\n", "999,3,1,2,3\n", "2000,3,1,2,\n",
                          "t_ns,accuracy,ax,ay,az\n"}) {
    expect_refused("accelerometer.csv", good + bad, 2);
  }
  for (const char* bad : {"2000,1\n", "2000,1,2\n", "2000,-1,0\n", "2000,a,0\n", "999,0,1\n"}) {
    expect_refused("stepcounter.csv", std::string("1000,0,1\n") + bad, 2);
  }
}

TEST(OxfordDataset, RefusesStatsWithOtherColumns) {
  Files files = one_recording();
  files["stats.csv"] = "#dir\nPixel, A\n";
  const auto dataset = parse_oxford_dataset(files, "here");
  ASSERT_FALSE(dataset);
  EXPECT_EQ(dataset.error().place, "stats.csv:2");
}

TEST(OxfordDataset, EmptyFilesHoldNoStep) {
  Files files = one_recording();
  files["data/Pixel_A_Hard_ArmBand_1/accelerometer.csv"] = "";
  const auto dataset = parse_oxford_dataset(files, "here");
  ASSERT_TRUE(dataset);
  EXPECT_TRUE(dataset->recordings.front().samples.empty());
  EXPECT_TRUE(dataset->recordings.front().steps.empty());
}

TEST(OxfordDataset, ReadsAFolderToo) {
  const test::TemporaryFolder folder;
  for (const auto& [name, text] : one_recording()) {
    const auto path = folder.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  const auto dataset = load_oxford_dataset(folder.path());
  ASSERT_TRUE(dataset) << to_string(dataset.error());
  EXPECT_EQ(dataset->recordings.front().steps.size(), 4U);
}

TEST(OxfordDataset, RefusesAFolderWithoutRecordings) {
  const test::TemporaryFolder folder;
  const auto dataset = load_oxford_dataset(folder.path());
  ASSERT_FALSE(dataset);
  EXPECT_EQ(dataset.error().code, core::ErrorCode::kLogLacksRecords);
  EXPECT_EQ(load_oxford_dataset(folder.path() / "none").error().code,
            core::ErrorCode::kFileNotFound);
}

TEST(OxfordDataset, ReadsTheRealArchive) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  const auto path = *root / "oxford-steps" / "optimisation.tar.zst";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << test::kNoData;
  const auto dataset = load_oxford_dataset(path);
  ASSERT_TRUE(dataset) << to_string(dataset.error());
  EXPECT_EQ(dataset->recordings.size(), 48U);  // The rows of stats.csv.
  // Left out are the four patients; no count differs from stats.csv.
  EXPECT_THAT(dataset->notes, ::testing::Each(HasSubstr("_Patient_")));
}

}  // namespace
}  // namespace waylode::cli
