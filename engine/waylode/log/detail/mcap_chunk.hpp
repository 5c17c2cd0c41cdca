// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

struct ZSTD_DCtx_s;

namespace waylode::log::detail {

/// A Chunk record taken apart.
struct ChunkView {
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0 not told.
  std::string_view compression;
  std::uint64_t packed_size = 0;
  std::string_view packed;  ///< Shorter than packed_size when the file ends inside.
};

/// nullopt when the fields before the records are not whole.
std::optional<ChunkView> parse_chunk(std::string_view content);

/// Unpacks chunks one after the other, reusing its memory.
class ChunkUnpacker {
 public:
  /// The records, valid until the next call, or the reason for rejecting the chunk:
  /// "unsupported_compression", "record_too_large", "bad_chunk". Of a chunk that is cut short, what
  /// can be had. Does not look at the checksum.
  tl::expected<std::string_view, const char*> unpack(const ChunkView& chunk);

 private:
  struct ContextDeleter {
    void operator()(ZSTD_DCtx_s* context) const;
  };
  /// Fills records_ as far as the input goes; false when the data is damaged or does not fit.
  bool inflate(const ChunkView& chunk);

  std::unique_ptr<ZSTD_DCtx_s, ContextDeleter> context_;
  std::string records_;
};

}  // namespace waylode::log::detail
