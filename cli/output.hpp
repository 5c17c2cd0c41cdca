// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"

namespace waylode::cli {

/// To standard output without a path, else atomically to the file (core::write_file_atomically).
core::Result<void> write_output(const std::optional<std::string>& path, std::string_view text);

/// kFileUnwritable when `path` exists and is no regular file: replacing a folder or a device by a
/// file is never meant. The same when the folder it would lie in does not exist. For writers that
/// replace what is there, and to know early that long work could not be kept.
core::Result<void> check_replaceable(const std::string& path);

}  // namespace waylode::cli
