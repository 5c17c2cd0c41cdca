// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <filesystem>
#include <system_error>

#include "command.hpp"
#include "waylode/core/file.hpp"

namespace waylode::cli {

core::Result<void> write_output(const std::optional<std::string>& path, std::string_view text) {
  if (!path) {
    print(text);
    return {};
  }
  if (auto replaceable = check_replaceable(*path); !replaceable) return replaceable;
  return core::write_file_atomically(*path, text);
}

core::Result<void> check_replaceable(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_regular_file(status)) return {};
  if (!std::filesystem::exists(status)) {
    const auto folder = std::filesystem::path(path).parent_path();
    if (folder.empty() || std::filesystem::is_directory(folder, ignored)) return {};
    return core::fail(core::ErrorCode::kFileUnwritable,
                      "its folder does not exist; make it or name another", path);
  }
  return core::fail(core::ErrorCode::kFileUnwritable,
                    "is a folder or a device; name a file to write", path);
}

}  // namespace waylode::cli
