// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/zstd_inflater.hpp"

#include <zstd.h>

#include <new>

namespace waylode::log::detail {
namespace {

constexpr std::string_view kFrameMagic = "\x28\xB5\x2F\xFD";
constexpr int kMaxWindowLog = 27;

}  // namespace

void ZstdInflater::ContextDeleter::operator()(ZSTD_DCtx_s* context) const {
  ZSTD_freeDCtx(context);
}

bool ZstdInflater::feed(std::string_view bytes, const ChunkSink& sink) {
  if (kind_ == Kind::kPlain) return bytes.empty() || sink(bytes);
  if (kind_ == Kind::kZstd) return inflate(bytes, sink);
  head_.append(bytes);
  return head_.size() < kFrameMagic.size() || decide(sink);
}

bool ZstdInflater::finish(const ChunkSink& sink) {
  if (kind_ == Kind::kUndecided) return head_.empty() || decide(sink);
  if (inside_frame_ && !trouble_) {
    trouble_ =
        "the compressed data ends inside a frame, after byte " + std::to_string(compressed_bytes_);
  }
  return !trouble_;
}

bool ZstdInflater::decide(const ChunkSink& sink) {
  const std::string head = std::move(head_);
  head_.clear();
  if (!head.starts_with(kFrameMagic)) {
    kind_ = Kind::kPlain;
    return sink(head);
  }
  kind_ = Kind::kZstd;
  context_.reset(ZSTD_createDCtx());
  if (context_ == nullptr) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kMaxWindowLog);
  buffer_.resize(ZSTD_DStreamOutSize());
  return inflate(head, sink);
}

bool ZstdInflater::inflate(std::string_view bytes, const ChunkSink& sink) {
  if (trouble_) return false;
  ZSTD_inBuffer input{bytes.data(), bytes.size(), 0};
  bool may_hold_more = false;
  while (input.pos < input.size || may_hold_more) {
    ZSTD_outBuffer output{buffer_.data(), buffer_.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context_.get(), &output, &input);
    if (ZSTD_isError(left) != 0U) {
      trouble_ = "the compressed data is damaged near byte " +
                 std::to_string(compressed_bytes_ + input.pos) + " (" + ZSTD_getErrorName(left) +
                 ")";
      return false;
    }
    inside_frame_ = left != 0;
    may_hold_more = inside_frame_ && output.pos == output.size;
    if (output.pos != 0 && !sink({buffer_.data(), output.pos})) return false;
  }
  compressed_bytes_ += bytes.size();
  return true;
}

}  // namespace waylode::log::detail
