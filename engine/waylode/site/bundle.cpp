// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/bundle.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "waylode/core/crc32.hpp"
#include "waylode/core/file.hpp"
#include "waylode/site/detail/bundle_layout.hpp"
#include "waylode/site/detail/magnetic_map_check.hpp"
#include "waylode/site/detail/radio_map_check.hpp"
#include "waylode/site/detail/site_json.hpp"

namespace waylode::site {
namespace {

using core::Result;
using detail::BundleHeader;
using detail::SectionEntry;
using Bytes = std::span<const std::byte>;

tl::unexpected<core::Error> corrupt(std::string defect, std::string place) {
  return core::fail(core::ErrorCode::kBundleCorrupt,
                    std::move(defect) + "; build the site again with `waylode site build`",
                    std::move(place));
}

Result<BundleHeader> read_header(Bytes bytes, const std::string& place) {
  BundleHeader header;
  if (bytes.size() < sizeof(header)) return corrupt("too short to be a site bundle", place);
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.magic != detail::kBundleMagic) return corrupt("not a site bundle", place);
  if (header.header_crc != detail::header_crc(header)) {
    return corrupt("the header is damaged", place + " at byte 0");
  }
  if (header.format_version > kBundleFormatVersion) {
    return core::fail(core::ErrorCode::kBundleCorrupt,
                      "written in bundle format " + std::to_string(header.format_version) +
                          ", newer than the format " + std::to_string(kBundleFormatVersion) +
                          " this program knows; use a newer waylode",
                      place);
  }
  if (header.format_version < 1) {
    return corrupt("bundle format " + std::to_string(header.format_version) + " never existed",
                   place);
  }
  if (header.file_size != bytes.size()) {
    return corrupt("holds " + std::to_string(bytes.size()) + " bytes where its header says " +
                       std::to_string(header.file_size),
                   place);
  }
  return header;
}

/// Every section of the file, checked to lie within it, in order and aligned.
class SectionTable {
 public:
  static Result<SectionTable> read(Bytes bytes, std::size_t count, const std::string& place) {
    SectionTable table(bytes, place);
    if (count > (bytes.size() - sizeof(BundleHeader)) / sizeof(SectionEntry)) {
      return corrupt("the section table is cut short", place + " at byte 64");
    }
    std::uint64_t previous_end = sizeof(BundleHeader) + count * sizeof(SectionEntry);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t entry_at = sizeof(BundleHeader) + i * sizeof(SectionEntry);
      SectionEntry entry;
      std::memcpy(&entry, bytes.data() + entry_at, sizeof(entry));
      if (entry.offset % detail::kSectionAlignment != 0 || entry.offset < previous_end ||
          entry.offset > bytes.size() || entry.size > bytes.size() - entry.offset) {
        return corrupt("a section lies outside the file or is not aligned",
                       place + " at byte " + std::to_string(entry_at));
      }
      previous_end = entry.offset + entry.size;
      table.entries_.push_back(entry);
    }
    return table;
  }

  bool contains(std::string_view name) const { return entry_of(name) != nullptr; }

  Result<Bytes> find(std::string_view name) const {
    const SectionEntry* const entry = entry_of(name);
    if (entry == nullptr) return corrupt("section " + std::string(name) + " is missing", place_);
    return bytes_.subspan(entry->offset, entry->size);
  }

  /// The section as an array, in place.
  template <typename T>
  Result<std::span<const T>> find_array(std::string_view name) const {
    const auto section = find(name);
    if (!section) return tl::unexpected(section.error());
    if (section->size() % sizeof(T) != 0) {
      return corrupt("section " + std::string(name) + " ends within an entry", place_);
    }
    return std::span<const T>(reinterpret_cast<const T*>(section->data()),
                              section->size() / sizeof(T));
  }

 private:
  SectionTable(Bytes bytes, std::string place) : bytes_(bytes), place_(std::move(place)) {}

