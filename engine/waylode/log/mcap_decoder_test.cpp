// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/mcap_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_support.hpp"
#include "waylode/core/file.hpp"
#include "waylode/log/detail/mcap_bytes.hpp"
#include "waylode/log/detail/mcap_summary.hpp"
#include "waylode/log/detail/sample_codec.hpp"
#include "waylode/log/mcap_writer.hpp"
#include "waylode/log/test_samples.hpp"

namespace waylode::log {
namespace {

using detail::Opcode;
using detail::put;
using sample::Sample;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

struct Decoded {
  std::vector<Sample> samples;
  LogReport report;
  bool operator==(const Decoded&) const = default;
};

Decoded decode(std::string_view bytes, std::size_t piece_bytes = SIZE_MAX, bool check_crc = true) {
  Decoded decoded;
  const auto decoder = make_mcap_decoder(
      [&decoded](Sample&& sample) { decoded.samples.push_back(std::move(sample)); }, {check_crc});
  for (std::string_view rest = bytes; !rest.empty();) {
    decoder->feed(rest.substr(0, piece_bytes));
    rest.remove_prefix(std::min(piece_bytes, rest.size()));
  }
  decoder->finish();
  decoded.report = decoder->report();
  return decoded;
}

std::string encode(const std::vector<Sample>& samples, std::size_t chunk_size_bytes,
                   McapCompression compression = McapCompression::kZstd) {
  const waylode::test::TemporaryFolder folder;
  const auto path = folder.path() / "log.mcap";
  const McapWriterOptions options{compression, chunk_size_bytes};
  auto writer = McapWriter::create(path, test::sample_recording_info(), options);
  for (const Sample& sample : samples) EXPECT_TRUE(writer->write(sample));
  EXPECT_TRUE(writer->close());
  return core::read_file(path).value();
}

std::vector<Sample> many_samples(std::size_t count) {
  core::Rng rng(77);
  return test::random_samples(rng, count);
}

std::string record(Opcode opcode, std::string_view content) {
  std::string bytes;
  detail::put_record(bytes, opcode, content);
  return bytes;
}

std::string message(std::uint16_t channel, const Sample& sample) {
  std::string content;
  put(content, channel);
  content.append(detail::kMessagePrefixBytes - sizeof(channel), '\0');
  detail::encode_sample(sample, content);
  return record(Opcode::kMessage, content);
}

std::string declared(const Sample& sample) {
  std::string bytes;
  detail::put_schema(bytes, static_cast<std::uint16_t>(sample.index() + 1));
  detail::put_channel(bytes, static_cast<std::uint16_t>(sample.index() + 1));
  return bytes;
}

/// A file of hand-made records without summary or checksums.
std::string file_of(const std::string& records) {
  return std::string(detail::kMcapMagic) + record(Opcode::kHeader, std::string(8, '\0')) + records +
         record(Opcode::kDataEnd, std::string(4, '\0')) +
         record(Opcode::kFooter, std::string(20, '\0')) + std::string(detail::kMcapMagic);
}

std::string chunk(std::string_view compression, std::string_view records, std::uint64_t size) {
  std::string content(16, '\0');
  put(content, size);
  put(content, std::uint32_t{0});
  detail::put_string(content, compression);
  put(content, std::uint64_t{records.size()});
  return record(Opcode::kChunk, content + std::string(records));
}

const Sample kPressure = sample::BarometerSample{core::DeviceTime(core::Duration(5)), 987.5};
const std::string kPressureRecords = declared(kPressure) + message(8, kPressure);

TEST(McapDecoder, ReadsWhatTheWriterWrote) {
  const auto samples = many_samples(2000);
  for (const auto compression : {McapCompression::kNone, McapCompression::kZstd}) {
    const Decoded decoded = decode(encode(samples, 20'000, compression));
    EXPECT_EQ(decoded.samples, samples);
    EXPECT_EQ(decoded.report.info, test::sample_recording_info());
    EXPECT_EQ(decoded.report.format, LogFormat::kMcap);
    EXPECT_EQ(decoded.report.accepted.size(), detail::kSampleKindCount);
    EXPECT_THAT(decoded.report.rejected, IsEmpty());
    EXPECT_THAT(decoded.report.ignored, IsEmpty());
    EXPECT_EQ(decoded.report.truncated, std::nullopt);
  }
}

TEST(McapDecoder, GivesTheSameWhereverThePiecesEnd) {
  const std::string file = encode(many_samples(50), 3000) + "surplus";
  for (const std::string_view bytes :
       {std::string_view(file), std::string_view(file).substr(0, 4000)}) {
    const Decoded whole = decode(bytes);
    for (const std::size_t piece_bytes : {1, 7, 1000}) EXPECT_EQ(decode(bytes, piece_bytes), whole);
  }
}

TEST(McapDecoder, KeepsTheWholeMessagesOfAFileCutAnywhere) {
  const auto samples = many_samples(60);
  for (const auto compression : {McapCompression::kNone, McapCompression::kZstd}) {
    const std::string file = encode(samples, 4000, compression);
    std::size_t previous = 0;
    for (std::size_t size = 0; size < file.size(); size += 101) {
      const Decoded decoded = decode(std::string_view(file).substr(0, size));
      ASSERT_TRUE(decoded.report.truncated) << size;
      ASSERT_EQ(decoded.report.rejected_total(), 0U) << size;
      ASSERT_GE(decoded.samples.size(), previous) << size;
      ASSERT_TRUE(std::equal(decoded.samples.begin(), decoded.samples.end(), samples.begin()));
      previous = decoded.samples.size();
    }
    EXPECT_EQ(previous, samples.size());
  }
}

TEST(McapDecoder, KeepsMessagesOfAChunkThatIsCut) {
  const std::string file = encode({kPressure, kPressure}, 1'000'000, McapCompression::kNone);
  const std::string encoded = message(8, kPressure).substr(31);
  const std::size_t second = file.find(encoded, file.find(encoded) + 1);
  const Decoded decoded = decode(std::string_view(file).substr(0, second));
  EXPECT_THAT(decoded.samples, ElementsAre(kPressure));
  EXPECT_THAT(*decoded.report.truncated, testing::HasSubstr("inside a record"));
}

TEST(McapDecoder, RejectsTheMessagesOfAChunkWithAWrongChecksum) {
  std::string file = encode({kPressure, kPressure}, 1'000'000, McapCompression::kNone);
  const std::string encoded = message(8, kPressure).substr(31);
  file[file.find(encoded) + 3] ^= 1;
  const Decoded decoded = decode(file);
  EXPECT_THAT(decoded.samples, IsEmpty());
  EXPECT_THAT(decoded.report.rejected,
              ElementsAre(Pair("chunk_crc_mismatch", 2), Pair("data_crc_mismatch", 1)));
  const Decoded unchecked = decode(file, SIZE_MAX, false);
  EXPECT_EQ(unchecked.samples.size(), 2U);
  EXPECT_THAT(unchecked.report.rejected, IsEmpty());
}

TEST(McapDecoder, LosesNoOtherChunkToADamagedOne) {
  std::string file = encode({kPressure, kPressure}, 1);
  const std::size_t records = file.find("\x28\xB5\x2F\xFD");  // Of the first zstd frame.
  file[records] ^= 1;
  const Decoded decoded = decode(file);
  EXPECT_THAT(decoded.samples, ElementsAre(kPressure));
  EXPECT_THAT(decoded.report.rejected,
              ElementsAre(Pair("bad_chunk", 1), Pair("data_crc_mismatch", 1)));
}

TEST(McapDecoder, ChecksTheSummary) {
  std::string file = encode({kPressure}, 1000);
  file[file.size() - 8 - 4 - 1] ^= 1;  // The last octet before the checksum and the magic.
  EXPECT_THAT(decode(file).report.rejected, ElementsAre(Pair("summary_crc_mismatch", 1)));
}

TEST(McapDecoder, ReadsMessagesOutsideChunks) {
  const Decoded decoded = decode(file_of(kPressureRecords));
  EXPECT_THAT(decoded.samples, ElementsAre(kPressure));
  EXPECT_EQ(decoded.report.truncated, std::nullopt);
}

TEST(McapDecoder, PassesOverWhatItDoesNotKnow) {
  std::string foreign;
  put(foreign, std::uint16_t{70});
  detail::put_string(foreign, "somebody.Else");
  detail::put_string(foreign, "protobuf");
  detail::put_string(foreign, "");
  std::string channel;
  put(channel, std::uint16_t{9});
  put(channel, std::uint16_t{70});
  detail::put_string(channel, "/camera");
  detail::put_string(channel, "protobuf");
  detail::put_string(channel, "");
  const std::string later_opcode = record(static_cast<Opcode>(0x7A), "later");
  const Decoded decoded = decode(file_of(later_opcode + record(Opcode::kSchema, foreign) +
                                         record(Opcode::kChannel, channel) + message(9, kPressure) +
                                         message(500, kPressure) +
                                         record(Opcode::kAttachment, "x") + kPressureRecords));
  EXPECT_THAT(decoded.samples, ElementsAre(kPressure));
  EXPECT_THAT(decoded.report.rejected, IsEmpty());
  EXPECT_THAT(decoded.report.ignored,
              ElementsAre(Pair("attachment", 1), Pair("topic /camera", 1),
                          Pair("undeclared channel", 1), Pair("unknown record", 1)));
}

TEST(McapDecoder, RejectsChunksItCannotUnpack) {
  const std::uint64_t absurd = detail::kMaxRecordBytes + 1;
  const Decoded decoded =
      decode(file_of(chunk("lz4", "abc", 3) + chunk("", "abc", absurd) + chunk("", "abc", 2) +
                     chunk("zstd", "abc", 2) + kPressureRecords));
  EXPECT_THAT(decoded.samples, ElementsAre(kPressure));
  EXPECT_THAT(decoded.report.rejected,
              ElementsAre(Pair("bad_chunk", 2), Pair("record_too_large", 1),
                          Pair("unsupported_compression", 1)));
}

TEST(McapDecoder, RejectsBadMessagesByReason) {
  std::string no_message = message(8, kPressure);
  no_message.back() = '\x7F';  // Turns the pressure into a number far out of range.
  const Decoded decoded =
      decode(file_of(declared(kPressure) + no_message + record(Opcode::kMessage, "short") +
                     message(8, kPressure)));
  EXPECT_THAT(decoded.samples, ElementsAre(kPressure));
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair("bad_record", 1), Pair("out_of_range", 1)));
}

TEST(McapDecoder, RefusesRecordsOfAbsurdSize) {
  std::string bytes(detail::kMcapMagic);
  detail::put_record_prefix(bytes, Opcode::kMessage, detail::kMaxRecordBytes + 1);
  const Decoded decoded = decode(bytes + "the rest is missing");
  EXPECT_THAT(decoded.report.rejected, ElementsAre(Pair("record_too_large", 1)));
  EXPECT_TRUE(decoded.report.truncated);
}

TEST(McapDecoder, RefusesANewerMajorVersion) {
  const auto file_of_version = [](const char* version) {
    std::string metadata;
    detail::put_string(metadata, "waylode.recording");
    detail::put_map(metadata, {{"schema_version", version}, {"a later key", "x"}});
    return file_of(record(Opcode::kMetadata, metadata) + kPressureRecords);
  };
  EXPECT_THAT(decode(file_of_version("1.9")).samples, ElementsAre(kPressure));
  const Decoded newer = decode(file_of_version("2.0"));
  EXPECT_THAT(newer.samples, IsEmpty());
  EXPECT_THAT(newer.report.rejected, ElementsAre(Pair("newer_schema_version", 1)));
  EXPECT_THAT(decode(file_of_version("new")).report.rejected, ElementsAre(Pair("bad_metadata", 1)));
}

TEST(McapDecoder, SaysWhatIsNotMcap) {
  EXPECT_THAT(decode("neither fish nor fowl").report.rejected, ElementsAre(Pair("not_mcap", 1)));
  EXPECT_THAT(decode("\x89MCAP1\r\n").report.rejected, ElementsAre(Pair("unsupported_version", 1)));
  const Decoded zeros = decode(std::string(detail::kMcapMagic) + std::string(100, '\0'));
  EXPECT_THAT(zeros.report.rejected, ElementsAre(Pair("bad_framing", 1)));
  EXPECT_THAT(*zeros.report.truncated, testing::HasSubstr("at byte 8"));
}

}  // namespace
}  // namespace waylode::log
