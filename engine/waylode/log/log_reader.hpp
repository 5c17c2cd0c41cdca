// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/log/log_report.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::log {

/// Receives samples in the order of the file; `collate` sorts them by time.
using SampleSink = std::function<void(sample::Sample&&)>;

/// Turns the bytes of one log into samples as they come. One decoder, one log.
/// feed(a); feed(b) gives what feed(a + b) gives, wherever the cut falls.
class Decoder {
 public:
  virtual ~Decoder() = default;
  virtual void feed(std::string_view bytes) = 0;
  /// No more bytes: flushes what is whole. The report is final afterwards.
  virtual void finish() = 0;
  virtual const LogReport& report() const = 0;
};

/// Reads a whole log of any known format, `.zst` or plain (told by content, never by the name).
/// Records that are bad are counted in the report; the call fails only when there is no log:
/// kFileNotFound, kFileUnreadable, kLogEmpty, kLogUnrecognised, kLogCorrupt.
core::Result<LogReport> read_log(const std::filesystem::path& path, const SampleSink& sink);

/// The same from memory; `name` stands in for the path in errors.
core::Result<LogReport> read_log_bytes(std::string_view bytes, std::string_view name,
                                       const SampleSink& sink);

struct Recording {
  LogReport report;
  std::vector<sample::Sample> samples;  ///< By time (stable), as collate orders them.
};

/// A whole log in memory, in order of time.
core::Result<Recording> load_recording(const std::filesystem::path& path);

}  // namespace waylode::log
