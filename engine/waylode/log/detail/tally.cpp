// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/tally.hpp"

#include <utility>

namespace waylode::log::detail {
namespace {

constexpr std::string_view kOther = "other";

template <std::size_t... kIndex>
std::array<const char*, sizeof...(kIndex)> kind_names(std::index_sequence<kIndex...>) {
  return {sample::kind_of(sample::Sample(std::in_place_index<kIndex>))...};
}

}  // namespace

void Tally::count(Counts& counts, std::string_view name, std::size_t max_names) {
  for (auto& [known, times] : counts) {
    if (known == name) {
      ++times;
      return;
    }
  }
  if (counts.size() >= max_names && name != kOther) return count(counts, kOther, SIZE_MAX);
  counts.emplace_back(name, 1);
}

void Tally::write_to(LogReport& report) const {
  const auto names = kind_names(std::make_index_sequence<std::variant_size_v<sample::Sample>>());
  report.accepted.clear();
  for (std::size_t i = 0; i < accepted_.size(); ++i) {
    if (accepted_[i] != 0) report.accepted[names[i]] = accepted_[i];
  }
  report.ignored = {ignored_.begin(), ignored_.end()};
  report.rejected = {rejected_.begin(), rejected_.end()};
}

}  // namespace waylode::log::detail
