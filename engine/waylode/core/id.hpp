// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace waylode::core {

/// A floor of one site: its index in Site::floors(). Means nothing for another site.
struct FloorId {
  std::uint16_t index = 0;

  auto operator<=>(const FloorId&) const = default;
};

/// What a radio signal came from. Wi-Fi and Bluetooth addresses live in separate spaces, as do the
/// anonymous columns of tabular data sets.
class TransmitterId {
 public:
  enum class Kind : std::uint8_t { kWifi = 0, kBluetooth = 1, kColumn = 2 };

  constexpr TransmitterId() = default;
  static constexpr TransmitterId wifi(std::uint64_t address48) {
    return TransmitterId(Kind::kWifi, address48);
  }
  static constexpr TransmitterId bluetooth(std::uint64_t address48) {
    return TransmitterId(Kind::kBluetooth, address48);
  }
  static constexpr TransmitterId column(std::uint64_t number) {
    return TransmitterId(Kind::kColumn, number);
  }
  /// The packed form of `packed()`.
  static constexpr TransmitterId from_packed(std::uint64_t packed) {
    TransmitterId id;
    id.packed_ = packed;
    return id;
  }

  constexpr Kind kind() const { return static_cast<Kind>(packed_ >> 56U); }
  constexpr std::uint64_t address48() const { return packed_ & 0xFFFF'FFFF'FFFFULL; }
  constexpr std::uint64_t packed() const { return packed_; }
  /// Bit 1 of the first octet: the address was chosen by software, not bought from the registry.
  constexpr bool locally_administered() const { return ((packed_ >> 40U) & 0x02U) != 0U; }

  auto operator<=>(const TransmitterId&) const = default;

 private:
  constexpr TransmitterId(Kind kind, std::uint64_t value)
      : packed_((static_cast<std::uint64_t>(kind) << 56U) | (value & 0xFFFF'FFFF'FFFFULL)) {}

  std::uint64_t packed_ = 0;
};

/// Exactly "aa:bb:cc:dd:ee:ff", either case.
std::optional<std::uint64_t> parse_mac(std::string_view text);

/// "aa:bb:cc:dd:ee:ff", "ble:aa:...", "column:17".
std::string to_string(TransmitterId id);
/// The inverse of to_string.
std::optional<TransmitterId> parse_transmitter_id(std::string_view text);

}  // namespace waylode::core

template <>
struct std::hash<waylode::core::TransmitterId> {
  std::size_t operator()(waylode::core::TransmitterId id) const noexcept {
    return std::hash<std::uint64_t>{}(id.packed() * 0x9E37'79B9'7F4A'7C15ULL);
  }
};
