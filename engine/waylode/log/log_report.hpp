// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "waylode/sample/sample.hpp"

namespace waylode::log {

enum class LogFormat : std::uint8_t { kIlc, kGetSensorData, kMcap };

constexpr const char* to_string(LogFormat format) {
  switch (format) {
    case LogFormat::kIlc:
      return "ilc";
    case LogFormat::kGetSensorData:
      return "getsensordata";
    case LogFormat::kMcap:
      break;
  }
  return "mcap";
}

/// What was read, and what was not and why. Nothing is repaired in silence.
struct LogReport {
  LogFormat format = LogFormat::kIlc;
  sample::RecordingInfo info;
  std::uint64_t bytes_read = 0;                   ///< After decompression.
  std::map<std::string, std::uint64_t> accepted;  ///< Samples by kind, as sample::kind_of names it.
  std::map<std::string, std::uint64_t> ignored;   ///< Well-formed records of kinds we do not use.
  std::map<std::string, std::uint64_t> rejected;  ///< Bad records by reason.
  std::uint64_t recovered_run_on = 0;             ///< Records split off a line that held two.
  std::optional<std::string> truncated;           ///< Where and how the file ends too early.

  std::uint64_t rejected_total() const {
    std::uint64_t total = 0;
    for (const auto& [reason, count] : rejected) total += count;
    return total;
  }
  bool operator==(const LogReport&) const = default;
};

}  // namespace waylode::log
