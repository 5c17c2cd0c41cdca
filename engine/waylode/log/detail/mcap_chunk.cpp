// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/mcap_chunk.hpp"

#include <zstd.h>

#include <algorithm>
#include <new>

#include "waylode/log/detail/mcap_bytes.hpp"

namespace waylode::log::detail {

std::optional<ChunkView> parse_chunk(std::string_view content) {
  ByteReader reader(content);
  reader.take<std::uint64_t>();  // Start and end times; the messages have their own.
  reader.take<std::uint64_t>();
  const auto uncompressed_size = reader.take<std::uint64_t>();
  const auto crc = reader.take<std::uint32_t>();
  const auto compression = reader.take_string();
  const auto packed_size = reader.take<std::uint64_t>();
  if (!uncompressed_size || !crc || !compression || !packed_size) return std::nullopt;
  const std::size_t available = std::min<std::uint64_t>(*packed_size, reader.rest().size());
  return ChunkView{*uncompressed_size, *crc, *compression, *packed_size,
                   reader.rest().substr(0, available)};
}

void ChunkUnpacker::ContextDeleter::operator()(ZSTD_DCtx_s* context) const {
  ZSTD_freeDCtx(context);
}

tl::expected<std::string_view, const char*> ChunkUnpacker::unpack(const ChunkView& chunk) {
  const auto reject = [](const char* reason) { return tl::unexpected<const char*>(reason); };
  if (chunk.uncompressed_size > kMaxRecordBytes) return reject("record_too_large");
  const bool is_cut = chunk.packed.size() < chunk.packed_size;
  if (chunk.compression.empty()) {
    if (chunk.packed_size != chunk.uncompressed_size) return reject("bad_chunk");
    return chunk.packed;
  }
  if (chunk.compression != kZstd) return reject("unsupported_compression");
  if (!inflate(chunk)) return reject("bad_chunk");
  if (!is_cut && records_.size() != chunk.uncompressed_size) return reject("bad_chunk");
  return records_;
}

bool ChunkUnpacker::inflate(const ChunkView& chunk) {
  if (!context_) {
    context_.reset(ZSTD_createDCtx());
    if (!context_) throw std::bad_alloc();
    // A window larger than the largest chunk serves nothing but to exhaust the memory.
    constexpr int kWindowLog = 26;
    static_assert((std::uint64_t{1} << kWindowLog) == kMaxRecordBytes);
    ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kWindowLog);
  }
  ZSTD_DCtx_reset(context_.get(), ZSTD_reset_session_only);
  // The stated size may be a lie: memory grows with what really comes out.
  constexpr std::size_t kFirstBytes = 65536;
  records_.clear();
  ZSTD_inBuffer input{chunk.packed.data(), chunk.packed.size(), 0};
  std::size_t filled = 0;
  while (true) {
    if (filled == records_.size()) {
      const std::size_t wanted = std::max(kFirstBytes, 2 * filled);
      records_.resize(std::min<std::uint64_t>(wanted, chunk.uncompressed_size));
    }
    ZSTD_outBuffer output{records_.data(), records_.size(), filled};
    const std::size_t consumed_before = input.pos;
    const std::size_t state = ZSTD_decompressStream(context_.get(), &output, &input);
    if (ZSTD_isError(state) != 0U) return false;
    const bool progressed = output.pos != filled || input.pos != consumed_before;
    filled = output.pos;
    const bool wants_room = filled == records_.size() && filled < chunk.uncompressed_size;
    if (!progressed && !wants_room) break;
  }
  records_.resize(filled);
  return true;
}

}  // namespace waylode::log::detail
