// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"

namespace waylode::core {

/// Writes a file piece by piece into a sibling temporary, which `commit` syncs and renames over
/// `path`: a reader sees the old content or the new and never a part. Destroyed before `commit`, or
/// after any failure (a full disk among them), it removes the temporary and leaves `path` as it
/// was.
class AtomicFileWriter {
 public:
  /// kFileUnwritable, here and below.
  static Result<AtomicFileWriter> create(const std::filesystem::path& path);

  AtomicFileWriter(AtomicFileWriter&& other) noexcept;
  AtomicFileWriter& operator=(AtomicFileWriter&& other) noexcept;
  AtomicFileWriter(const AtomicFileWriter&) = delete;
  AtomicFileWriter& operator=(const AtomicFileWriter&) = delete;
  ~AtomicFileWriter();

  Result<void> write(std::string_view bytes);
  /// Nothing may be written afterwards.
  Result<void> commit();

 private:
  AtomicFileWriter(std::filesystem::path path, std::string temporary, int descriptor);
  void discard();
  Result<void> fail_and_discard(int error_number);

  std::filesystem::path path_;
  std::string temporary_;
  int descriptor_ = -1;  ///< -1: committed, failed or moved from.
};

}  // namespace waylode::core
