// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/log_files.hpp"

#include <algorithm>
#include <string>
#include <system_error>

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;

tl::unexpected<core::Error> fail_listing(const fs::path& folder, const std::error_code& error) {
  const bool missing = error == std::errc::no_such_file_or_directory;
  return core::fail(
      missing ? core::ErrorCode::kFileNotFound : core::ErrorCode::kFileUnreadable,
      missing ? "no such folder; check the path" : "cannot list the folder: " + error.message(),
      folder.string());
}

}  // namespace

core::Result<FolderEntries> list_folder(const fs::path& folder) {
  FolderEntries entries;
  std::error_code error;
  fs::directory_iterator iterator(folder, error);
  for (; !error && iterator != fs::directory_iterator(); iterator.increment(error)) {
    std::error_code ignored;  // An entry that cannot be looked at is neither file nor folder.
    if (iterator->is_directory(ignored)) {
      entries.folders.push_back(iterator->path());
    } else if (iterator->is_regular_file(ignored)) {
      entries.files.push_back(iterator->path());
    }
  }
  if (error) return fail_listing(folder, error);
  std::ranges::sort(entries.folders);
  std::ranges::sort(entries.files);
  return entries;
}

std::vector<fs::path> text_logs(const std::vector<fs::path>& files) {
  std::vector<fs::path> logs;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (name.ends_with(".txt")) logs.push_back(file);
    if (!name.ends_with(".txt.zst")) continue;
    const fs::path plain = file.parent_path() / file.stem();
    if (!std::ranges::binary_search(files, plain)) logs.push_back(file);
  }
  return logs;
}

core::Result<std::vector<fs::path>> text_logs_below(const fs::path& folder) {
  std::vector<fs::path> logs;
  std::vector<fs::path> open = {folder};
  while (!open.empty()) {
    const fs::path next = open.back();
    open.pop_back();
    const auto entries = list_folder(next);
    if (!entries) return tl::unexpected(entries.error());
    const std::vector<fs::path> found = text_logs(entries->files);
    logs.insert(logs.end(), found.begin(), found.end());
    for (const fs::path& inner : entries->folders) {
      std::error_code ignored;
      if (!fs::is_symlink(inner, ignored)) open.push_back(inner);
    }
  }
  std::ranges::sort(logs);
  return logs;
}

}  // namespace waylode::cli
