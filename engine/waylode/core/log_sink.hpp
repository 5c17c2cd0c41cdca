// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace waylode::core {

enum class LogLevel : std::uint8_t { kDebug, kInfo, kWarning };

/// Where the engine says what it did. The caller prints, counts or drops it; the engine never does.
/// May be empty.
using LogSink =
    std::function<void(LogLevel level, std::string_view module, std::string_view message)>;

/// Progress of long work: `done` of `total` units. May be empty.
using ProgressSink = std::function<void(std::uint64_t done, std::uint64_t total)>;

}  // namespace waylode::core
