// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

#include "waylode/core/crc32.hpp"
#include "waylode/core/file.hpp"
#include "waylode/site/bundle.hpp"
#include "waylode/site/detail/bundle_layout.hpp"
#include "waylode/site/detail/site_json.hpp"

namespace waylode::site {
namespace {

using core::Result;
using detail::BundleHeader;
using detail::SectionEntry;

using Section = std::pair<std::string_view, std::string_view>;

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::size_t round_up_to_alignment(std::size_t size) {
  return (size + detail::kSectionAlignment - 1) / detail::kSectionAlignment *
         detail::kSectionAlignment;
}

std::uint64_t fnv1a_64(std::string_view bytes) {
  constexpr std::uint64_t kOffsetBasis = 0xCBF2'9CE4'8422'2325ULL;
  constexpr std::uint64_t kPrime = 0x0000'0100'0000'01B3ULL;
  std::uint64_t hash = kOffsetBasis;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return hash;
}

/// Header (still empty), table and sections, each where the table says.
std::string lay_out(std::span<const Section> sections) {
  std::string bytes(sizeof(BundleHeader) + sections.size() * sizeof(SectionEntry), '\0');
  std::size_t entry_at = sizeof(BundleHeader);
  for (const auto& [name, content] : sections) {
    bytes.resize(round_up_to_alignment(bytes.size()), '\0');
    SectionEntry entry;
    name.copy(entry.name.data(), entry.name.size() - 1);
    entry.offset = bytes.size();
    entry.size = content.size();
    std::memcpy(bytes.data() + entry_at, &entry, sizeof(entry));
    entry_at += sizeof(entry);
    bytes += content;
  }
  return bytes;
}

/// The oldest format that holds the site.
std::uint32_t format_version_of(const SiteParts& parts) {
  const bool has_passages = std::ranges::any_of(parts.floors, [](const Floor& floor) {
    return !floor.plan.doors.empty() || !floor.plan.connectors.empty();
  });
  return has_passages ? 2 : 1;
}

void seal(std::string& bytes, std::size_t section_count, std::uint32_t format_version) {
  const std::string_view content = std::string_view(bytes).substr(sizeof(BundleHeader));
  BundleHeader header;
  header.format_version = format_version;
  header.section_count = static_cast<std::uint32_t>(section_count);
  header.file_size = bytes.size();
  const std::uint64_t hash = fnv1a_64(content);
  header.content_hash = hash != 0 ? hash : 1;
  header.content_crc = core::crc32(std::as_bytes(std::span(content)));
  header.header_crc = detail::header_crc(header);
  std::memcpy(bytes.data(), &header, sizeof(header));
}

}  // namespace

Result<std::string> format_bundle(const SiteParts& parts) {
  const auto site_json = detail::format_site_json(parts);
  if (!site_json) return tl::unexpected(site_json.error());
  const RadioMapStorage& map = parts.radio_map;
  std::vector<Section> sections = {{detail::kSiteSection, *site_json},
                                   {detail::kFingerprintSection, bytes_of(map.fingerprints)},
                                   {detail::kTransmitterSection, bytes_of(map.transmitters)},
                                   {detail::kPostingBeginSection, bytes_of(map.posting_begin)},
                                   {detail::kPostingSection, bytes_of(map.postings)}};
  const std::vector<MagneticPoint>& field = parts.magnetic_map.points;
  if (!field.empty()) sections.emplace_back(detail::kMagneticSection, bytes_of(field));
  std::string bytes = lay_out(sections);
  seal(bytes, sections.size(), format_version_of(parts));
  // What cannot be loaded is not written.
  const auto loaded = parse_bundle(std::as_bytes(std::span(bytes)), nullptr, parts.name);
  if (!loaded) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the site cannot be stored: " + loaded.error().message, loaded.error().place);
  }
  return bytes;
}

Result<std::uint64_t> write_bundle(const SiteParts& parts, const std::filesystem::path& path) {
  const auto bytes = format_bundle(parts);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto written = core::write_file_atomically(path, *bytes);
  if (!written) return tl::unexpected(written.error());
  BundleHeader header;
  std::memcpy(&header, bytes->data(), sizeof(header));
  return header.content_hash;
}

}  // namespace waylode::site
