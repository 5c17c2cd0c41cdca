// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace waylode::site::detail {

// docs/site-bundle.md describes what these structures lay out. Numbers are little-endian and used
// in place.
static_assert(std::endian::native == std::endian::little, "bundles are used in place");

inline constexpr std::array<char, 8> kBundleMagic = {'W', 'L', 'S', 'I', 'T', 'E', '\0', '\1'};
inline constexpr std::size_t kSectionAlignment = 64;

struct BundleHeader {
  std::array<char, 8> magic = kBundleMagic;
  std::uint32_t format_version = 0;
  std::uint32_t section_count = 0;
  std::uint64_t file_size = 0;
  std::uint64_t content_hash = 0;  ///< FNV-1a of everything after the header; never 0.
  std::uint32_t content_crc = 0;   ///< CRC-32 of the same bytes.
  std::uint32_t header_crc = 0;    ///< CRC-32 of this header with this field 0.
  std::array<char, 24> reserved{};
};
static_assert(sizeof(BundleHeader) == 64);

/// One row of the table that follows the header.
struct SectionEntry {
  std::array<char, 32> name{};  ///< Filled up with zeros.
  std::uint64_t offset = 0;     ///< From the start of the file, a multiple of kSectionAlignment.
  std::uint64_t size = 0;       ///< Bytes.
  std::array<char, 16> reserved{};
};
static_assert(sizeof(SectionEntry) == 64);

inline constexpr std::string_view kSiteSection = "site.json";
inline constexpr std::string_view kFingerprintSection = "radio.fingerprints";
inline constexpr std::string_view kTransmitterSection = "radio.transmitters";
inline constexpr std::string_view kPostingBeginSection = "radio.posting_begin";
inline constexpr std::string_view kPostingSection = "radio.postings";
inline constexpr std::string_view kMagneticSection = "magnetic.points";  ///< May be missing.

std::uint32_t header_crc(BundleHeader header);

}  // namespace waylode::site::detail
