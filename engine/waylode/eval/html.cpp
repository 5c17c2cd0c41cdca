// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/html.hpp"

#include <fmt/format.h>

#include <cmath>

namespace waylode::eval {

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20U || c == 0x7F ? ' ' : c;
    }
  }
  return out;
}

std::string html_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "&#8211;";
}

std::string coordinate(double value) {
  const double tenths = std::round(10.0 * value);
  // Adding zero turns -0 into 0.
  return fmt::format("{:g}", tenths / 10.0 + 0.0);
}

}  // namespace waylode::eval
