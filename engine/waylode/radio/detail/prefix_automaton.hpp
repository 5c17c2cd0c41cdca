// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "waylode/radio/hotspot_tables.hpp"

namespace waylode::radio::detail {

/// Reads an address digit by digit: a trie over prefixes as one table of transitions.
class PrefixAutomaton {
 public:
  /// Every rule's digits must be 1 to 12 hexadecimal ones.
  explicit PrefixAutomaton(std::span<const PrefixRule> rules);

  /// The kind of the longest prefix that fits.
  VendorKind run(std::uint64_t address48) const;

 private:
  static constexpr std::uint32_t kStart = 0;  // Nothing leads back there, so it also says "none".

  std::vector<std::array<std::uint32_t, 16>> next_ = {{}};
  std::vector<VendorKind> accepts_ = {VendorKind::kUnknown};
};

/// -1 for what is no hexadecimal digit.
int hexadecimal_digit(char character);

}  // namespace waylode::radio::detail
