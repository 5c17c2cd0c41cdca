// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/mcap_writer.hpp"

#include <zstd.h>

#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "waylode/core/atomic_file_writer.hpp"
#include "waylode/log/detail/mcap_bytes.hpp"
#include "waylode/log/detail/mcap_summary.hpp"
#include "waylode/log/detail/sample_codec.hpp"
#include "waylode/log/detail/utf8.hpp"

namespace waylode::log {
namespace {

constexpr std::size_t kMaxMessageBytes = std::size_t{16} << 20U;

using core::ErrorCode;
using detail::Opcode;
using detail::put;
using sample::RecordingInfo;

/// Maps device time to MCAP's unsigned log time. With a known start the first sample written stands
/// for it; what would fall before zero is zero.
class LogClock {
 public:
  explicit LogClock(const std::optional<core::UtcTime>& start_utc) : start_utc_(start_utc) {}

  std::uint64_t log_time_ns(core::DeviceTime time) {
    const std::int64_t device_ns = time.time_since_epoch().count();
    if (!first_ns_) first_ns_ = device_ns;
    std::int64_t log_ns = device_ns;
    if (start_utc_) {
      std::int64_t elapsed_ns = 0;
      const bool overflow =
          __builtin_sub_overflow(device_ns, *first_ns_, &elapsed_ns) ||
          __builtin_add_overflow(start_utc_->time_since_epoch().count(), elapsed_ns, &log_ns);
      constexpr std::int64_t kLatest_ns = std::numeric_limits<std::int64_t>::max();
      if (overflow) log_ns = device_ns < *first_ns_ ? 0 : kLatest_ns;
    }
    return log_ns < 0 ? 0 : static_cast<std::uint64_t>(log_ns);
  }

 private:
  std::optional<core::UtcTime> start_utc_;
  std::optional<std::int64_t> first_ns_;
};

/// The records of the chunk being filled, and the places of its messages.
struct OpenChunk {
  std::string records;
  detail::TimeRange times;
  std::array<std::string, detail::kSampleKindCount> indexes;  ///< (log time, offset) by kind.
};

struct CompressorDeleter {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

detail::StringMap metadata_of(const RecordingInfo& info) {
  detail::StringMap map;
  const auto add = [&map](std::string_view key, std::string value) {
    if (!value.empty()) map.emplace(key, std::move(value));
  };
  add(detail::kVersionKey, std::string(detail::kSchemaVersion));
  add(detail::kBrandKey, info.device_brand);
  add(detail::kModelKey, info.device_model);
  add(detail::kSiteKey, info.site);
  add(detail::kFloorKey, info.floor);
  if (info.start_utc) {
    add(detail::kStartKey, std::to_string(info.start_utc->time_since_epoch().count()));
  }
  return map;
}

}  // namespace

core::Result<void> McapWriterOptions::validate() const {
  constexpr std::size_t kMaxChunkBytes = std::size_t{32} << 20U;
  if (chunk_size_bytes >= 1 && chunk_size_bytes <= kMaxChunkBytes) return {};
  return core::fail(ErrorCode::kInvalidOptions, "chunk_size_bytes must lie in [1, 33554432]");
}

class McapWriter::Impl {
 public:
  Impl(core::AtomicFileWriter&& file, const Options& options,
       const std::optional<core::UtcTime>& start_utc)
      : file_(std::move(file)), options_(options), clock_(start_utc) {}

  core::Result<void> begin(const RecordingInfo& info);
  core::Result<void> write(const sample::Sample& sample);
  core::Result<void> close();

 private:
  core::Result<void> flush_chunk();
  core::Result<void> append(std::string_view bytes);
  std::string_view packed_records();

  core::AtomicFileWriter file_;
  Options options_;
  LogClock clock_;
  OpenChunk chunk_;
  detail::McapSummary summary_;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;  ///< Of all bytes so far.
  std::unique_ptr<ZSTD_CCtx, CompressorDeleter> compressor_;
  std::string packed_;
  std::string message_;
  std::optional<core::Error> failure_;
};

core::Result<void> McapWriter::Impl::append(std::string_view bytes) {
  if (failure_) return tl::unexpected(*failure_);
  const core::Result<void> written = file_.write(bytes);
  if (!written) {
    failure_ = written.error();
    return written;
  }
  position_ += bytes.size();
  crc_ = detail::crc_of(bytes, crc_);
  return {};
}

core::Result<void> McapWriter::Impl::begin(const RecordingInfo& info) {
  std::string header;
  detail::put_string(header, detail::kProfile);
  detail::put_string(header, detail::kLibrary);
  std::string metadata;
  detail::put_string(metadata, detail::kRecordingName);
  detail::put_map(metadata, metadata_of(info));

  std::string bytes(detail::kMcapMagic);
  detail::put_record(bytes, Opcode::kHeader, header);
  const std::size_t start = bytes.size();
  detail::put_record(bytes, Opcode::kMetadata, metadata);
  summary_.metadata.push_back({std::string(detail::kRecordingName), start, bytes.size() - start});
  return append(bytes);
}

core::Result<void> McapWriter::Impl::write(const sample::Sample& sample) {
  if (failure_) return tl::unexpected(*failure_);
  if (const char* fault = detail::fault_of(sample)) {
    return core::fail(ErrorCode::kInvalidArgument, std::string(sample::kind_of(sample)) +
                                                       " sample cannot be logged (" + fault +
                                                       "); leave it out");
  }
  const std::size_t kind = sample.index();
  const auto channel = static_cast<std::uint16_t>(kind + 1);
  message_.clear();
  detail::encode_sample(sample, message_);
  if (message_.size() > kMaxMessageBytes) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "a sample of more than 16 MiB cannot be logged; leave it out");
  }

