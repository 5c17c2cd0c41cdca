// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "waylode/core/crc32.hpp"
#include "waylode/site/bundle.hpp"
#include "waylode/site/detail/bundle_layout.hpp"

namespace {

using waylode::site::detail::BundleHeader;

/// Makes size and checksums fit, so that what lies behind them is reached.
void seal(std::span<std::byte> bytes) {
  BundleHeader header;
  if (bytes.size() < sizeof(header)) return;
  std::memcpy(&header, bytes.data(), sizeof(header));
  header.file_size = bytes.size();
  header.content_crc = waylode::core::crc32(bytes.subspan(sizeof(header)));
  header.header_crc = waylode::site::detail::header_crc(header);
  std::memcpy(bytes.data(), &header, sizeof(header));
}

void load(std::span<const std::byte> bytes) {
  const auto site = waylode::site::parse_bundle(bytes, nullptr, "fuzz");
  if (!site) return;
  // Every index of an accepted map is followed.
  const auto& map = (*site)->radio_map();
  double sum = 0.0;
  for (const std::uint64_t packed : map.transmitters) {
    for (const auto& posting : map.postings_of(waylode::core::TransmitterId::from_packed(packed))) {
      const auto& record = map.fingerprints[posting.fingerprint];
      sum += (*site)->floor({record.floor}).elevation_m + static_cast<double>(record.x_m);
    }
  }
  for (const auto& point : (*site)->magnetic_map().points) {
    sum += (*site)->floor({point.floor}).elevation_m + static_cast<double>(point.horizontal_ut);
  }
  static_cast<void>(sum);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint64_t> storage(size / sizeof(std::uint64_t) + 1);
  if (size > 0) std::memcpy(storage.data(), data, size);
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(storage)).first(size);
  load(bytes);
  seal(bytes);
  load(bytes);
  return 0;
}
