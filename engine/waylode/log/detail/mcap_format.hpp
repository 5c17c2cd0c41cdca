// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Numbers and names of the MCAP format (https://mcap.dev/spec) and of our use of it
/// (contract/log-format.md).
namespace waylode::log::detail {

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

inline constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
/// Opcode and length before every record's content.
inline constexpr std::size_t kRecordPrefixBytes = 9;
/// Channel, sequence, log time and publish time before a message's data.
inline constexpr std::size_t kMessagePrefixBytes = 22;
inline constexpr std::size_t kFooterBytes = 20;
/// A record to be looked into, and an unpacked chunk, is refused above this size.
inline constexpr std::uint64_t kMaxRecordBytes = std::uint64_t{64} << 20U;

inline constexpr std::string_view kProfile = "waylode";
inline constexpr std::string_view kLibrary = "waylode";
inline constexpr std::string_view kProtobuf = "protobuf";
inline constexpr std::string_view kZstd = "zstd";

/// The metadata record about the recording, and its keys.
inline constexpr std::string_view kRecordingName = "waylode.recording";
inline constexpr std::string_view kVersionKey = "schema_version";
inline constexpr std::string_view kBrandKey = "device_brand";
inline constexpr std::string_view kModelKey = "device_model";
inline constexpr std::string_view kSiteKey = "site";
inline constexpr std::string_view kFloorKey = "floor";
inline constexpr std::string_view kStartKey = "start_utc_ns";

/// Schema version "major.minor" of what we write; files of a newer major are refused.
inline constexpr std::string_view kSchemaVersion = "1.0";
inline constexpr unsigned kSchemaMajor = 1;

}  // namespace waylode::log::detail
