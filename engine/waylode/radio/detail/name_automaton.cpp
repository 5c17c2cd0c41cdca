// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/detail/name_automaton.hpp"

#include <algorithm>
#include <deque>

#include "waylode/core/assert.hpp"

namespace waylode::radio::detail {

NameAutomaton::NameAutomaton(std::span<const NameRule> rules) {
  std::vector<std::vector<Symbol>> texts;
  for (const NameRule& rule : rules) texts.push_back(symbols_of(rule));
  next_.assign(symbol_count_, kStart);
  accepts_.assign(1, NameKind::kOther);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    std::uint32_t state = kStart;
    for (const Symbol symbol : texts[i]) {
      if (next(state, symbol) == kStart) {
        next(state, symbol) = static_cast<std::uint32_t>(accepts_.size());
        accepts_.push_back(NameKind::kOther);
        next_.resize(next_.size() + symbol_count_, kStart);
      }
      state = next(state, symbol);
    }
    accepts_[state] = std::max(accepts_[state], rules[i].kind);
  }
  complete();
}

std::vector<NameAutomaton::Symbol> NameAutomaton::symbols_of(const NameRule& rule) {
  WAYLODE_ASSERT(!rule.text.empty());
  std::vector<Symbol> symbols;
  if (rule.place == NameRule::Place::kStart) symbols.push_back(kBegin);
  for (const char character : rule.text) {
    Symbol& symbol = symbol_of_[static_cast<unsigned char>(character)];
    if (symbol == kOtherCharacter) symbol = symbol_count_++;
    symbols.push_back(symbol);
  }
  if (rule.place == NameRule::Place::kEnd) symbols.push_back(kEnd);
  return symbols;
}

/// Where the trie has no way on, goes where the longest proper suffix of what was read would go.
void NameAutomaton::complete() {
  std::vector<std::uint32_t> suffix(accepts_.size(), kStart);
  std::deque<std::uint32_t> queue;
  for (Symbol symbol = 0; symbol < symbol_count_; ++symbol) {
    if (next(kStart, symbol) != kStart) queue.push_back(next(kStart, symbol));
  }
  while (!queue.empty()) {
    const std::uint32_t state = queue.front();
    queue.pop_front();
    accepts_[state] = std::max(accepts_[state], accepts_[suffix[state]]);
    for (Symbol symbol = 0; symbol < symbol_count_; ++symbol) {
      std::uint32_t& child = next(state, symbol);
      const std::uint32_t otherwise = next(suffix[state], symbol);
      if (child == kStart) {
        child = otherwise;
      } else {
        suffix[child] = otherwise;
        queue.push_back(child);
      }
    }
  }
}

NameKind NameAutomaton::run(std::string_view name) const {
  std::uint32_t state = next(kStart, kBegin);
  NameKind kind = accepts_[state];
  const auto read = [&](Symbol symbol) {
    state = next(state, symbol);
    kind = std::max(kind, accepts_[state]);
  };
  for (const char character : name) read(symbol_of_[static_cast<unsigned char>(character)]);
  read(kEnd);
  return kind;
}

}  // namespace waylode::radio::detail
