// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/detail/prefix_automaton.hpp"

#include "waylode/core/assert.hpp"

namespace waylode::radio::detail {

int hexadecimal_digit(char character) {
  if (character >= '0' && character <= '9') return character - '0';
  if (character >= 'a' && character <= 'f') return character - 'a' + 10;
  if (character >= 'A' && character <= 'F') return character - 'A' + 10;
  return -1;
}

PrefixAutomaton::PrefixAutomaton(std::span<const PrefixRule> rules) {
  for (const PrefixRule& rule : rules) {
    std::uint32_t state = kStart;
    for (const char character : rule.digits) {
      const int digit = hexadecimal_digit(character);
      WAYLODE_ASSERT(digit >= 0);
      const auto symbol = static_cast<std::size_t>(digit);
      if (next_[state][symbol] == kStart) {
        next_[state][symbol] = static_cast<std::uint32_t>(next_.size());
        next_.push_back({});
        accepts_.push_back(VendorKind::kUnknown);
      }
      state = next_[state][symbol];
    }
    accepts_[state] = rule.kind;
  }
}

VendorKind PrefixAutomaton::run(std::uint64_t address48) const {
  constexpr int kDigits = 12;
  VendorKind kind = VendorKind::kUnknown;
  std::uint32_t state = kStart;
  for (int i = kDigits - 1; i >= 0; --i) {
    state = next_[state][(address48 >> (4 * i)) & 0xFU];
    if (state == kStart) break;
    if (accepts_[state] != VendorKind::kUnknown) kind = accepts_[state];
  }
  return kind;
}

}  // namespace waylode::radio::detail
