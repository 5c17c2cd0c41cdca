// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "waylode/eval/detail/error_charts.hpp"
#include "waylode/eval/detail/findings_html.hpp"
#include "waylode/eval/detail/report_data.hpp"
#include "waylode/eval/detail/report_style.hpp"
#include "waylode/eval/detail/report_table.hpp"
#include "waylode/eval/detail/svg_plan.hpp"
#include "waylode/eval/html.hpp"
#include "waylode/eval/report.hpp"
#include "waylode/eval/report_page.hpp"
#include "waylode/eval/svg_chart.hpp"

namespace waylode::eval {
namespace {

using detail::MethodErrors;

/// The row of the group "all" with the least mean error; nullptr when nothing was scored.
const ResultRow* best_row(std::span<const ResultRow> rows) {
  const ResultRow* best = nullptr;
  for (const ResultRow& row : rows) {
    if (row.group != "all" || row.metrics.n == 0) continue;
    if (best == nullptr || row.metrics.mean_m < best->metrics.mean_m) best = &row;
  }
  return best;
}

std::string tile(const std::string& value, const std::string& caption) {
  return "<div class=\"tile\"><b>" + value + "</b><span>" + caption + "</span></div>";
}

std::string walked_text(double walked_s) {
  const long minutes = std::lround(walked_s / 60.0);
  if (minutes < 2) return html_number(walked_s, 0) + "&#160;s";
  if (minutes < 120) return fmt::format("{}&#160;min", minutes);
  return fmt::format("{}&#160;h {}&#160;min", minutes / 60, minutes % 60);
}

/// The figures an operator asks for first, of the method that is best on average.
std::string headline(std::span<const EvaluatedTrack> tracks, std::span<const ResultRow> rows) {
  const ResultRow* best = best_row(rows);
  if (best == nullptr) return "<p class=\"lead\">No truth could be scored.</p>\n";
  const Metrics& metrics = best->metrics;
  std::set<std::pair<std::string, std::string>> recordings;
  for (const EvaluatedTrack& track : tracks) recordings.emplace(track.group, track.name);
  std::string html = "<div class=\"tiles\">";
  html +=
      tile(html_number(metrics.mean_m, 2) + "&#160;m", "mean error, " + escape_html(best->method));
  html += tile(html_number(metrics.p50_m, 2) + "&#160;m", "half are within");
  html += tile(html_number(metrics.p90_m, 2) + "&#160;m", "nine in ten are within");
  html += tile(html_number(100.0 * metrics.floor_hit_ratio, 1) + "&#160;%", "right floor");
  html += tile(std::to_string(recordings.size()), "recordings");
  html += tile(walked_text(metrics.walked_s), "walked");
  return html + "</div>\n";
}

std::string header(const ReportOptions& options) {
  std::string html = "<header><h1>" + escape_html(options.title) + "</h1>";
  if (!options.dataset.empty()) {
    html += "<p class=\"dim\">Data set: " + escape_html(options.dataset) + "</p>";
  }
  if (!options.command.empty()) {
    html += "<div class=\"command\">" + escape_html(options.command) + "</div>";
  }
  return html + "</header>\n";
}

/// Disabled until the script runs, which alone can act on it.
std::string legend(const std::vector<MethodErrors>& methods) {
  std::string html = "<nav class=\"legend\" aria-label=\"Methods\">";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    html += fmt::format(
        "<label class=\"{}\"><input type=\"checkbox\" checked=\"checked\" disabled=\"disabled\" "
        "data-toggle=\"{}\"/><span><span class=\"swatch\"></span>{}</span></label>",
        method_classes(m), m, escape_html(methods[m].name));
  }
  return html + "</nav>\n";
}

std::string card(const char* title, const std::string& drawing, const char* note) {
  if (drawing.empty()) return {};
  return fmt::format("<div class=\"card\"><h3>{}</h3>\n{}<p class=\"note\">{}</p></div>\n", title,
                     drawing, note);
}

std::string charts(const std::vector<MethodErrors>& methods) {
  return "<div class=\"charts\">\n" +
         card("How far off", detail::error_cdf_svg(methods),
              "Share of positions within a distance of the truth; higher and further left is "
              "better.") +
         card("How honest", detail::reliability_svg(methods),
              "Share of truths inside the region stated for a probability. On the dashed line the "
              "stated doubt is right; below it the method is too sure of itself.") +
         card("How soon", detail::error_over_time_svg(methods),
              "Mean error against the time since a track's first truth.") +
         card("How even", detail::recording_cdf_svg(methods),
              "Share of recordings whose mean error is within a distance: whether a few walks go "
              "wrong or all are alike.") +
         "</div>\n";
}

constexpr const char* kDefinitions =
    "<details><summary>What the columns mean</summary><dl>"
    "<dt>error</dt><dd>Horizontal distance from the truth, at the truth's instant. Every truth "
    "from "
    "the first usable scan on counts, whatever the state of the fix; a method without a position "
    "is "
    "charged half the diagonal of the floor.</dd>"
    "<dt>wrong floor</dt><dd>The distance is taken through the frame all floors share.</dd>"
    "<dt>IPIN</dt><dd>Third quartile of error + 15 m per wrong floor, as scored at the IPIN "
    "competitions.</dd>"
    "<dt>in 68, in 95</dt><dd>Truths inside the stated regions; a wrong floor is outside. The best "
    "value is the one nearest to 68 or 95.</dd>"
    "<dt>unknown</dt><dd>Fixes that the interface would not show.</dd>"
    "<dt>CPU</dt><dd>Milliseconds of one core per second walked; 1000 would just keep up with one "
    "person.</dd></dl></details>\n";

std::string tables(std::span<const ResultRow> rows, const std::vector<MethodErrors>& methods) {
  std::string html = "<h2>Methods compared</h2>\n" + detail::summary_table(rows, "all", methods);
  const std::string covered = detail::summary_table(rows, "covered", methods);
  if (!covered.empty()) {
    html +=
        "<h2>Along surveyed paths</h2>\n<p class=\"note\">Only recordings with at least nine "
        "tenths of their path near a surveyed one.</p>\n" +
        covered;
  }
  return html + kDefinitions;
}

std::string figures(const char* heading, const std::vector<detail::Recording>& recordings,
                    const std::vector<MethodErrors>& methods, detail::FloorPlans& plans) {
  if (recordings.empty()) return {};
  std::string html = fmt::format("<h2>{}</h2>\n<div class=\"tracks\">\n", heading);
  for (const detail::Recording& recording : recordings) {
    html += detail::recording_figure(recording, methods, plans);
  }
  return html + "</div>\n";
}

std::string drawings(const ReportOptions& options, std::span<const EvaluatedTrack> tracks,
                     const std::vector<MethodErrors>& methods) {
  const detail::ChosenRecordings chosen = detail::choose_recordings(tracks, options.max_tracks);
  if (chosen.worst.empty()) return {};
  detail::FloorPlans plans;
  const char* heading = chosen.median.empty() ? "Recordings, worst first" : "Worst recordings";
  const std::string body = figures(heading, chosen.worst, methods, plans) +
                           figures("Typical recordings", chosen.median, methods, plans);
  return plans.definitions() + body +
         "<p class=\"note\">Dark line and dots: the truth, from the ring on. Coloured dots: fixes "
         "at "
         "the same instants with their 95 % ellipses; a dotted line leads from each truth to its "
         "fix; crosses stand for fixes on a wrong floor. Worst by the first method.</p>\n";
}

}  // namespace

std::string report_page(std::string_view title, std::string_view body) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/><title>" +
      escape_html(title) + "</title><style>";
  html += detail::report_style();
  html += "</style></head><body><main>\n";
  html += body;
  html += "</main><script>";
  html += detail::report_script();
  return html + "</script></body></html>\n";
}

std::string to_html(const ReportOptions& options, std::span<const EvaluatedTrack> tracks,
                    std::span<const ResultRow> rows, const Findings& findings) {
  const std::vector<MethodErrors> methods = detail::errors_by_method(tracks);
  std::string body = header(options) + headline(tracks, rows);
  body += tables(rows, methods) + legend(methods) + "<h2>Errors</h2>\n" + charts(methods);
  body += detail::findings_html(findings);
  const std::string groups = detail::group_table(rows, methods);
  if (!groups.empty()) body += "<h2>By site and floor</h2>\n" + groups;
  return report_page(options.title, body + drawings(options, tracks, methods));
}

}  // namespace waylode::eval
