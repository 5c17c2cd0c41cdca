// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/atomic_file_writer.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <iterator>

#include "test_support.hpp"
#include "waylode/core/file.hpp"

namespace waylode::core {
namespace {

std::size_t files_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator entries(folder);
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

/// While it lives no file grows beyond `size_bytes`: a full disk, as far as a writer can tell.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t size_bytes) : previous_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &previous_limit_);
    rlimit limit = previous_limit_;
    limit.rlim_cur = size_bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &previous_limit_);
    std::signal(SIGXFSZ, previous_handler_);
  }

 private:
  void (*previous_handler_)(int);
  rlimit previous_limit_{};
};

TEST(AtomicFileWriter, ShowsNothingUntilCommitted) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "log";
  auto writer = AtomicFileWriter::create(path);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write("first "));
  ASSERT_TRUE(writer->write("second"));
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(writer->commit());
  EXPECT_EQ(read_file(path).value(), "first second");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(AtomicFileWriter, LeavesTheOldFileWhenAbandoned) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "log";
  ASSERT_TRUE(write_file_atomically(path, "old"));
  {
    ASSERT_TRUE(AtomicFileWriter::create(path)->write("half of the new"));
  }
  EXPECT_EQ(read_file(path).value(), "old");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(AtomicFileWriter, LeavesTheOldFileWhenTheDiskIsFull) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "log";
  ASSERT_TRUE(write_file_atomically(path, "old"));
  const FileSizeLimit limit(1000);
  auto writer = AtomicFileWriter::create(path);
  ASSERT_TRUE(writer);
  const Result<void> written = writer->write(std::string(2000, 'x'));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kFileUnwritable);
  EXPECT_EQ(written.error().place, path.string());
  EXPECT_FALSE(writer->write("more"));
  EXPECT_FALSE(writer->commit());
  EXPECT_EQ(read_file(path).value(), "old");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(AtomicFileWriter, MovesWithItsFile) {
  const test::TemporaryFolder folder;
  auto first = AtomicFileWriter::create(folder.path() / "a");
  auto second = AtomicFileWriter::create(folder.path() / "b");
  ASSERT_TRUE(first && second && first->write("a") && second->write("b"));
  *first = std::move(*second);
  ASSERT_TRUE(first->commit());
  EXPECT_EQ(read_file(folder.path() / "b").value(), "b");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a"));
}

TEST(AtomicFileWriter, SaysThatAFolderIsMissing) {
  const test::TemporaryFolder folder;
  const auto writer = AtomicFileWriter::create(folder.path() / "missing" / "log");
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::kFileUnwritable);
}

}  // namespace
}  // namespace waylode::core
