// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/beacon.hpp"

#include <cstddef>
#include <cstdint>

#include "waylode/log/detail/fields.hpp"

namespace waylode::log::detail {
namespace {

constexpr std::size_t kMinUuidLength = 8;
constexpr std::size_t kMaxUuidLength = 64;

std::optional<char> lower_hex_or_dash(char c) {
  if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '-') return c;
  if (c >= 'A' && c <= 'F') return static_cast<char>(c - 'A' + 'a');
  return std::nullopt;
}

}  // namespace

std::optional<std::string> ibeacon_name(std::string_view uuid, std::string_view major,
                                        std::string_view minor) {
  if (uuid.empty()) return std::string();
  if (uuid.size() < kMinUuidLength || uuid.size() > kMaxUuidLength) return std::nullopt;
  const auto major_number = parse_integer<std::uint16_t>(major);
  const auto minor_number = parse_integer<std::uint16_t>(minor);
  if (!major_number || !minor_number) return std::nullopt;
  std::string name;
  name.reserve(uuid.size() + 12);
  for (const char c : uuid) {
    const auto lower = lower_hex_or_dash(c);
    if (!lower) return std::nullopt;
    name.push_back(*lower);
  }
  return name + '/' + std::to_string(*major_number) + '/' + std::to_string(*minor_number);
}

std::optional<float> told_tx_power_dbm(double tx_power_dbm) {
  if (tx_power_dbm >= 0.0) return std::nullopt;
  return static_cast<float>(tx_power_dbm);
}

}  // namespace waylode::log::detail
