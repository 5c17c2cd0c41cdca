// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "waylode/radio/hotspot_tables.hpp"

namespace waylode::radio::detail {

/// Reads a name character by character and knows after each which texts end there: the automaton of
/// [AhoCorasick1975] as one table of transitions. Marks for begin and end of a name hold texts in
/// their place.
class NameAutomaton {
 public:
  /// Every rule's text must not be empty.
  explicit NameAutomaton(std::span<const NameRule> rules);

  NameKind run(std::string_view name) const;

 private:
  using Symbol = std::uint16_t;
  static constexpr std::uint32_t kStart = 0;
  static constexpr Symbol kOtherCharacter = 0;  // In no rule.
  static constexpr Symbol kBegin = 1;
  static constexpr Symbol kEnd = 2;

  std::vector<Symbol> symbols_of(const NameRule& rule);
  void complete();
  std::uint32_t& next(std::uint32_t state, Symbol symbol) {
    return next_[static_cast<std::size_t>(state) * symbol_count_ + symbol];
  }
  std::uint32_t next(std::uint32_t state, Symbol symbol) const {
    return next_[static_cast<std::size_t>(state) * symbol_count_ + symbol];
  }

  std::array<Symbol, 256> symbol_of_{};  ///< Characters that no rule names share one.
  Symbol symbol_count_ = 3;
  std::vector<std::uint32_t> next_;  ///< States by symbols.
  std::vector<NameKind> accepts_;
};

}  // namespace waylode::radio::detail
