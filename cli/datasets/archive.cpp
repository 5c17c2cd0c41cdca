// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/archive.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <array>
#include <memory>
#include <string_view>
#include <system_error>

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;
using core::ErrorCode;
using Files = std::map<std::string, std::string>;

struct ReaderDeleter {
  void operator()(::archive* reader) const { archive_read_free(reader); }
};
using Reader = std::unique_ptr<::archive, ReaderDeleter>;

std::string why(::archive* reader) {
  const char* text = archive_error_string(reader);
  return text != nullptr ? text : "no reason given";
}

core::Result<Reader> open(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    return core::fail(ErrorCode::kFileNotFound, "no such file; check the path", path.string());
  }
  if (!fs::is_regular_file(path, ignored)) {
    return core::fail(ErrorCode::kFileUnreadable, "not a file; name an archive", path.string());
  }
  Reader reader(archive_read_new());
  archive_read_support_filter_zstd(reader.get());
  archive_read_support_filter_gzip(reader.get());
  archive_read_support_filter_xz(reader.get());
  archive_read_support_format_tar(reader.get());
  archive_read_support_format_zip(reader.get());
  constexpr std::size_t kBlock_bytes = 1U << 16U;
  if (archive_read_open_filename(reader.get(), path.c_str(), kBlock_bytes) != ARCHIVE_OK) {
    return core::fail(ErrorCode::kLogUnrecognised,
                      "cannot open as an archive (" + why(reader.get()) + "); give a tar or zip",
                      path.string());
  }
  return reader;
}

core::Result<std::string> name_of(::archive_entry* entry, const fs::path& path) {
  const char* told = archive_entry_pathname(entry);
  if (told == nullptr) {
    return core::fail(ErrorCode::kLogCorrupt, "a file's name cannot be read; pack it anew",
                      path.string());
  }
  std::string_view name = told;
  while (name.starts_with("./")) name.remove_prefix(2);
  return std::string(name);
}

/// The content of the entry at hand; takes it off the bytes that are still allowed.
core::Result<std::string> take_content(::archive* reader, std::size_t& left_bytes,
                                       const std::string& place) {
  std::string content;
  std::array<char, 1U << 16U> block{};
  while (true) {
    const auto count = archive_read_data(reader, block.data(), block.size());
    if (count == 0) return content;
    if (count < 0) {
      return core::fail(ErrorCode::kLogCorrupt,
                        "the archive is damaged (" + why(reader) + "); fetch it anew", place);
    }
    const auto length = static_cast<std::size_t>(count);
    if (length > left_bytes) {
      return core::fail(ErrorCode::kFileUnreadable,
                        "the archive unpacks to more than is allowed; unpack it by hand", place);
    }
    left_bytes -= length;
    content.append(block.data(), length);
  }
}

core::Result<void> add_entry(::archive* reader, ::archive_entry* entry, const fs::path& path,
                             std::size_t& left_bytes, Files& files) {
  auto name = name_of(entry, path);
  if (!name) return tl::unexpected(name.error());
  const std::string place = path.string() + ":" + *name;
  auto content = take_content(reader, left_bytes, place);
  if (!content) return tl::unexpected(content.error());
  if (!files.emplace(*std::move(name), *std::move(content)).second) {
    return core::fail(ErrorCode::kLogCorrupt, "the file is there twice; pack it anew", place);
  }
  return {};
}

}  // namespace

core::Result<Files> read_archive(const fs::path& path, std::size_t limit_bytes) {
  const auto reader = open(path);
  if (!reader) return tl::unexpected(reader.error());
  Files files;
  std::size_t left_bytes = limit_bytes;
  ::archive_entry* entry = nullptr;
  int state = ARCHIVE_OK;
  while ((state = archive_read_next_header(reader->get(), &entry)) != ARCHIVE_EOF) {
    if (state < ARCHIVE_WARN) {
      const bool opened = archive_file_count(reader->get()) > 0;
      return core::fail(opened ? ErrorCode::kLogCorrupt : ErrorCode::kLogUnrecognised,
                        "cannot read on in the archive (" + why(reader->get()) + "); fetch it anew",
                        path.string());
    }
    const bool is_link = archive_entry_hardlink(entry) != nullptr;
    if (is_link || archive_entry_filetype(entry) != AE_IFREG) continue;
    const auto added = add_entry(reader->get(), entry, path, left_bytes, files);
    if (!added) return tl::unexpected(added.error());
  }
  if (files.empty()) {
    return core::fail(ErrorCode::kLogUnrecognised, "the archive holds no file; give another",
                      path.string());
  }
  return files;
}

}  // namespace waylode::cli
