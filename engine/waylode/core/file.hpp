// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"

namespace waylode::core {

/// The whole file. kFileNotFound or kFileUnreadable otherwise.
Result<std::string> read_file(const std::filesystem::path& path);

/// Writes a sibling temporary file, syncs it and renames it over `path`, so that a reader sees the
/// old content or the new and never a part. On any failure (a full disk among them) the temporary
/// is removed, `path` is untouched and kFileUnwritable says why.
Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// A read-only view of a file, mapped while the object lives. Movable, not copyable.
class MemoryMappedFile {
 public:
  static Result<MemoryMappedFile> open(const std::filesystem::path& path);

  MemoryMappedFile(MemoryMappedFile&& other) noexcept;
  MemoryMappedFile& operator=(MemoryMappedFile&& other) noexcept;
  MemoryMappedFile(const MemoryMappedFile&) = delete;
  MemoryMappedFile& operator=(const MemoryMappedFile&) = delete;
  ~MemoryMappedFile();

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MemoryMappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> bytes_;
};

}  // namespace waylode::core