  // Every chunk declares what it uses, so that damage to one does not cost the others.
  if (chunk_.indexes[kind].empty()) {
    detail::put_schema(chunk_.records, channel);
    detail::put_channel(chunk_.records, channel);
  }
  const std::uint64_t log_time_ns = clock_.log_time_ns(sample::time_of(sample));
  chunk_.times.add(log_time_ns);
  put(chunk_.indexes[kind], log_time_ns);
  put(chunk_.indexes[kind], std::uint64_t{chunk_.records.size()});

  const std::uint64_t sequence = summary_.message_counts[channel]++;
  detail::put_record_prefix(chunk_.records, Opcode::kMessage,
                            detail::kMessagePrefixBytes + message_.size());
  put(chunk_.records, channel);
  put(chunk_.records, static_cast<std::uint32_t>(sequence));
  put(chunk_.records, log_time_ns);
  put(chunk_.records, log_time_ns);  // Published when logged.
  chunk_.records += message_;
  return chunk_.records.size() < options_.chunk_size_bytes ? core::Result<void>() : flush_chunk();
}

std::string_view McapWriter::Impl::packed_records() {
  if (options_.compression == McapCompression::kNone) return chunk_.records;
  if (!compressor_) compressor_.reset(ZSTD_createCCtx());
  packed_.resize(ZSTD_compressBound(chunk_.records.size()));
  const std::size_t size =
      ZSTD_compressCCtx(compressor_.get(), packed_.data(), packed_.size(), chunk_.records.data(),
                        chunk_.records.size(), ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(size) != 0U) throw std::bad_alloc();  // Nothing else can fail here.
  return std::string_view(packed_).substr(0, size);
}

core::Result<void> McapWriter::Impl::flush_chunk() {
  if (chunk_.records.empty()) return {};
  const std::string_view packed = packed_records();
  detail::ChunkEntry entry;
  entry.times = chunk_.times;
  entry.chunk_start = position_;
  entry.compression = options_.compression == McapCompression::kZstd ? detail::kZstd : "";
  entry.compressed_size = packed.size();
  entry.uncompressed_size = chunk_.records.size();

  std::string content;
  put(content, entry.times.start_ns);
  put(content, entry.times.end_ns);
  put(content, entry.uncompressed_size);
  put(content, detail::crc_of(chunk_.records));
  detail::put_string(content, entry.compression);
  put(content, entry.compressed_size);
  content += packed;
  std::string bytes;
  detail::put_record(bytes, Opcode::kChunk, content);
  entry.chunk_length = bytes.size();

  for (std::size_t kind = 0; kind < chunk_.indexes.size(); ++kind) {
    if (chunk_.indexes[kind].empty()) continue;
    const auto channel = static_cast<std::uint16_t>(kind + 1);
    entry.message_index_offsets[channel] = position_ + bytes.size();
    std::string index;
    put(index, channel);
    detail::put_string(index, chunk_.indexes[kind]);
    detail::put_record(bytes, Opcode::kMessageIndex, index);
  }
  entry.message_index_length = bytes.size() - entry.chunk_length;
  summary_.times.add(entry.times);
  summary_.chunks.push_back(std::move(entry));
  chunk_ = {};
  return append(bytes);
}

core::Result<void> McapWriter::Impl::close() {
  if (failure_) return tl::unexpected(*failure_);
  if (const auto flushed = flush_chunk(); !flushed) return flushed;
  std::string bytes;
  detail::put_record_prefix(bytes, Opcode::kDataEnd, sizeof(crc_));
  put(bytes, crc_);
  bytes += detail::encode_summary(summary_, position_ + bytes.size());
  if (const auto appended = append(bytes); !appended) return appended;
  const core::Result<void> committed = file_.commit();
  failure_ = committed ? core::Error{ErrorCode::kInvalidArgument, "the log is closed already", {}}
                       : committed.error();
  return committed;
}

core::Result<McapWriter> McapWriter::create(const std::filesystem::path& path,
                                            const RecordingInfo& info, const Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  for (const auto& [key, text] : metadata_of(info)) {
    if (!detail::is_utf8(text)) {
      return core::fail(ErrorCode::kInvalidArgument, "the recording's " + key + " is not UTF-8",
                        path.string());
    }
  }
  auto file = core::AtomicFileWriter::create(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  auto impl = std::make_unique<Impl>(std::move(*file), options, info.start_utc);
  if (const auto begun = impl->begin(info); !begun) return tl::unexpected(begun.error());
  return McapWriter(std::move(impl));
}

McapWriter::McapWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&&) noexcept = default;
McapWriter::~McapWriter() = default;

core::Result<void> McapWriter::write(const sample::Sample& sample) { return impl_->write(sample); }
core::Result<void> McapWriter::close() { return impl_->close(); }

}  // namespace waylode::log
