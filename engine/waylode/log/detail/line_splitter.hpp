// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace waylode::log::detail {

/// No record of any text format comes near this; it bounds what a decoder holds of its input.
inline constexpr std::size_t kMaxLineBytes = 65536;

/// Cuts a byte stream into lines at '\n' and drops the '\r' before it. The lines are the same
/// however the stream is cut into feeds; a line inside one feed is not copied.
class LineSplitter {
 public:
  /// Calls `on_line(std::string_view)` for each ended line and `on_too_long()` once for each line
  /// of more than kMaxLineBytes.
  template <typename OnLine, typename OnTooLong>
  void feed(std::string_view bytes, const OnLine& on_line, const OnTooLong& on_too_long) {
    while (!bytes.empty()) {
      const std::size_t end = bytes.find('\n');
      const std::string_view part = bytes.substr(0, end);
      if (carry_.size() + part.size() > kMaxLineBytes && !skipping_) {
        skipping_ = true;
        carry_.clear();
        on_too_long();
      }
      if (end == std::string_view::npos) {
        if (!skipping_) carry_.append(part);
        return;
      }
      if (!skipping_ && carry_.empty()) {
        on_line(without_carriage_return(part));
      } else if (!skipping_) {
        carry_.append(part);
        on_line(without_carriage_return(carry_));
        carry_.clear();
      }
      skipping_ = false;
      bytes.remove_prefix(end + 1);
    }
  }

  /// What follows the last '\n': empty after a whole file.
  std::string_view unended() const { return without_carriage_return(carry_); }

 private:
  static std::string_view without_carriage_return(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  std::string carry_;
  bool skipping_ = false;
};

}  // namespace waylode::log::detail
