// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "waylode/log/log_report.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::log::detail {

/// The counts of a LogReport in a form cheap enough for every record.
class Tally {
 public:
  void accept(std::size_t variant_index) { ++accepted_[variant_index]; }
  /// `kind` comes from the log: at most kMaxIgnoredKinds are told apart, the rest is "other".
  void ignore(std::string_view kind) { count(ignored_, kind, kMaxIgnoredKinds); }
  /// `reason` is one of ours.
  void reject(std::string_view reason) { count(rejected_, reason, SIZE_MAX); }

  /// Replaces the maps of `report` by these counts.
  void write_to(LogReport& report) const;

 private:
  static constexpr std::size_t kMaxIgnoredKinds = 64;
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;
  static void count(Counts& counts, std::string_view name, std::size_t max_names);

  std::array<std::uint64_t, std::variant_size_v<sample::Sample>> accepted_{};
  Counts ignored_;
  Counts rejected_;
};

}  // namespace waylode::log::detail
