// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/mcap_decoder.hpp"

#include <charconv>
#include <unordered_map>
#include <utility>

#include "waylode/log/detail/mcap_bytes.hpp"
#include "waylode/log/detail/mcap_chunk.hpp"
#include "waylode/log/detail/mcap_framing.hpp"
#include "waylode/log/detail/sample_codec.hpp"
#include "waylode/log/detail/tally.hpp"

namespace waylode::log {
namespace {

using detail::ByteReader;
using detail::McapFraming;
using detail::Opcode;

template <typename Integer>
std::optional<Integer> parse_decimal(std::string_view text) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(value) : std::nullopt;
}

/// What the report calls messages of a topic that is not ours.
std::string ignored_name(std::string_view topic) {
  constexpr std::size_t kMaxNameBytes = 64;
  const bool is_plain =
      topic.size() <= kMaxNameBytes && topic.find_first_not_of(
                                           "abcdefghijklmnopqrstuvwxyz0123456789"
                                           "ABCDEFGHIJKLMNOPQRSTUVWXYZ/_-.") == topic.npos;
  return is_plain && !topic.empty() ? "topic " + std::string(topic) : "other topic";
}

/// What the report calls a record that holds nothing for us; nullptr for a file's own scaffold.
const char* ignored_name(Opcode opcode) {
  if (opcode == Opcode::kAttachment) return "attachment";
  return opcode > Opcode::kDataEnd ? "unknown record" : nullptr;
}

struct Channel {
  std::optional<std::size_t> kind;  ///< nullopt: not one of ours.
  std::string ignored_name;
};

class McapDecoder final : public Decoder {
 public:
  McapDecoder(SampleSink sink, McapDecoderOptions options)
      : sink_(std::move(sink)), options_(options), framing_(handler()) {
    report_.format = LogFormat::kMcap;
  }

  void feed(std::string_view bytes) override {
    report_.bytes_read += bytes.size();
    framing_.feed(bytes);
  }
  void finish() override;
  const LogReport& report() const override { return report_; }

 private:
  McapFraming::Handler handler();
  bool is_wanted(Opcode opcode, std::uint64_t size);
  void take(Opcode opcode, std::string_view content, const McapFraming::Position& position);
  void take_metadata(std::string_view content);
  void take_info(const detail::StringMap& map);
  void take_schema(std::string_view content);
  void take_channel(std::string_view content);
  void take_message(std::string_view content);
  void take_chunk(std::string_view content, bool is_cut);
  void take_chunk_records(std::string_view records, bool is_cut);
  void reject_chunk_messages(std::string_view records);
  void check_data_end(std::string_view content, const McapFraming::Position& position);
  void check_footer(std::string_view content, const McapFraming::Position& position);

