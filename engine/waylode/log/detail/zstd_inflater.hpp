// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/log/detail/byte_stream.hpp"

struct ZSTD_DCtx_s;

namespace waylode::log::detail {

/// Passes bytes on, decompressed if they start with a Zstandard frame. Memory is bounded by the
/// format's default window of 128 MiB; a frame that needs more counts as damaged.
class ZstdInflater {
 public:
  /// False when nothing more is wanted: the sink said so, or the data is damaged.
  bool feed(std::string_view bytes, const ChunkSink& sink);
  bool finish(const ChunkSink& sink);
  /// Set once the compressed data is found damaged, or by finish() if it ends inside a frame.
  const std::optional<std::string>& trouble() const { return trouble_; }

 private:
  struct ContextDeleter {
    void operator()(ZSTD_DCtx_s* context) const;
  };
  bool decide(const ChunkSink& sink);
  bool inflate(std::string_view bytes, const ChunkSink& sink);

  enum class Kind : std::uint8_t { kUndecided, kPlain, kZstd };
  Kind kind_ = Kind::kUndecided;
  std::string head_;
  std::unique_ptr<ZSTD_DCtx_s, ContextDeleter> context_;
  std::vector<char> buffer_;
  bool inside_frame_ = false;
  std::uint64_t compressed_bytes_ = 0;
  std::optional<std::string> trouble_;
};

}  // namespace waylode::log::detail
