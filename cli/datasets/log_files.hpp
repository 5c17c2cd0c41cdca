// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "waylode/core/result.hpp"

namespace waylode::cli {

struct FolderEntries {
  std::vector<std::filesystem::path> folders;  ///< By name; links to folders among them.
  std::vector<std::filesystem::path> files;    ///< By name; regular files only.
};

/// What is in a folder. kFileNotFound, or kFileUnreadable when it cannot be listed.
core::Result<FolderEntries> list_folder(const std::filesystem::path& folder);

/// The files among `files`, sorted, that are logs by name (*.txt, *.txt.zst). Of a log that is
/// there plain and packed, only the plain file.
std::vector<std::filesystem::path> text_logs(const std::vector<std::filesystem::path>& files);

/// The same from `folder` and all folders below it; links to folders are not followed.
core::Result<std::vector<std::filesystem::path>> text_logs_below(
    const std::filesystem::path& folder);

}  // namespace waylode::cli
