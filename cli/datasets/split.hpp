// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"

namespace waylode::cli {

enum class Part { kTrain, kTest };

/// Which recordings train and which test, by key ("site/floor/trace" or a log's name).
using Split = std::map<std::string, Part>;

/// Reads a split table: CSV with a header that has `key_columns` and `split` (`train` or `test`) in
/// any order. Keys are the key columns joined by '/'. kTableInvalid names line and remedy.
core::Result<Split> read_split(const std::filesystem::path& path,
                               const std::vector<std::string>& key_columns);

/// A quarter of the keys as test, chosen by `seed`; the same for any order of `keys`.
Split random_split(std::vector<std::string> keys, std::uint64_t seed);

/// A log's name as splits use it: the file name without ".zst" and without ".txt" or ".mcap".
std::string recording_name(const std::filesystem::path& path);

}  // namespace waylode::cli
