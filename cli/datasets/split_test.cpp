// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/split.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "test_support.hpp"

namespace waylode::cli {
namespace {

using ::testing::HasSubstr;

class SplitTable : public ::testing::Test {
 protected:
  core::Result<Split> read(const std::string& text,
                           const std::vector<std::string>& keys = {"site", "trace"}) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_split(path_, keys);
  }

  void expect_refused(const std::string& text, int line, const std::string& mention) {
    const auto split = read(text);
    ASSERT_FALSE(split) << text;
    EXPECT_EQ(split.error().code, core::ErrorCode::kTableInvalid);
    EXPECT_EQ(split.error().place, path_.string() + ":" + std::to_string(line));
    EXPECT_THAT(split.error().message, HasSubstr(mention));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "split.csv";
};

TEST_F(SplitTable, TakesColumnsInAnyOrder) {
  const auto split = read("split,trace,note,site\ntest,a,x,mall\ntrain,b,,mall\n");
  ASSERT_TRUE(split);
  ASSERT_EQ(split->size(), 2U);
  EXPECT_EQ(split->at("mall/a").part, Part::kTest);
  EXPECT_EQ(split->at("mall/a").line, 2U);
  EXPECT_EQ(split->at("mall/b").part, Part::kTrain);
}

TEST_F(SplitTable, QuotedCellsHoldCommasQuotesAndLineEnds) {
  const auto split = read(
      "site,trace,split\r\n\"Mall, East \"\"wing\"\"\",a,train\r\n\"two\nlines\",b,test\r\n"
      "plain,c,\"test\"");
  ASSERT_TRUE(split) << split.error().message;
  ASSERT_EQ(split->size(), 3U);
  EXPECT_EQ(split->at("Mall, East \"wing\"/a").line, 2U);
  EXPECT_EQ(split->at("two\nlines/b").line, 3U);
  EXPECT_EQ(split->at("plain/c").line, 5U);
}

TEST_F(SplitTable, EmptyLastCellIsACell) {
  const auto split = read("site,trace,split,note\nmall,a,test,\n");
  ASSERT_TRUE(split) << split.error().message;
  expect_refused("site,trace,split\nmall,a,\n", 2, "write 'train' or 'test'");
  expect_refused("site,trace,split\nmall,a,test,\n", 2, "expected 3 cells, found 4");
}

TEST_F(SplitTable, PassesOverByteOrderMarkAndBlankLines) {
  const auto split = read("\xEF\xBB\xBFsite,trace,split\n\nmall,a,test\n\n");
  ASSERT_TRUE(split) << split.error().message;
  EXPECT_EQ(split->at("mall/a").line, 3U);
}

TEST_F(SplitTable, SameKeyTwiceMustAgree) {
  EXPECT_TRUE(read("site,trace,split\nmall,a,test\nmall,a,test\n"));
  expect_refused("site,trace,split\nmall,a,test\nmall,b,test\nmall,a,train\n", 4, "line 2");
}

TEST_F(SplitTable, NamesTheLineOfWhatIsWrong) {
  expect_refused("", 1, "no column 'site'");
  expect_refused("site,trace\nmall,a\n", 1, "no column 'split'");
  expect_refused("site,trace,split\n", 1, "names no recording");
  expect_refused("site,trace,split\nmall,a,test\nmall,b\n", 3, "expected 3 cells, found 2");
  expect_refused("site,trace,split\nmall,a,valid\n", 2, "valid");
  expect_refused("site,trace,split\nmall,a,test\nma\"ll,b,test\n", 3, "quote");
  expect_refused("site,trace,split\n\"mall\" x,b,test\n", 2, "comma");
  expect_refused("site,trace,split\nmall,a,test\n\"mall,b,test\nx,c,test\n", 3, "never closed");
}

TEST_F(SplitTable, MissingLogsAreNotedOnceWithTheFirstByLine) {
  const auto split = read("site,trace,split\nmall,a,test\nz,gone,test\nb,gone,train\n");
  ASSERT_TRUE(split);
  std::vector<std::string> notes;
  const core::LogSink log = [&](core::LogLevel /*level*/, std::string_view /*module*/,
                                std::string_view note) { notes.emplace_back(note); };
  note_missing(*split, {"mall/a"}, path_, log);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr(path_.string() + ":3: 2 of 3"));
  EXPECT_THAT(notes[0], HasSubstr("'z/gone'"));

