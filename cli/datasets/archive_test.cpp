// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/archive.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "test_support.hpp"

namespace waylode::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
namespace fs = std::filesystem;

using Entries = std::vector<std::pair<std::string, std::string>>;

struct WriterDeleter {
  void operator()(::archive* writer) const { archive_write_free(writer); }
};
using Writer = std::unique_ptr<::archive, WriterDeleter>;

struct EntryDeleter {
  void operator()(::archive_entry* entry) const { archive_entry_free(entry); }
};

void write_entry(::archive* writer, const std::string& name, unsigned type,
                 const std::string& content) {
  const std::unique_ptr<::archive_entry, EntryDeleter> entry(archive_entry_new());
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_filetype(entry.get(), type);
  archive_entry_set_perm(entry.get(), 0644);
  if (type == AE_IFLNK) archive_entry_set_symlink(entry.get(), "elsewhere");
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
  ASSERT_EQ(archive_write_header(writer, entry.get()), ARCHIVE_OK);
  ASSERT_EQ(archive_write_data(writer, content.data(), content.size()),
            static_cast<la_ssize_t>(content.size()));
}

class Archive : public ::testing::Test {
 protected:
  /// A tar packed by zstd.
  void write(const Entries& entries) {
    const Writer writer(archive_write_new());
    ASSERT_EQ(archive_write_set_format_pax_restricted(writer.get()), ARCHIVE_OK);
    ASSERT_EQ(archive_write_add_filter_zstd(writer.get()), ARCHIVE_OK);
    ASSERT_EQ(archive_write_open_filename(writer.get(), path_.c_str()), ARCHIVE_OK);
    write_entry(writer.get(), "data/", AE_IFDIR, "");
    for (const auto& [name, content] : entries) write_entry(writer.get(), name, AE_IFREG, content);
    write_entry(writer.get(), "data/link", AE_IFLNK, "");
    ASSERT_EQ(archive_write_close(writer.get()), ARCHIVE_OK);
  }

  void write_raw(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }

  std::string raw() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void expect_refused(core::ErrorCode code, std::size_t limit_bytes = kLargestArchive_bytes) {
    const auto files = read_archive(path_, limit_bytes);
    ASSERT_FALSE(files);
    EXPECT_EQ(files.error().code, code) << to_string(files.error());
    EXPECT_THAT(files.error().place, HasSubstr(path_.string()));
  }

  test::TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "some.tar.zst";
};

TEST_F(Archive, GivesEveryFileByItsName) {
  const std::string binary("\0\xff\n", 3);
  write({{"./b.csv", "1,2\n"}, {"data/a/b.csv", ""}, {"data/z", binary}});
  const auto files = read_archive(path_);
  ASSERT_TRUE(files) << to_string(files.error());
  EXPECT_THAT(*files, ElementsAre(Pair("b.csv", "1,2\n"), Pair("data/a/b.csv", ""),
                                  Pair("data/z", binary)));
}

TEST_F(Archive, GivesFilesLongerThanABlock) {
  std::string content;
  for (int i = 0; i < 40'000; ++i) content += std::to_string(i) + "\n";
  write({{"long", content}});
  const auto files = read_archive(path_);
  ASSERT_TRUE(files) << to_string(files.error());
  EXPECT_EQ(files->at("long"), content);
}

TEST_F(Archive, AllowsItsLimitAndNotAByteMore) {
  write({{"a", "12345"}, {"b", "678"}});
  EXPECT_TRUE(read_archive(path_, 8));
  expect_refused(core::ErrorCode::kFileUnreadable, 7);
}

TEST_F(Archive, NamesTheFileThatIsThereTwice) {
  write({{"a", "1"}, {"./a", "2"}});
  expect_refused(core::ErrorCode::kLogCorrupt);
  EXPECT_THAT(read_archive(path_).error().place, ::testing::EndsWith("some.tar.zst:a"));
}

TEST_F(Archive, RefusesWhatIsCutShort) {
  std::string content;  // Digits of a multiplicative generator: they do not pack to nothing.
  for (unsigned value = 7; content.size() < 400'000;) {
    value = value * 1'664'525U + 1'013'904'223U;
    content += std::to_string(value);
  }
  write({{"a", content}});
  const std::string whole = raw();
  write_raw(whole.substr(0, whole.size() / 2));
  expect_refused(core::ErrorCode::kLogCorrupt);
}

TEST_F(Archive, RefusesWhatIsNoArchive) {
  write_raw("t_ns,left,right\n1,0,1\n");
  expect_refused(core::ErrorCode::kLogUnrecognised);
  write_raw("");
  expect_refused(core::ErrorCode::kLogUnrecognised);
}

TEST_F(Archive, RefusesAnArchiveWithoutFiles) {
  write({});
  expect_refused(core::ErrorCode::kLogUnrecognised);
}

TEST_F(Archive, RefusesWhatIsNotThereOrAFolder) {
  expect_refused(core::ErrorCode::kFileNotFound);
  const auto files = read_archive(folder_.path());
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, core::ErrorCode::kFileUnreadable);
}

}  // namespace
}  // namespace waylode::cli
