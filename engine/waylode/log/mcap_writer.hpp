// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::log {

enum class McapCompression : std::uint8_t { kNone, kZstd };

struct McapWriterOptions {
  McapCompression compression = McapCompression::kZstd;
  /// A chunk is closed when its records reach this size before compression: larger packs better,
  /// smaller loses less of a damaged file. In [1, 32 Mi].
  std::size_t chunk_size_bytes = std::size_t{1} << 20U;

  /// kInvalidOptions when a value is out of its range.
  core::Result<void> validate() const;
};

/// Writes samples as Waylode's own log: MCAP with Protobuf messages, as contract/log-format.md
/// says. The same calls give the same bytes. Samples may come in any order of time.
/// The file appears under its name when `close` succeeds; a writer that is destroyed before that,
/// or that has failed, leaves nothing behind.
class McapWriter {
 public:
  using Options = McapWriterOptions;

  /// kFileUnwritable; kInvalidOptions; kInvalidArgument when a text of `info` is not UTF-8.
  static core::Result<McapWriter> create(const std::filesystem::path& path,
                                         const sample::RecordingInfo& info,
                                         const Options& options = {});

  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;
  ~McapWriter();

  /// kInvalidArgument for a sample that no reader would accept (a value not finite or out of its
  /// range): it is left out and the writer goes on. kFileUnwritable ends the writer: every later
  /// call repeats it.
  core::Result<void> write(const sample::Sample& sample);

  /// Writes the index and gives the file its name. Nothing may be written afterwards.
  core::Result<void> close();

 private:
  class Impl;
  explicit McapWriter(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace waylode::log