  note_missing(*split, {"mall/a", "z/gone", "b/gone"}, path_, log);
  EXPECT_EQ(notes.size(), 1U);
}

TEST(RandomSplit, TakesAQuarterWhateverTheOrder) {
  std::vector<std::string> keys;
  for (char c = 'a'; c < 'l'; ++c) keys.emplace_back(1, c);  // 11 keys: 2 tests.
  const Split forward = random_split(keys, {.seed = 7});
  std::ranges::reverse(keys);
  const Split backward = random_split(keys, {.seed = 7});
  int tests = 0;
  for (const auto& [key, entry] : forward) {
    EXPECT_EQ(entry.part, backward.at(key).part);
    tests += entry.part == Part::kTest ? 1 : 0;
  }
  EXPECT_EQ(forward.size(), 11U);
  EXPECT_EQ(tests, 2);
}

TEST(RandomSplit, FoldsOfASeedTestEachKeyOnce) {
  std::vector<std::string> keys;
  for (char c = 'a'; c < 'l'; ++c) keys.emplace_back(1, c);
  std::map<std::string, int> tested;
  std::vector<std::size_t> sizes;
  for (std::uint64_t number = 1; number <= 3; ++number) {
    std::size_t size = 0;
    for (const auto& [key, entry] : random_split(keys, {.seed = 5, .fold = {number, 3}})) {
      if (entry.part != Part::kTest) continue;
      ++tested[key];
      ++size;
    }
    sizes.push_back(size);
  }
  EXPECT_EQ(tested.size(), 11U);
  for (const auto& [key, times] : tested) EXPECT_EQ(times, 1) << key;
  EXPECT_EQ(sizes, (std::vector<std::size_t>{3, 4, 4}));  // Cut at 0, 3.67, 7.33 and 11.
}

TEST(RandomSplit, SeedsDiffer) {
  std::vector<std::string> keys;
  for (int i = 0; i < 40; ++i) keys.push_back(std::to_string(i));
  const auto tests = [&](std::uint64_t seed) {
    std::set<std::string> chosen;
    for (const auto& [key, entry] : random_split(keys, {.seed = seed})) {
      if (entry.part == Part::kTest) chosen.insert(key);
    }
    return chosen;
  };
  EXPECT_EQ(tests(1).size(), 10U);
  EXPECT_NE(tests(1), tests(2));
}

TEST(KeepAside, TakesItsShareOfTheTrainingPartOnly) {
  std::vector<std::string> keys;
  for (int i = 0; i < 20; ++i) keys.push_back(std::to_string(i));
  const Dealing dealing{.seed = 3, .fold = {1, 4}, .unlabelled_ratio = 0.5};
  const Split before = random_split(keys, dealing);
  Split split = before;
  keep_aside(split, dealing);
  int aside = 0;
  for (const auto& [key, entry] : split) {
    if (entry.part == Part::kUnlabelled) {
      ++aside;
      EXPECT_EQ(before.at(key).part, Part::kTrain);
    } else {
      EXPECT_EQ(before.at(key).part, entry.part);
    }
  }
  EXPECT_EQ(aside, 7);  // Half of 15, rounded down.
  Split untouched = before;
  keep_aside(untouched, {.seed = 3});
  for (const auto& [key, entry] : untouched) EXPECT_NE(entry.part, Part::kUnlabelled) << key;
}

TEST(ParseFold, TakesOnlyKOfN) {
  EXPECT_EQ(parse_fold("2/4").value(), (Fold{2, 4}));
  for (const char* text : {"", "2", "2/", "/4", "0/4", "5/4", "1/1", "2/4x", "-1/4", "1/2000"}) {
    EXPECT_FALSE(parse_fold(text)) << text;
  }
}

TEST(RecordingName, LosesOnlyTheEndingsOfLogs) {
  EXPECT_EQ(recording_name("a/b/walk.1.txt"), "walk.1");
  EXPECT_EQ(recording_name("walk.txt.zst"), "walk");
  EXPECT_EQ(recording_name("walk.mcap"), "walk");
  EXPECT_EQ(recording_name("walk.csv"), "walk.csv");
}

}  // namespace
}  // namespace waylode::cli
