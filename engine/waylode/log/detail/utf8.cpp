// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/utf8.hpp"

#include <cstddef>
#include <cstdint>

namespace waylode::log::detail {
namespace {

/// Octets of the character that `lead` begins; 0 when it begins none.
std::size_t length_of(std::uint8_t lead) {
  if (lead < 0x80U) return 1;
  if (lead >= 0xC2U && lead < 0xE0U) return 2;
  if (lead >= 0xE0U && lead < 0xF0U) return 3;
  if (lead >= 0xF0U && lead < 0xF5U) return 4;
  return 0;
}

/// The second octet's range narrows after E0 and F0 (longer than needed), ED (surrogates) and F4
/// (beyond U+10FFFF): RFC 3629 section 4.
bool is_second(std::uint8_t lead, std::uint8_t octet) {
  const std::uint8_t low = lead == 0xE0U ? 0xA0U : lead == 0xF0U ? 0x90U : 0x80U;
  const std::uint8_t high = lead == 0xEDU ? 0x9FU : lead == 0xF4U ? 0x8FU : 0xBFU;
  return octet >= low && octet <= high;
}

}  // namespace

bool is_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const auto lead = static_cast<std::uint8_t>(text[at]);
    const std::size_t length = length_of(lead);
    if (length == 0 || text.size() - at < length) return false;
    for (std::size_t i = 1; i < length; ++i) {
      const auto octet = static_cast<std::uint8_t>(text[at + i]);
      const bool good = i == 1 ? is_second(lead, octet) : (octet & 0xC0U) == 0x80U;
      if (!good) return false;
    }
    at += length;
  }
  return true;
}

}  // namespace waylode::log::detail
