// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "test_support.hpp"

namespace waylode::core {
namespace {

using std::filesystem::path;

std::string content_of(const path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::size_t entries_in(const path& folder) {
  const std::filesystem::directory_iterator entries(folder);
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class File : public ::testing::Test {
 protected:
  path at(const char* name) const { return folder_.path() / name; }

  test::TemporaryFolder folder_;
};

TEST_F(File, ReadsEveryByte) {
  const std::string bytes("line\r\n\0\xFF tail", 13);
  put(at("some"), bytes);
  EXPECT_EQ(read_file(at("some")), bytes);
}

TEST_F(File, ReadsAnEmptyFileAsNothing) {
  put(at("empty"), "");
  EXPECT_EQ(read_file(at("empty")), std::string());
}

TEST_F(File, TellsAMissingFileFromAnUnreadableOne) {
  put(at("some"), "x");
  for (const path& missing : {at("none"), at("none/below"), at("some/below")}) {
    const auto result = read_file(missing);
    ASSERT_FALSE(result) << missing;
    EXPECT_EQ(result.error().code, ErrorCode::kFileNotFound);
    EXPECT_EQ(result.error().place, missing.string());
  }
  const auto folder = read_file(folder_.path());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ErrorCode::kFileUnreadable);
}

TEST_F(File, ReplacesTheOldContentAndLeavesNothingElse) {
  put(at("some"), "the old content, longer");
  ASSERT_TRUE(write_file_atomically(at("some"), "the new content"));
  EXPECT_EQ(content_of(at("some")), "the new content");
  EXPECT_EQ(entries_in(folder_.path()), 1U);
}

TEST_F(File, WritesWhatOthersMayRead) {
  ASSERT_TRUE(write_file_atomically(at("some"), "x"));
  using std::filesystem::perms;
  const perms rights = std::filesystem::status(at("some")).permissions();
  EXPECT_EQ(rights & perms::others_read, perms::others_read);
  EXPECT_EQ(rights & perms::others_write, perms::none);
}

TEST_F(File, CannotWriteIntoAMissingFolder) {
  const auto result = write_file_atomically(at("none") / "some", "x");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kFileUnwritable);
  EXPECT_EQ(result.error().place, (at("none") / "some").string());
  EXPECT_EQ(entries_in(folder_.path()), 0U);
}

TEST_F(File, LeavesAFolderOfTheSameNameAlone) {
  std::filesystem::create_directory(at("taken"));
  put(at("taken") / "inside", "kept");
  const auto result = write_file_atomically(at("taken"), "x");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kFileUnwritable);
  EXPECT_EQ(content_of(at("taken") / "inside"), "kept");
  EXPECT_EQ(entries_in(folder_.path()), 1U) << "a temporary was left behind";
}

TEST_F(File, MapsTheBytesUntilTheObjectGoes) {
  put(at("some"), "mapped bytes");
  auto mapped = MemoryMappedFile::open(at("some"));
  ASSERT_TRUE(mapped);
  std::filesystem::remove(at("some"));
  EXPECT_EQ(text_of(mapped->bytes()), "mapped bytes");

  const MemoryMappedFile moved = std::move(*mapped);
  EXPECT_EQ(text_of(moved.bytes()), "mapped bytes");
}

TEST_F(File, AssignsOneMappingOverAnother) {
  put(at("first"), "first");
  put(at("second"), "second one");
  auto first = MemoryMappedFile::open(at("first"));
  auto second = MemoryMappedFile::open(at("second"));
  ASSERT_TRUE(first && second);
  *first = std::move(*second);
  EXPECT_EQ(text_of(first->bytes()), "second one");
}

TEST_F(File, MapsAnEmptyFileAsNothing) {
  put(at("empty"), "");
  const auto mapped = MemoryMappedFile::open(at("empty"));
  ASSERT_TRUE(mapped);
  EXPECT_TRUE(mapped->bytes().empty());
}

TEST_F(File, MapsNeitherMissingFilesNorFolders) {
  const auto missing = MemoryMappedFile::open(at("none"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kFileNotFound);
  const auto folder = MemoryMappedFile::open(folder_.path());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ErrorCode::kFileUnreadable);
}

}  // namespace
}  // namespace waylode::core
