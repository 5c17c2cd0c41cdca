// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/report_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "waylode/eval/html.hpp"
#include "waylode/eval/svg_chart.hpp"

namespace waylode::eval::detail {
namespace {

/// What makes a value good.
enum class Goal { kLow, kHigh, kTarget, kNone };

struct Column {
  const char* head;  ///< HTML, like `unit`.
  const char* unit;
  const char* help;
  double (*value)(const Metrics&);
  int digits;
  Goal goal;
  double target = 0.0;
};

double percent(double ratio) { return 100.0 * ratio; }

// CPU time is stated per second walked: 1 means that one core just keeps up with one person.
constexpr std::array kColumns = {
    Column{"truths", "", "Scored truths", [](const Metrics& m) { return static_cast<double>(m.n); },
           0, Goal::kNone},
    Column{"mean", "m", "Mean horizontal error", [](const Metrics& m) { return m.mean_m; }, 2,
           Goal::kLow},
    Column{"p50", "m", "Half of the errors are at most this",
           [](const Metrics& m) { return m.p50_m; }, 2, Goal::kLow},
    Column{"p75", "m", "Three quarters of the errors are at most this",
           [](const Metrics& m) { return m.p75_m; }, 2, Goal::kLow},
    Column{"p90", "m", "Nine in ten errors are at most this",
           [](const Metrics& m) { return m.p90_m; }, 2, Goal::kLow},
    Column{"p95", "m", "19 in 20 errors are at most this", [](const Metrics& m) { return m.p95_m; },
           2, Goal::kLow},
    Column{"IPIN", "m", "Third quartile of error + 15 m per wrong floor",
           [](const Metrics& m) { return m.ipin_p75_m; }, 2, Goal::kLow},
    Column{"floor", "%", "Fixes on the right floor",
           [](const Metrics& m) { return percent(m.floor_hit_ratio); }, 1, Goal::kHigh},
    Column{"floor, tracks", "%", "Tracks with the right floor for most of their fixes",
           [](const Metrics& m) { return percent(m.trace_floor_hit_ratio); }, 1, Goal::kHigh},
    Column{"within 1&#160;m", "%", "Errors of at most 1 m",
           [](const Metrics& m) { return percent(m.within_1_m); }, 1, Goal::kHigh},
    Column{"within 2&#160;m", "%", "Errors of at most 2 m",
           [](const Metrics& m) { return percent(m.within_2_m); }, 1, Goal::kHigh},
    Column{"within 3&#160;m", "%", "Errors of at most 3 m",
           [](const Metrics& m) { return percent(m.within_3_m); }, 1, Goal::kHigh},
    Column{"in 68", "%", "Truths inside the stated 68 % region; 68 is honest",
           [](const Metrics& m) { return percent(m.inside_68_ratio); }, 1, Goal::kTarget, 68.0},
    Column{"in 95", "%", "Truths inside the stated 95 % region; 95 is honest",
           [](const Metrics& m) { return percent(m.inside_95_ratio); }, 1, Goal::kTarget, 95.0},
    Column{"95 % region", "m&#178;", "Median area of the stated 95 % region",
           [](const Metrics& m) { return m.region_95_median_m2; }, 0, Goal::kNone},
    Column{"unknown", "%", "Fixes whose state is unknown",
           [](const Metrics& m) { return percent(m.unknown_ratio); }, 1, Goal::kNone},
    Column{"mean, ok", "m", "Mean error of fixes in state ok",
           [](const Metrics& m) { return m.ok_mean_m; }, 2, Goal::kLow},
    Column{"mean, 10&#160;s&#160;on", "m", "Mean error from 10 s after the start",
           [](const Metrics& m) { return m.after10s_mean_m; }, 2, Goal::kLow},
    Column{"CPU", "ms/s", "Milliseconds of one core per second walked",
           [](const Metrics& m) {
             return m.walked_s > 0.0 ? 1e3 * m.cpu_s / m.walked_s
                                     : std::numeric_limits<double>::quiet_NaN();
           },
           2, Goal::kLow},
};

/// Smaller is better; infinite for what is not a number.
double badness(const Column& column, double value) {
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  switch (column.goal) {
    case Goal::kLow:
      return value;
    case Goal::kHigh:
      return -value;
    case Goal::kTarget:
      return std::abs(value - column.target);
    case Goal::kNone:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

/// Among `rows`; infinite when there is no choice to make.
double least_badness(const Column& column, const std::vector<const ResultRow*>& rows) {
  double least = std::numeric_limits<double>::infinity();
  if (rows.size() < 2) return least;
  for (const ResultRow* row : rows) {
    least = std::min(least, badness(column, column.value(row->metrics)));
  }
  return least;
}

std::string cell(const std::string& content, bool best) {
  return (best ? "<td class=\"best\">" : "<td>") + content + "</td>";
}

std::string summary_head() {
  std::string html = "<thead><tr><th scope=\"col\" class=\"name\">method</th>";
  for (const Column& column : kColumns) {
    html += fmt::format("<th scope=\"col\" title=\"{}\">{}<span class=\"unit\">{}</span></th>",
                        escape_html(column.help), column.head, column.unit);
  }
  return html + "</tr></thead>";
}

const ResultRow* find_row(std::span<const ResultRow> rows, std::string_view method,
                          std::string_view group) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ResultRow& row) {
    return row.method == method && row.group == group;
  });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<std::string> real_groups(std::span<const ResultRow> rows) {
  std::vector<std::string> groups;
  for (const ResultRow& row : rows) {
    if (row.group == "all" || row.group == "covered") continue;
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) {
      groups.push_back(row.group);
    }
  }
  return groups;
}

std::string group_row(std::span<const ResultRow> rows, const std::string& group,
                      const std::vector<MethodErrors>& methods) {
  std::vector<const ResultRow*> found;
  std::uint64_t most = 0;
  double best_m = std::numeric_limits<double>::infinity();
  for (const MethodErrors& method : methods) {
    const ResultRow* row = find_row(rows, method.name, group);
    found.push_back(row);
    if (row == nullptr || row->metrics.n == 0) continue;
    most = std::max(most, row->metrics.n);
    best_m = std::min(best_m, row->metrics.mean_m);
  }
  std::string html = fmt::format("<tr><th scope=\"row\" class=\"name\">{}</th><td>{}</td>",
                                 escape_html(group), most);
  for (const ResultRow* row : found) {
    if (row == nullptr || row->metrics.n == 0) {
      html += "<td>&#8211;</td>";
      continue;
    }
    const Metrics& metrics = row->metrics;
    html += cell(fmt::format("{}<span class=\"small\">p90 {}, floor {}&#160;%</span>",
                             html_number(metrics.mean_m, 2), html_number(metrics.p90_m, 1),
                             html_number(percent(metrics.floor_hit_ratio), 1)),
                 methods.size() > 1 && metrics.mean_m == best_m);
  }
  return html + "</tr>\n";
}

}  // namespace

