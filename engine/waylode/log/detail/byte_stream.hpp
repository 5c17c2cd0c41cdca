// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"

namespace waylode::log::detail {

/// Receives consecutive pieces of a file; returns false when it wants no more.
using ChunkSink = std::function<bool(std::string_view)>;

/// What was wrong with the compressed data; what came before it has been delivered.
using StreamTrouble = std::optional<std::string>;

/// Streams a file, decompressed if its content is Zstandard, in bounded memory.
/// kFileNotFound or kFileUnreadable when it cannot be opened or read.
core::Result<StreamTrouble> stream_file(const std::filesystem::path& path, const ChunkSink& sink);

/// The same from memory.
StreamTrouble stream_bytes(std::string_view bytes, const ChunkSink& sink);

}  // namespace waylode::log::detail
