// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/mcap_writer.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>

#include "test_support.hpp"
#include "waylode/core/file.hpp"
#include "waylode/log/detail/mcap_bytes.hpp"
#include "waylode/log/test_samples.hpp"

namespace waylode::log {
namespace {

using core::DeviceTime;
using core::Duration;
using core::ErrorCode;
using detail::ByteReader;
using detail::Opcode;
using sample::BarometerSample;
using sample::RecordingInfo;
using waylode::test::TemporaryFolder;

std::string write_all(const std::vector<sample::Sample>& samples, const RecordingInfo& info,
                      const McapWriterOptions& options = {}) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "log.mcap";
  auto writer = McapWriter::create(path, info, options);
  EXPECT_TRUE(writer);
  for (const sample::Sample& sample : samples) EXPECT_TRUE(writer->write(sample));
  EXPECT_TRUE(writer->close());
  return core::read_file(path).value();
}

struct Record {
  std::size_t start = 0;
  std::string content;
};

/// The records of one kind on the file's top level, by a walk of lengths alone.
std::vector<Record> records_of(const std::string& file, Opcode wanted) {
  std::vector<Record> records;
  std::size_t at = detail::kMcapMagic.size();
  while (at + detail::kRecordPrefixBytes <= file.size() - detail::kMcapMagic.size()) {
    ByteReader prefix(std::string_view(file).substr(at));
    const auto opcode = prefix.take<std::uint8_t>();
    const auto length = prefix.take<std::uint64_t>();
    if (opcode == static_cast<std::uint8_t>(wanted)) {
      records.push_back({at, file.substr(at + detail::kRecordPrefixBytes, *length)});
    }
    at += detail::kRecordPrefixBytes + *length;
  }
  return records;
}

/// Log times in the order of the first chunk's index of the channel.
std::vector<std::uint64_t> log_times(const std::string& file) {
  std::vector<std::uint64_t> times;
  const Record record = records_of(file, Opcode::kMessageIndex).at(0);
  ByteReader index(record.content);
  index.take<std::uint16_t>();
  for (ByteReader entries(*index.take_string()); !entries.rest().empty();) {
    times.push_back(*entries.take<std::uint64_t>());
    entries.take<std::uint64_t>();
  }
  return times;
}

BarometerSample pressure_at(std::int64_t time_ns) {
  return {DeviceTime(Duration(time_ns)), 1000.0};
}

TEST(McapWriter, GivesTheSameBytesForTheSameCalls) {
  core::Rng rng(5);
  const auto samples = test::random_samples(rng, 500);
  const auto info = test::sample_recording_info();
  EXPECT_EQ(write_all(samples, info), write_all(samples, info));
}

TEST(McapWriter, StartsAndEndsWithTheMagicOfMcap) {
  const std::string file = write_all({}, {});
  const std::string magic("\x89MCAP0\r\n");
  EXPECT_TRUE(file.starts_with(magic));
  EXPECT_TRUE(file.ends_with(magic));
}

TEST(McapWriter, ClosesAChunkWhenItIsFull) {
  const std::vector<sample::Sample> samples(100, pressure_at(1));
  McapWriterOptions options;
  options.chunk_size_bytes = 1;
  EXPECT_EQ(records_of(write_all(samples, {}, options), Opcode::kChunk).size(), 100U);
  EXPECT_EQ(records_of(write_all(samples, {}), Opcode::kChunk).size(), 1U);
}

TEST(McapWriter, ChecksumsTheDataSectionAndTheSummary) {
  const std::string file = write_all(test::one_of_each(), {});
  const Record data_end = records_of(file, Opcode::kDataEnd).at(0);
  EXPECT_EQ(ByteReader(data_end.content).take<std::uint32_t>(),
            detail::crc_of(file.substr(0, data_end.start)));
  const Record footer = records_of(file, Opcode::kFooter).at(0);
  ByteReader reader(footer.content);
  const auto summary_start = reader.take<std::uint64_t>();
  EXPECT_EQ(summary_start, data_end.start + detail::kRecordPrefixBytes + 4);
  reader.take<std::uint64_t>();
  const std::size_t crc_start = footer.start + detail::kRecordPrefixBytes + 16;
  EXPECT_EQ(reader.take<std::uint32_t>(),
            detail::crc_of(file.substr(*summary_start, crc_start - *summary_start)));
}

TEST(McapWriter, IndexesEveryChunk) {
  McapWriterOptions options;
  options.chunk_size_bytes = 1;
  const std::string file = write_all({pressure_at(7), pressure_at(9)}, {}, options);
  const auto chunks = records_of(file, Opcode::kChunk);
  const auto indexes = records_of(file, Opcode::kChunkIndex);
  ASSERT_EQ(chunks.size(), 2U);
  ASSERT_EQ(indexes.size(), 2U);
  ByteReader index(indexes[1].content);
  EXPECT_EQ(index.take<std::uint64_t>(), 9U);
  EXPECT_EQ(index.take<std::uint64_t>(), 9U);
  EXPECT_EQ(index.take<std::uint64_t>(), chunks[1].start);
  EXPECT_EQ(index.take<std::uint64_t>(), detail::kRecordPrefixBytes + chunks[1].content.size());
}

TEST(McapWriter, LogsDeviceTimeWhenTheStartIsNotKnown) {
  const std::string file = write_all({pressure_at(50), pressure_at(-3), pressure_at(70)}, {});
  EXPECT_EQ(log_times(file), (std::vector<std::uint64_t>{50, 0, 70}));
}

TEST(McapWriter, LogsUniversalTimeWhenTheStartIsKnown) {
  RecordingInfo info;
  info.start_utc = core::UtcTime(Duration(1000));
  const std::string file = write_all({pressure_at(50), pressure_at(-3), pressure_at(-5000)}, info);
  EXPECT_EQ(log_times(file), (std::vector<std::uint64_t>{1000, 947, 0}));
}

TEST(McapWriter, HoldsLogTimeWithinItsRange) {
  RecordingInfo info;
  info.start_utc = core::UtcTime(Duration(1000));
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  const std::string rising = write_all({pressure_at(kMin), pressure_at(kMax)}, info);
  EXPECT_EQ(log_times(rising), (std::vector<std::uint64_t>{1000, std::uint64_t{kMax}}));
  const std::string falling = write_all({pressure_at(kMax), pressure_at(kMin)}, info);
  EXPECT_EQ(log_times(falling), (std::vector<std::uint64_t>{1000, 0}));
}

TEST(McapWriter, RefusesASampleNoReaderWouldTakeAndGoesOn) {
  const TemporaryFolder folder;
  auto writer = McapWriter::create(folder.path() / "log.mcap", {});
  ASSERT_TRUE(writer);
  const auto refused = writer->write(BarometerSample{{}, -1.0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(writer->write(pressure_at(1)));
  EXPECT_TRUE(writer->close());
}

TEST(McapWriter, TakesNothingAfterClosing) {
  const TemporaryFolder folder;
  auto writer = McapWriter::create(folder.path() / "log.mcap", {});
  ASSERT_TRUE(writer && writer->close());
  EXPECT_FALSE(writer->write(pressure_at(1)));
  EXPECT_FALSE(writer->close());
}

TEST(McapWriter, LeavesNothingBehindUnlessClosed) {
  const TemporaryFolder folder;
  {
    ASSERT_TRUE(McapWriter::create(folder.path() / "log.mcap", {})->write(pressure_at(1)));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(McapWriter, SaysWhyItCannotBegin) {
  const TemporaryFolder folder;
  const auto code = [&folder](const char* name, const RecordingInfo& info, std::size_t chunk) {
    McapWriterOptions options;
    options.chunk_size_bytes = chunk;
    const auto writer = McapWriter::create(folder.path() / name, info, options);
    return writer ? ErrorCode::kInternal : writer.error().code;
  };
  RecordingInfo bad_text;
  bad_text.site = "\xFF";
  EXPECT_EQ(code("no folder/log.mcap", {}, 1000), ErrorCode::kFileUnwritable);
  EXPECT_EQ(code("log.mcap", bad_text, 1000), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code("log.mcap", {}, 0), ErrorCode::kInvalidOptions);
  EXPECT_EQ(code("log.mcap", {}, std::size_t{1} << 30U), ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace waylode::log