  const SectionEntry* entry_of(std::string_view name) const {
    for (const SectionEntry& entry : entries_) {
      const auto end = std::ranges::find(entry.name, '\0');
      if (std::string_view(entry.name.begin(), end) == name) return &entry;
    }
    return nullptr;
  }

  Bytes bytes_;
  std::string place_;
  std::vector<SectionEntry> entries_;
};

Result<RadioMap> read_radio_map(const SectionTable& table, std::size_t floor_count,
                                const std::string& place) {
  const auto fingerprints = table.find_array<FingerprintRecord>(detail::kFingerprintSection);
  if (!fingerprints) return tl::unexpected(fingerprints.error());
  const auto transmitters = table.find_array<std::uint64_t>(detail::kTransmitterSection);
  if (!transmitters) return tl::unexpected(transmitters.error());
  const auto posting_begin = table.find_array<std::uint32_t>(detail::kPostingBeginSection);
  if (!posting_begin) return tl::unexpected(posting_begin.error());
  const auto postings = table.find_array<Posting>(detail::kPostingSection);
  if (!postings) return tl::unexpected(postings.error());
  const RadioMap map{*fingerprints, *transmitters, *posting_begin, *postings};
  std::string defect = detail::defect_of(map, floor_count);
  if (!defect.empty()) return corrupt(std::move(defect), place);
  return map;
}

/// Bundles of sites whose field nobody surveyed have no such section.
Result<MagneticMap> read_magnetic_map(const SectionTable& table, std::size_t floor_count,
                                      const std::string& place) {
  if (!table.contains(detail::kMagneticSection)) return MagneticMap{};
  const auto points = table.find_array<MagneticPoint>(detail::kMagneticSection);
  if (!points) return tl::unexpected(points.error());
  const MagneticMap map{*points};
  std::string defect = detail::defect_of(map, floor_count);
  if (!defect.empty()) return corrupt(std::move(defect), place);
  return map;
}

}  // namespace

std::uint32_t detail::header_crc(BundleHeader header) {
  header.header_crc = 0;
  return core::crc32(std::as_bytes(std::span(&header, 1)));
}

Result<std::shared_ptr<const Site>> parse_bundle(Bytes bytes,
                                                 std::shared_ptr<const void> keep_alive,
                                                 std::string_view place) {
  const std::string place_text(place);
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(std::uint64_t) != 0) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the bundle is not aligned in memory; copy it to a multiple of 8",
                      place_text);
  }
  const auto header = read_header(bytes, place_text);
  if (!header) return tl::unexpected(header.error());
  if (core::crc32(bytes.subspan(sizeof(BundleHeader))) != header->content_crc) {
    return corrupt("the content is damaged", place_text + " after byte 64");
  }
  const auto table = SectionTable::read(bytes, header->section_count, place_text);
  if (!table) return tl::unexpected(table.error());
  const auto site_json = table->find(detail::kSiteSection);
  if (!site_json) return tl::unexpected(site_json.error());
  const std::string_view text(reinterpret_cast<const char*>(site_json->data()), site_json->size());
  auto parts = detail::parse_site_json(text, place_text + " section site.json");
  if (!parts) return tl::unexpected(parts.error());
  const auto radio_map = read_radio_map(*table, parts->floors.size(), place_text);
  if (!radio_map) return tl::unexpected(radio_map.error());
  const auto magnetic_map = read_magnetic_map(*table, parts->floors.size(), place_text);
  if (!magnetic_map) return tl::unexpected(magnetic_map.error());
  return std::make_shared<const Site>(std::move(*parts), *radio_map, *magnetic_map,
                                      std::move(keep_alive), header->content_hash);
}

Result<std::shared_ptr<const Site>> load_bundle(const std::filesystem::path& path) {
  auto file = core::MemoryMappedFile::open(path);
  if (!file) return tl::unexpected(file.error());
  const auto mapped = std::make_shared<const core::MemoryMappedFile>(std::move(*file));
  return parse_bundle(mapped->bytes(), mapped, path.string());
}

}  // namespace waylode::site
