// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/findings_html.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/eval/html.hpp"

namespace waylode::eval::detail {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Cells = std::vector<std::string>;  ///< Safe HTML.

std::string row_html(const Cells& cells, const char* tag) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    html += i == 0 ? "<th class=\"name\">" + cells[i] + "</th>"
                   : fmt::format("<{0}>{1}</{0}>", tag, cells[i]);
  }
  return html + "</tr>\n";
}

std::string table_html(const Cells& head, const std::vector<Cells>& rows) {
  std::string html =
      "<div class=\"scroll\"><table><thead>" + row_html(head, "th") + "</thead><tbody>";
  for (const Cells& row : rows) html += row_html(row, "td");
  return html + "</tbody></table></div>\n";
}

std::string section(const char* heading, const std::string& note, const std::string& content) {
  return fmt::format("<h2>{}</h2>\n<p class=\"note\">{}</p>\n{}", heading, note, content);
}

std::string percent(double ratio) { return html_number(100.0 * ratio, 1); }

std::string interval(const Interval& bounds) {
  if (!std::isfinite(bounds.low)) return html_number(bounds.low, 2);
  return fmt::format("{:.2f} to {:.2f}", bounds.low, bounds.high);
}

std::string intervals_html(const std::vector<MeanInterval>& intervals) {
  if (intervals.empty()) return {};
  std::vector<Cells> rows;
  for (const MeanInterval& row : intervals) {
    rows.push_back({escape_html(row.method), row.group, std::to_string(row.tracks),
                    html_number(row.mean_m, 2), interval(row.mean_95_m),
                    html_number(row.difference_m, 2), interval(row.difference_95_m)});
  }
  return section(
      "How sure the means are",
      "Bootstrap over whole recordings, 95 % intervals. The difference to the first method is "
      "paired: the same drawn recordings, truths that both are scored on.",
      table_html({"method", "group", "recordings", "mean m", "95 %", "less the first, m", "95 %"},
                 rows));
}

Cells detail_cells(const MethodFindings& row) {
  Cells cells = {escape_html(row.method), row.group, percent(row.ok_ratio),
                 percent(row.whole_trace_floor_hit_ratio), html_number(row.region_95_median_m2, 0)};
  for (const TimeSpanError& span : row.by_time) cells.push_back(html_number(span.mean_m, 2));
  const FloorChanges& changes = row.floor_changes;
  cells.push_back(fmt::format("{} of {}", changes.found, changes.n));
  cells.push_back(percent(changes.within_10s_ratio));
  cells.push_back(html_number(changes.worst_s, 1));
  return cells;
}

std::string details_html(const std::vector<MethodFindings>& methods) {
  if (methods.empty()) return {};
  std::vector<Cells> rows;
  Cells reliability_head = {"method", "group"};
  std::vector<Cells> reliability;
  for (const MethodFindings& row : methods) {
    rows.push_back(detail_cells(row));
    reliability.push_back({escape_html(row.method), row.group});
    for (const ReliabilityPoint& point : row.reliability) {
      reliability.back().push_back(percent(point.inside_ratio));
    }
  }
  for (const ReliabilityPoint& point : methods.front().reliability) {
    reliability_head.push_back(fmt::format("{:.0f} %", 100.0 * point.stated_ratio));
  }
  return section("States, regions, time and floors",
                 "Share of fixes in state ok; recordings whose every fix has the right floor; "
                 "median area of the 95 % region; mean error by time since the first truth; marked "
                 "floor changes found, the share of them within 10 s, and the longest delay.",
                 table_html(
                     {"method", "group", "ok %", "recordings on the floor %", "region m2", "0-10 s",
                      "10-20 s", "20-40 s", "40 s on", "changes found", "within 10 s %", "worst s"},
                     rows)) +
         section("Truths inside the stated regions (%)", "By the probability that was stated.",
                 table_html(reliability_head, reliability));
}

std::string periods_html(const std::vector<ScanPeriodRows>& periods) {
  if (periods.empty()) return {};
  Cells head = {"method", "group"};
  for (const ScanPeriodRows& period : periods) {
    head.push_back(period.period_s > 0.0 ? fmt::format("{:g} s", period.period_s) : "as recorded");
  }
  std::vector<Cells> rows;
  for (std::size_t i = 0; i < periods.front().rows.size(); ++i) {
    const ResultRow& named = periods.front().rows[i];
    if (named.group != "all" && named.group != "covered") continue;
    rows.push_back({escape_html(named.method), named.group});
    for (const ScanPeriodRows& period : periods) {
      rows.back().push_back(i < period.rows.size() ? html_number(period.rows[i].metrics.mean_m, 2)
                                                   : std::string());
    }
  }
  std::string charts = "<div class=\"charts\">\n";
  for (const char* group : {"all", "covered"}) {
    const std::string drawing = scan_period_svg(periods, group);
    if (drawing.empty()) continue;
    charts += fmt::format("<div class=\"card\"><h3>{}</h3>\n{}</div>\n", group, drawing);
  }
  return section("When scans are scarce",
                 "Mean error (m) when scans of the tests come no oftener than that.",
                 table_html(head, rows) + charts + "</div>\n");
}

std::string wrong_starts_html(const Findings& findings) {
  if (findings.wrong_starts.empty()) return {};
  const WrongStartRule& rule = findings.wrong_start_rule;
  std::vector<Cells> rows;
  for (const WrongStartRow& row : findings.wrong_starts) {
    rows.push_back(
        {escape_html(row.method), row.group, std::to_string(row.n),
         percent(row.takes_start ? static_cast<double>(row.recovered) / static_cast<double>(row.n)
                                 : kNaN),
         row.takes_start ? "yes" : "no"});
  }
  return section(
      "Wrong starts",
      fmt::format(
          "Begun {:g} m off with a stated sigma of {:g} m. Recovered: after {:g} s less than "
          "{:g} m off, or at most {:g} m worse than when left alone.",
          rule.offset_m, rule.sigma_m, rule.judged_at_s, rule.near_m, rule.allowance_m),
      table_html({"method", "group", "recordings", "recovered %", "takes a start"}, rows));
}

}  // namespace

std::string findings_html(const Findings& findings) {
  return intervals_html(findings.intervals) + details_html(findings.methods) +
         periods_html(findings.scan_periods) + wrong_starts_html(findings);
}

}  // namespace waylode::eval::detail
