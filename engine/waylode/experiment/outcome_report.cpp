// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/outcome_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "waylode/eval/html.hpp"
#include "waylode/eval/report_page.hpp"

namespace waylode::experiment {
namespace {

using eval::escape_html;

std::string number_text(double value) {
  if (!std::isfinite(value)) return "-";
  return std::abs(value) < 100.0 ? fmt::format("{:.2f}", value) : fmt::format("{:.1f}", value);
}

std::string ours_text(const Figure& figure) {
  return fmt::format("{} [{}, {}] {}", number_text(figure.ours.value), number_text(figure.ours.low),
                     number_text(figure.ours.high), figure.unit);
}

std::string bar_text(const Figure& figure) {
  if (!figure.bar) return "-";
  return fmt::format("{} {:g}",
                     figure.bar->sense == Bar::Sense::kAtMost ? "<=" : ">=", figure.bar->limit);
}

const char* verdict(const Figure& figure) {
  const std::optional<bool> reached = figure.reached();
  if (!reached) return "";
  return *reached ? "reached" : "missed";
}

std::string paper_text(const Figure& figure) { return figure.paper.empty() ? "-" : figure.paper; }

nlohmann::ordered_json number_json(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json figure_json(const Figure& figure) {
  nlohmann::ordered_json json = {{"id", figure.id},
                                 {"what", figure.what},
                                 {"unit", figure.unit},
                                 {"paper", figure.paper},
                                 {"value", number_json(figure.ours.value)},
                                 {"low_95", number_json(figure.ours.low)},
                                 {"high_95", number_json(figure.ours.high)},
                                 {"n", figure.ours.n}};
  if (figure.bar) {
    json["bar"] = {{"sense", figure.bar->sense == Bar::Sense::kAtMost ? "at_most" : "at_least"},
                   {"limit", figure.bar->limit}};
    json["reached"] = *figure.reached();
  }
  if (!figure.note.empty()) json["note"] = figure.note;
  return json;
}

std::string figure_row(const Figure& figure) {
  std::string what = escape_html(figure.what);
  if (!figure.note.empty()) what += "<span class=\"small\">" + escape_html(figure.note) + "</span>";
  const std::string mark = verdict(figure);
  return fmt::format(
      "<tr><th class=\"name\" scope=\"row\">{}</th><td class=\"name\">{}</td><td>{}</td><td{}>{}"
      "<span class=\"small\">[{}, {}], n = {}</span></td><td>{}</td><td>{}</td></tr>\n",
      escape_html(figure.id), what, escape_html(paper_text(figure)),
      mark == "reached" ? " class=\"best\"" : "",
      escape_html(number_text(figure.ours.value) + " " + figure.unit), number_text(figure.ours.low),
      number_text(figure.ours.high), figure.ours.n, escape_html(bar_text(figure)), mark);
}

/// What the lines of a chart are; the page's style gives them their colours.
std::string chart_legend(const eval::LineChart& chart) {
  std::string html = "<p class=\"note\">";
  for (const eval::Series& series : chart.series) {
    html += fmt::format("<span class=\"{}\"><span class=\"swatch\"></span> {}</span> &#160; ",
                        eval::method_classes(series.method), escape_html(series.name));
  }
  return html + "</p>";
}

std::string chart_card(const eval::LineChart& chart) {
  return "<div class=\"card\"><h3>" + escape_html(chart.title) + "</h3>\n" +
         eval::svg_line_chart(chart) + chart_legend(chart) + "</div>\n";
}

std::string outcome_section(const Outcome& outcome) {
  std::string html = "<h2>" + escape_html(outcome.paper + ": " + outcome.title) +
                     "</h2>\n<p class=\"note\">" + escape_html(outcome.data) + "</p>\n";
  if (!outcome.figures.empty()) {
    html +=
        "<div class=\"scroll\"><table><thead><tr><th class=\"name\">experiment</th><th "
        "class=\"name\">figure</th><th>paper</th><th>ours (95 % interval)</th><th>bar</th>"
        "<th>verdict</th></tr></thead><tbody>\n";
    for (const Figure& figure : outcome.figures) html += figure_row(figure);
    html += "</tbody></table></div>\n";
  }
  for (const std::string& note : outcome.notes) {
    html += "<p class=\"note\">" + escape_html(note) + "</p>\n";
  }
  if (!outcome.charts.empty()) {
    html += "<div class=\"charts\">\n";
    for (const eval::LineChart& chart : outcome.charts) html += chart_card(chart);
    html += "</div>\n";
  }
  return html;
}

}  // namespace

std::string to_text(const std::vector<Outcome>& outcomes) {
  std::string text;
  for (const Outcome& outcome : outcomes) {
    text += fmt::format("{}{}: {}\n  {}\n", text.empty() ? "" : "\n", outcome.paper, outcome.title,
                        outcome.data);
    text += fmt::format("  {:<6} {:<48} {:>16} {:>26} {:>9}  {}\n", "ID", "FIGURE", "PAPER",
                        "OURS [95 %]", "BAR", "VERDICT");
    for (const Figure& figure : outcome.figures) {
      text += fmt::format("  {:<6} {:<48} {:>16} {:>26} {:>9}  {}\n", figure.id, figure.what,
                          paper_text(figure), ours_text(figure), bar_text(figure), verdict(figure));
      if (!figure.note.empty()) text += "         " + figure.note + "\n";
    }
    for (const std::string& note : outcome.notes) text += "  note: " + note + "\n";
  }
  return text;
}

std::string to_json(const std::vector<Outcome>& outcomes, const std::string& command) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Outcome& outcome : outcomes) {
    nlohmann::ordered_json figures = nlohmann::ordered_json::array();
    for (const Figure& figure : outcome.figures) figures.push_back(figure_json(figure));
    list.push_back({{"paper", outcome.paper},
                    {"title", outcome.title},
                    {"data", outcome.data},
                    {"figures", figures},
                    {"notes", outcome.notes}});
  }
  const Tally counted = tally(outcomes);
  return nlohmann::ordered_json{
             {"command", command},
             {"outcomes", list},
             {"bars", {{"reached", counted.reached}, {"judged", counted.judged}}}}
             .dump(2) +
         "\n";
}

std::string to_html(const std::vector<Outcome>& outcomes, const std::string& command) {
  const Tally counted = tally(outcomes);
  std::string body = "<header><h1>The four papers, repeated</h1><div class=\"command\">" +
                     escape_html(command) + "</div></header>\n";
  body += fmt::format(
      "<p class=\"lead\">{} of {} bars reached. Beside each other: the paper's figure, ours with "
      "its 95 % bootstrap interval over whole walks, and the bar it is held to.</p>\n",
      counted.reached, counted.judged);
  for (const Outcome& outcome : outcomes) body += outcome_section(outcome);
  return eval::report_page("The four papers, repeated", body);
}

}  // namespace waylode::experiment
