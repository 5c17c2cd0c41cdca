// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/id.hpp"

#include <charconv>

namespace waylode::core {
namespace {

constexpr std::string_view kBluetoothPrefix = "ble:";
constexpr std::string_view kColumnPrefix = "column:";

int hex_digit(char character) {
  if (character >= '0' && character <= '9') return character - '0';
  if (character >= 'a' && character <= 'f') return character - 'a' + 10;
  if (character >= 'A' && character <= 'F') return character - 'A' + 10;
  return -1;
}

std::string format_mac(std::uint64_t address48) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "00:00:00:00:00:00";
  for (std::size_t octet = 0; octet < 6; ++octet) {
    const std::uint64_t value = (address48 >> (8U * (5U - octet))) & 0xFFU;
    text[3 * octet] = kDigits[value >> 4U];
    text[3 * octet + 1] = kDigits[value & 0xFU];
  }
  return text;
}

}  // namespace

std::optional<std::uint64_t> parse_mac(std::string_view text) {
  if (text.size() != 17) return std::nullopt;
  std::uint64_t address = 0;
  for (std::size_t octet = 0; octet < 6; ++octet) {
    const int high = hex_digit(text[3 * octet]);
    const int low = hex_digit(text[3 * octet + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    if (octet < 5 && text[3 * octet + 2] != ':') return std::nullopt;
    address = (address << 8U) | static_cast<std::uint64_t>(high * 16 + low);
  }
  return address;
}

std::string to_string(TransmitterId id) {
  switch (id.kind()) {
    case TransmitterId::Kind::kWifi:
      return format_mac(id.address48());
    case TransmitterId::Kind::kBluetooth:
      return std::string(kBluetoothPrefix) + format_mac(id.address48());
    case TransmitterId::Kind::kColumn:
      break;
  }
  return std::string(kColumnPrefix) + std::to_string(id.address48());
}

std::optional<TransmitterId> parse_transmitter_id(std::string_view text) {
  if (text.starts_with(kBluetoothPrefix)) {
    const auto address = parse_mac(text.substr(kBluetoothPrefix.size()));
    return address ? std::optional(TransmitterId::bluetooth(*address)) : std::nullopt;
  }
  if (text.starts_with(kColumnPrefix)) {
    const std::string_view digits = text.substr(kColumnPrefix.size());
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    const TransmitterId id = TransmitterId::column(number);
    return id.address48() == number ? std::optional(id) : std::nullopt;
  }
  const auto address = parse_mac(text);
  return address ? std::optional(TransmitterId::wifi(*address)) : std::nullopt;
}

}  // namespace waylode::core
