// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "waylode/eval/report.hpp"

namespace waylode::eval {
namespace {

constexpr std::size_t kColumnCount = 14;
constexpr std::size_t kNameColumnCount = 2;
using Cells = std::array<std::string, kColumnCount>;

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string percent(double ratio) { return number(100.0 * ratio, 1); }

Cells header_cells() {
  return {"method", "group",  "n",       "mean m",  "p50 m",   "p75 m",     "p90 m",
          "p95 m",  "IPIN m", "floor %", "in 68 %", "in 95 %", "unknown %", "ok mean m"};
}

Cells row_cells(const ResultRow& row) {
  const Metrics& metrics = row.metrics;
  return {row.method,
          row.group,
          std::to_string(metrics.n),
          number(metrics.mean_m, 2),
          number(metrics.p50_m, 2),
          number(metrics.p75_m, 2),
          number(metrics.p90_m, 2),
          number(metrics.p95_m, 2),
          number(metrics.ipin_p75_m, 2),
          percent(metrics.floor_hit_ratio),
          percent(metrics.inside_68_ratio),
          percent(metrics.inside_95_ratio),
          percent(metrics.unknown_ratio),
          number(metrics.ok_mean_m, 2)};
}

/// Characters, not bytes: UTF-8 continuation bytes take no room.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string padding(width - width_of(text), ' ');
  return left ? text + padding : padding + text;
}

std::string line_of(const Cells& cells, const std::array<std::size_t, kColumnCount>& widths) {
  std::string line;
  for (std::size_t column = 0; column < kColumnCount; ++column) {
    if (column > 0) line += "  ";
    line += padded(cells[column], widths[column], column < kNameColumnCount);
  }
  return line + "\n";
}

}  // namespace

std::string to_text(std::span<const ResultRow> rows) {
  std::vector<Cells> table = {header_cells()};
  for (const ResultRow& row : rows) table.push_back(row_cells(row));
  std::array<std::size_t, kColumnCount> widths{};
  for (const Cells& cells : table) {
    for (std::size_t column = 0; column < kColumnCount; ++column) {
      widths[column] = std::max(widths[column], width_of(cells[column]));
    }
  }
  std::string text;
  for (const Cells& cells : table) text += line_of(cells, widths);
  return text;
}

}  // namespace waylode::eval