  SampleSink sink_;
  McapDecoderOptions options_;
  McapFraming framing_;
  LogReport report_;
  detail::Tally tally_;
  detail::ChunkUnpacker unpacker_;
  std::unordered_map<std::uint16_t, std::optional<std::size_t>> schema_kinds_;
  std::unordered_map<std::uint16_t, Channel> channels_;
  bool in_summary_ = false;
  bool is_newer_ = false;  ///< Of a schema version that is not ours to read.
};

McapFraming::Handler McapDecoder::handler() {
  return {
      [this](std::uint8_t opcode, std::uint64_t size) {
        return is_wanted(static_cast<Opcode>(opcode), size);
      },
      [this](std::uint8_t opcode, std::string_view content, const McapFraming::Position& position) {
        take(static_cast<Opcode>(opcode), content, position);
      },
      [this](const char* reason) { tally_.reject(reason); }};
}

bool McapDecoder::is_wanted(Opcode opcode, std::uint64_t size) {
  // The summary repeats what is known by then.
  if (in_summary_) return false;
  switch (opcode) {
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kMessage:
    case Opcode::kChunk:
    case Opcode::kMetadata:
    case Opcode::kDataEnd:
      if (size <= detail::kMaxRecordBytes) return true;
      tally_.reject("record_too_large");
      return false;
    default:
      if (const char* name = ignored_name(opcode)) tally_.ignore(name);
      return false;
  }
}

void McapDecoder::take(Opcode opcode, std::string_view content,
                       const McapFraming::Position& position) {
  switch (opcode) {
    case Opcode::kSchema:
      return take_schema(content);
    case Opcode::kChannel:
      return take_channel(content);
    case Opcode::kMessage:
      return take_message(content);
    case Opcode::kChunk:
      return take_chunk(content, false);
    case Opcode::kMetadata:
      return take_metadata(content);
    case Opcode::kDataEnd:
      return check_data_end(content, position);
    case Opcode::kFooter:
      return check_footer(content, position);
    default:
      return;
  }
}

void McapDecoder::take_metadata(std::string_view content) {
  ByteReader reader(content);
  const auto name = reader.take_string();
  const auto map = name ? reader.take_map() : std::nullopt;
  if (!map) return tally_.reject("bad_record");
  if (name == detail::kRecordingName) return take_info(*map);
  tally_.ignore("metadata");
}

void McapDecoder::take_info(const detail::StringMap& map) {
  const auto value = [&map](std::string_view key) {
    const auto found = map.find(std::string(key));
    return found == map.end() ? std::string() : found->second;
  };
  const std::string version = value(detail::kVersionKey);
  const auto major = parse_decimal<unsigned>(version.substr(0, version.find('.')));
  if (!major) return tally_.reject("bad_metadata");
  is_newer_ = *major > detail::kSchemaMajor;
  if (is_newer_) return;
  report_.info = {value(detail::kBrandKey), value(detail::kModelKey), value(detail::kSiteKey),
                  value(detail::kFloorKey), std::nullopt};
  const std::string start = value(detail::kStartKey);
  if (start.empty()) return;
  const auto start_ns = parse_decimal<std::int64_t>(start);
  if (!start_ns) return tally_.reject("bad_metadata");
  report_.info.start_utc = core::UtcTime(core::Duration(*start_ns));
}

void McapDecoder::take_schema(std::string_view content) {
  ByteReader reader(content);
  const auto id = reader.take<std::uint16_t>();
  const auto name = id ? reader.take_string() : std::nullopt;
  const auto encoding = name ? reader.take_string() : std::nullopt;
  if (!encoding || !reader.take_string()) return tally_.reject("bad_record");
  if (*id == 0) return;  // Invalid, to be ignored, says MCAP.
  const bool is_protobuf = *encoding == detail::kProtobuf;
  const auto kind = is_protobuf ? detail::kind_of_schema_name(*name) : std::nullopt;
  const auto [known, is_new] = schema_kinds_.emplace(*id, kind);
  if (!is_new && known->second != kind) tally_.reject("redefined_schema");
}

void McapDecoder::take_channel(std::string_view content) {
  ByteReader reader(content);
  const auto id = reader.take<std::uint16_t>();
  const auto schema = reader.take<std::uint16_t>();
  const auto topic = schema ? reader.take_string() : std::nullopt;
  const auto encoding = topic ? reader.take_string() : std::nullopt;
  if (!encoding || !reader.take_string()) return tally_.reject("bad_record");
  Channel channel{std::nullopt, ignored_name(*topic)};
  const auto known_schema = schema_kinds_.find(*schema);
  if (known_schema != schema_kinds_.end() && *encoding == detail::kProtobuf) {
    channel.kind = known_schema->second;
  }
  const auto [known, is_new] = channels_.try_emplace(*id, channel);
  if (!is_new && known->second.kind != channel.kind) tally_.reject("redefined_channel");
}

void McapDecoder::take_message(std::string_view content) {
  const auto id = ByteReader(content).take<std::uint16_t>();
  if (!id || content.size() < detail::kMessagePrefixBytes) return tally_.reject("bad_record");
  const auto channel = channels_.find(*id);
  if (channel == channels_.end()) return tally_.ignore("undeclared channel");
  const auto& [kind, name] = channel->second;
  if (!kind) return tally_.ignore(name);
  if (is_newer_) return tally_.reject("newer_schema_version");
  auto sample = detail::decode_sample(*kind, content.substr(detail::kMessagePrefixBytes));
  if (!sample) return tally_.reject(sample.error());
  tally_.accept(*kind);
  sink_(std::move(*sample));
}

void McapDecoder::take_chunk(std::string_view content, bool is_cut) {
  const auto chunk = detail::parse_chunk(content);
  if (!chunk) return is_cut ? void() : tally_.reject("bad_record");
  const bool lacks_bytes = chunk->packed.size() < chunk->packed_size;
  if (lacks_bytes && !is_cut) return tally_.reject("bad_chunk");
  const auto records = unpacker_.unpack(*chunk);
  if (!records) return tally_.reject(records.error());
  // Of a chunk that is cut the checksum cannot be known; its messages are checked one by one.
  const std::uint32_t crc = chunk->uncompressed_crc;
  if (options_.check_crc && !lacks_bytes && crc != 0 && detail::crc_of(*records) != crc) {
    return reject_chunk_messages(*records);
  }
  take_chunk_records(*records, lacks_bytes);
}

/// Calls take(opcode, content) for each whole record; false when the last one is not whole.
template <typename Take>
bool for_each_record(std::string_view records, const Take& take) {
  for (ByteReader reader(records); !reader.rest().empty();) {
    const auto opcode = reader.take<std::uint8_t>();
    const auto size = reader.take<std::uint64_t>();
    if (!size || *size > reader.rest().size()) return false;
    take(static_cast<Opcode>(*opcode), reader.rest().substr(0, *size));
    reader = ByteReader(reader.rest().substr(*size));
  }
  return true;
}

void McapDecoder::take_chunk_records(std::string_view records, bool is_cut) {
  const bool is_whole = for_each_record(records, [this](Opcode opcode, std::string_view content) {
    if (opcode == Opcode::kSchema) return take_schema(content);
    if (opcode == Opcode::kChannel) return take_channel(content);
    if (opcode == Opcode::kMessage) return take_message(content);
    if (opcode > Opcode::kDataEnd) return tally_.ignore("unknown record");
    tally_.reject("misplaced_record");
  });
  if (!is_whole && !is_cut) tally_.reject("bad_chunk");
}

void McapDecoder::reject_chunk_messages(std::string_view records) {
  bool has_messages = false;
  for_each_record(records, [this, &has_messages](Opcode opcode, std::string_view /*content*/) {
    if (opcode != Opcode::kMessage) return;
    tally_.reject("chunk_crc_mismatch");
    has_messages = true;
  });
  if (!has_messages) tally_.reject("chunk_crc_mismatch");
}

void McapDecoder::check_data_end(std::string_view content, const McapFraming::Position& position) {
  in_summary_ = true;
  const auto crc = ByteReader(content).take<std::uint32_t>();
  if (!crc) return tally_.reject("bad_record");
  const bool is_wrong = *crc != 0 && *crc != position.section_crc;
  if (options_.check_crc && is_wrong) tally_.reject("data_crc_mismatch");
}

void McapDecoder::check_footer(std::string_view content, const McapFraming::Position& position) {
  constexpr std::size_t kCrcPlace = 16;
  const auto crc = ByteReader(content.substr(kCrcPlace)).take<std::uint32_t>();
  // Without a DataEnd record nothing tells where the summary begins.
  if (!options_.check_crc || !in_summary_ || crc == 0U) return;
  std::string covered;
  detail::put_record_prefix(covered, Opcode::kFooter, detail::kFooterBytes);
  covered += content.substr(0, kCrcPlace);
  if (detail::crc_of(covered, position.section_crc) != crc) tally_.reject("summary_crc_mismatch");
}

void McapDecoder::finish() {
  const auto partial = framing_.partial();
  if (partial && partial->opcode == static_cast<std::uint8_t>(Opcode::kChunk)) {
    take_chunk(partial->content, true);
  }
  report_.truncated = framing_.shortage();
  tally_.write_to(report_);
}

}  // namespace

std::unique_ptr<Decoder> make_mcap_decoder(SampleSink sink, McapDecoderOptions options) {
  return std::make_unique<McapDecoder>(std::move(sink), options);
}

}  // namespace waylode::log
