// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "waylode/core/result.hpp"

namespace waylode::cli {

inline constexpr std::size_t kLargestArchive_bytes = std::size_t{1} << 30;

/// The regular files of a tar or zip archive, plain or packed by zstd, gzip or xz: name within the
/// archive (no leading "./") to content. Links and folders are passed over; nothing is written.
/// kFileNotFound; kLogUnrecognised when it is no such archive or holds no file; kLogCorrupt when it
/// is cut short, damaged or has a name twice; kFileUnreadable when it unpacks to more than
/// `limit_bytes` in all.
core::Result<std::map<std::string, std::string>> read_archive(
    const std::filesystem::path& path, std::size_t limit_bytes = kLargestArchive_bytes);

}  // namespace waylode::cli