std::string method_label(std::string_view name, const std::vector<MethodErrors>& methods) {
  const auto found = std::find_if(methods.begin(), methods.end(),
                                  [&](const MethodErrors& method) { return method.name == name; });
  return fmt::format("<span class=\"{}\"><span class=\"swatch\"></span></span>{}",
                     method_classes(static_cast<std::size_t>(found - methods.begin())),
                     escape_html(name));
}

std::string summary_table(std::span<const ResultRow> rows, std::string_view group,
                          const std::vector<MethodErrors>& methods) {
  std::vector<const ResultRow*> chosen;
  for (const ResultRow& row : rows) {
    if (row.group == group) chosen.push_back(&row);
  }
  if (chosen.empty()) return {};
  std::array<double, kColumns.size()> least{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) least[i] = least_badness(kColumns[i], chosen);
  std::string html = "<div class=\"scroll\"><table>" + summary_head() + "<tbody>\n";
  for (const ResultRow* row : chosen) {
    html += "<tr><th scope=\"row\" class=\"name\">" + method_label(row->method, methods) + "</th>";
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const double value = kColumns[i].value(row->metrics);
      const double bad = badness(kColumns[i], value);
      html += cell(html_number(value, kColumns[i].digits), std::isfinite(bad) && bad == least[i]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string group_table(std::span<const ResultRow> rows, const std::vector<MethodErrors>& methods) {
  const std::vector<std::string> groups = real_groups(rows);
  if (groups.empty()) return {};
  std::string html =
      "<div class=\"scroll\"><table class=\"groups\"><thead><tr><th scope=\"col\" "
      "class=\"name\">group</th><th scope=\"col\">truths</th>";
  for (const MethodErrors& method : methods) {
    html += "<th scope=\"col\">" + method_label(method.name, methods) +
            "<span class=\"unit\">mean, m</span></th>";
  }
  html += "</tr></thead><tbody>\n";
  for (const std::string& group : groups) html += group_row(rows, group, methods);
  return html + "</tbody></table></div>\n";
}

}  // namespace waylode::eval::detail
