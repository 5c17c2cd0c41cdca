// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/crc32.hpp"

#include <array>

namespace waylode::core {
namespace {

// Slicing by eight: table[k][b] advances byte b by k further bytes.
using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) * 0xEDB88320U);
    tables[0][byte] = value;
  }
  for (std::size_t slice = 1; slice < 8; ++slice) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t previous = tables[slice - 1][byte];
      tables[slice][byte] = (previous >> 8U) ^ tables[0][previous & 0xFFU];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc) {
  std::uint32_t state = ~crc;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      std::uint32_t byte = std::to_integer<std::uint32_t>(bytes[i + k]);
      if (k < 4) byte ^= (state >> (8U * k)) & 0xFFU;
      next ^= kTables[7 - k][byte];
    }
    state = next;
  }
  for (; i < bytes.size(); ++i) {
    state = (state >> 8U) ^ kTables[0][(state ^ std::to_integer<std::uint32_t>(bytes[i])) & 0xFFU];
  }
  return ~state;
}

}  // namespace waylode::core
