// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "waylode/core/crc32.hpp"
#include "waylode/log/detail/mcap_format.hpp"

/// MCAP's serialisation: little-endian integers, strings and maps behind a 32-bit length.
namespace waylode::log::detail {

using StringMap = std::map<std::string, std::string>;

inline std::uint32_t crc_of(std::string_view bytes, std::uint32_t crc = 0) {
  return core::crc32(std::as_bytes(std::span(bytes.data(), bytes.size())), crc);
}

/// Appends to `bytes`.
template <typename Integer>
void put(std::string& bytes, Integer value) {
  static_assert(std::is_unsigned_v<Integer>, "MCAP has unsigned integers only");
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes.push_back(static_cast<char>((std::uint64_t{value} >> (8 * i)) & 0xFFU));
  }
}

inline void put_string(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

inline void put_map(std::string& bytes, const StringMap& map) {
  std::string entries;
  for (const auto& [key, value] : map) {
    put_string(entries, key);
    put_string(entries, value);
  }
  put_string(bytes, entries);
}

inline void put_record_prefix(std::string& bytes, Opcode opcode, std::uint64_t content_bytes) {
  put(bytes, static_cast<std::uint8_t>(opcode));
  put(bytes, content_bytes);
}

inline void put_record(std::string& bytes, Opcode opcode, std::string_view content) {
  put_record_prefix(bytes, opcode, content.size());
  bytes.append(content);
}

/// Takes values off the front of a view; nullopt when it is too short.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::string_view rest() const { return bytes_; }

  template <typename Integer>
  std::optional<Integer> take() {
    if (bytes_.size() < sizeof(Integer)) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      value |= std::uint64_t{static_cast<std::uint8_t>(bytes_[i])} << (8 * i);
    }
    bytes_.remove_prefix(sizeof(Integer));
    return static_cast<Integer>(value);
  }

  std::optional<std::string_view> take_string() {
    const auto length = take<std::uint32_t>();
    if (!length || bytes_.size() < *length) return std::nullopt;
    const std::string_view text = bytes_.substr(0, *length);
    bytes_.remove_prefix(*length);
    return text;
  }

  std::optional<StringMap> take_map() {
    const auto entries = take_string();
    if (!entries) return std::nullopt;
    StringMap map;
    for (ByteReader reader(*entries); !reader.rest().empty();) {
      const auto key = reader.take_string();
      const auto value = key ? reader.take_string() : std::nullopt;
      if (!value) return std::nullopt;
      map.emplace(*key, *value);
    }
    return map;
  }

 private:
  std::string_view bytes_;
};

}  // namespace waylode::log::detail
