// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace waylode::log::detail {

/// Span of log times; both zero while empty, as MCAP has it.
struct TimeRange {
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  bool empty = true;

  void add(std::uint64_t time_ns);
  void add(const TimeRange& other);
};

/// Where a chunk and its message indexes lie in the file.
struct ChunkEntry {
  TimeRange times;
  std::uint64_t chunk_start = 0;
  std::uint64_t chunk_length = 0;
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;  ///< By channel.
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct MetadataEntry {
  std::string name;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
};

/// What the end of a file tells about the rest of it. Channel and schema share their number.
struct McapSummary {
  std::map<std::uint16_t, std::uint64_t> message_counts;  ///< By channel.
  std::vector<ChunkEntry> chunks;
  std::vector<MetadataEntry> metadata;
  TimeRange times;
};

/// Appends the records that declare a kind of sample.
void put_schema(std::string& bytes, std::uint16_t channel);
void put_channel(std::string& bytes, std::uint16_t channel);

/// Everything after the data section: summary, summary offsets, footer and closing magic.
/// `summary_start` is its place in the file.
std::string encode_summary(const McapSummary& summary, std::uint64_t summary_start);

}  // namespace waylode::log::detail
