// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "waylode/eval/findings.hpp"

namespace waylode::eval {
namespace {

using Table = std::vector<std::vector<std::string>>;

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string interval(const Interval& bounds) {
  if (!std::isfinite(bounds.low)) return "-";
  return fmt::format("[{:.2f}, {:.2f}]", bounds.low, bounds.high);
}

std::string percent(double ratio) { return number(100.0 * ratio, 1); }

/// Names to the left, everything else to the right.
std::string aligned(const Table& table) {
  std::vector<std::size_t> widths(table.front().size());
  for (const auto& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += i < 2 ? fmt::format("{}{:<{}}", i == 0 ? "" : "  ", row[i], widths[i])
                    : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    text += "\n";
  }
  return text;
}

std::string intervals_text(const std::vector<MeanInterval>& intervals) {
  if (intervals.empty()) return {};
  Table table = {{"method", "group", "tracks", "mean m", "95 %", "less the first m", "95 %"}};
  for (const MeanInterval& row : intervals) {
    table.push_back({row.method, row.group, std::to_string(row.tracks), number(row.mean_m, 2),
                     interval(row.mean_95_m), number(row.difference_m, 2),
                     interval(row.difference_95_m)});
  }
  return "\nBootstrap over tracks; differences on truths that both are scored on\n" +
         aligned(table);
}

std::string details_text(const std::vector<MethodFindings>& methods) {
  if (methods.empty()) return {};
  Table table = {{"method", "group", "ok %", "track floor %", "region m2", "0-10 s", "10-20 s",
                  "20-40 s", "40 s on", "changes", "found", "in 10 s %", "worst s"}};
  for (const MethodFindings& row : methods) {
    std::vector<std::string> cells = {row.method, row.group, percent(row.ok_ratio),
                                      percent(row.whole_trace_floor_hit_ratio),
                                      number(row.region_95_median_m2, 0)};
    for (const TimeSpanError& span : row.by_time) cells.push_back(number(span.mean_m, 2));
    const FloorChanges& changes = row.floor_changes;
    cells.push_back(std::to_string(changes.n));
    cells.push_back(changes.n == 0 ? "-" : std::to_string(changes.found));
    cells.push_back(percent(changes.within_10s_ratio));
    cells.push_back(number(changes.worst_s, 1));
    table.push_back(std::move(cells));
  }
  return "\nStates, whole tracks on the right floor, median area of the 95 % region, "
         "mean error (m) by time, floor changes\n" +
         aligned(table);
}

std::string periods_text(const std::vector<ScanPeriodRows>& periods) {
  if (periods.empty()) return {};
  Table table = {{"method", "group"}};
  for (const ScanPeriodRows& period : periods) {
    table[0].push_back(period.period_s > 0.0 ? fmt::format("{:g} s", period.period_s)
                                             : "as recorded");
  }
  for (std::size_t i = 0; i < periods.front().rows.size(); ++i) {
    const ResultRow& named = periods.front().rows[i];
    if (named.group != "all" && named.group != "covered") continue;
    std::vector<std::string> cells = {named.method, named.group};
    for (const ScanPeriodRows& period : periods) {
      cells.push_back(i < period.rows.size() ? number(period.rows[i].metrics.mean_m, 2) : "-");
    }
    table.push_back(std::move(cells));
  }
  return "\nMean error (m) by scan period\n" + aligned(table);
}

std::string wrong_starts_text(const Findings& findings) {
  if (findings.wrong_starts.empty()) return {};
  const WrongStartRule& rule = findings.wrong_start_rule;
  Table table = {{"method", "group", "tracks", "recovered %", "takes a start"}};
  for (const WrongStartRow& row : findings.wrong_starts) {
    table.push_back({row.method, row.group, std::to_string(row.n),
                     row.takes_start
                         ? percent(static_cast<double>(row.recovered) / static_cast<double>(row.n))
                         : "-",
                     row.takes_start ? "yes" : "no"});
  }
  return fmt::format(
             "\nStarted {:g} m off with a stated sigma of {:g} m: less than {:g} m off again, "
             "or at most {:g} m worse than left alone, after {:g} s\n",
             rule.offset_m, rule.sigma_m, rule.near_m, rule.allowance_m, rule.judged_at_s) +
         aligned(table);
}

}  // namespace

std::string findings_text(const Findings& findings) {
  return intervals_text(findings.intervals) + details_text(findings.methods) +
         periods_text(findings.scan_periods) + wrong_starts_text(findings);
}

}  // namespace waylode::eval
