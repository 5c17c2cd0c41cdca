// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/mcap_summary.hpp"

#include <algorithm>

#include "waylode/log/detail/mcap_bytes.hpp"
#include "waylode/log/detail/sample_codec.hpp"

namespace waylode::log::detail {
namespace {

void put_map(std::string& bytes, const std::map<std::uint16_t, std::uint64_t>& map) {
  constexpr std::size_t kEntryBytes = 10;
  put(bytes, static_cast<std::uint32_t>(map.size() * kEntryBytes));
  for (const auto& [key, value] : map) {
    put(bytes, key);
    put(bytes, value);
  }
}

void put_statistics(std::string& bytes, const McapSummary& summary) {
  std::uint64_t message_count = 0;
  for (const auto& [channel, count] : summary.message_counts) message_count += count;
  std::string content;
  put(content, message_count);
  put(content, static_cast<std::uint16_t>(summary.message_counts.size()));  // Schemas.
  put(content, static_cast<std::uint32_t>(summary.message_counts.size()));  // Channels.
  put(content, std::uint32_t{0});                                           // Attachments.
  put(content, static_cast<std::uint32_t>(summary.metadata.size()));
  put(content, static_cast<std::uint32_t>(summary.chunks.size()));
  put(content, summary.times.start_ns);
  put(content, summary.times.end_ns);
  put_map(content, summary.message_counts);
  put_record(bytes, Opcode::kStatistics, content);
}

void put_chunk_index(std::string& bytes, const ChunkEntry& chunk) {
  std::string content;
  put(content, chunk.times.start_ns);
  put(content, chunk.times.end_ns);
  put(content, chunk.chunk_start);
  put(content, chunk.chunk_length);
  put_map(content, chunk.message_index_offsets);
  put(content, chunk.message_index_length);
  put_string(content, chunk.compression);
  put(content, chunk.compressed_size);
  put(content, chunk.uncompressed_size);
  put_record(bytes, Opcode::kChunkIndex, content);
}

void put_metadata_index(std::string& bytes, const MetadataEntry& entry) {
  std::string content;
  put(content, entry.start);
  put(content, entry.length);
  put_string(content, entry.name);
  put_record(bytes, Opcode::kMetadataIndex, content);
}

void put_summary_offset(std::string& bytes, Opcode group, std::uint64_t start,
                        std::uint64_t length) {
  std::string content;
  put(content, static_cast<std::uint8_t>(group));
  put(content, start);
  put(content, length);
  put_record(bytes, Opcode::kSummaryOffset, content);
}

/// The summary's records of one opcode.
void put_group(std::string& bytes, Opcode opcode, const McapSummary& summary) {
  switch (opcode) {
    case Opcode::kSchema:
      for (const auto& [channel, count] : summary.message_counts) put_schema(bytes, channel);
      break;
    case Opcode::kChannel:
      for (const auto& [channel, count] : summary.message_counts) put_channel(bytes, channel);
      break;
    case Opcode::kStatistics:
      put_statistics(bytes, summary);
      break;
    case Opcode::kChunkIndex:
      for (const ChunkEntry& chunk : summary.chunks) put_chunk_index(bytes, chunk);
      break;
    case Opcode::kMetadataIndex:
      for (const MetadataEntry& entry : summary.metadata) put_metadata_index(bytes, entry);
      break;
    default:
      break;
  }
}

}  // namespace

void TimeRange::add(std::uint64_t time_ns) {
  start_ns = empty ? time_ns : std::min(start_ns, time_ns);
  end_ns = empty ? time_ns : std::max(end_ns, time_ns);
  empty = false;
}

void TimeRange::add(const TimeRange& other) {
  if (other.empty) return;
  add(other.start_ns);
  add(other.end_ns);
}

void put_schema(std::string& bytes, std::uint16_t channel) {
  const std::size_t kind = channel - 1U;
  std::string content;
  put(content, channel);
  put_string(content, schema_name_of_kind(kind));
  put_string(content, kProtobuf);
  put_string(content, schema_of_kind(kind));
  put_record(bytes, Opcode::kSchema, content);
}

void put_channel(std::string& bytes, std::uint16_t channel) {
  std::string content;
  put(content, channel);
  put(content, channel);  // Its schema.
  put_string(content, topic_of_kind(channel - 1U));
  put_string(content, kProtobuf);
  put_map(content, StringMap{});
  put_record(bytes, Opcode::kChannel, content);
}

std::string encode_summary(const McapSummary& summary, std::uint64_t summary_start) {
  constexpr Opcode kGroups[] = {Opcode::kSchema, Opcode::kChannel, Opcode::kStatistics,
                                Opcode::kChunkIndex, Opcode::kMetadataIndex};
  std::string bytes;
  std::string offsets;
  for (const Opcode group : kGroups) {
    const std::size_t start = bytes.size();
    put_group(bytes, group, summary);
    const std::size_t length = bytes.size() - start;
    if (length > 0) put_summary_offset(offsets, group, summary_start + start, length);
  }
  const std::uint64_t offsets_start = summary_start + bytes.size();
  bytes += offsets;

  put_record_prefix(bytes, Opcode::kFooter, kFooterBytes);
  put(bytes, summary_start);
  put(bytes, offsets_start);
  put(bytes, crc_of(bytes));
  bytes += kMcapMagic;
  return bytes;
}

}  // namespace waylode::log::detail
