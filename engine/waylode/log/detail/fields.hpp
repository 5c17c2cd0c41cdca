// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

namespace waylode::log::detail {

/// The whole of `text` is one finite number. No locale, no blanks, no leading '+'.
inline std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The whole of `text` is one decimal integer that fits.
template <typename Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  Integer value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

/// The first kMaxFields fields of a line; `count` goes on counting beyond them.
struct Fields {
  static constexpr std::size_t kMaxFields = 16;
  std::array<std::string_view, kMaxFields> at{};
  std::size_t count = 0;

  std::string_view operator[](std::size_t index) const { return at[index]; }
};

inline Fields split_fields(std::string_view line, char separator) {
  Fields fields;
  while (true) {
    const std::size_t end = line.find(separator);
    if (fields.count < Fields::kMaxFields) fields.at[fields.count] = line.substr(0, end);
    ++fields.count;
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

/// Takes the last field off `line`; false if there is no separator left.
inline bool pop_field(std::string_view& line, char separator, std::string_view& field) {
  const std::size_t end = line.rfind(separator);
  if (end == std::string_view::npos) return false;
  field = line.substr(end + 1);
  line = line.substr(0, end);
  return true;
}

/// Fields [first, first + values.size()) as numbers; false if one is not.
inline bool parse_numbers(const Fields& fields, std::size_t first, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = parse_number(fields[first + i]);
    if (!value) return false;
    values[i] = *value;
  }
  return true;
}

}  // namespace waylode::log::detail
