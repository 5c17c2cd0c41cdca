// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "waylode/eval/html.hpp"

namespace waylode::eval {
namespace {

constexpr std::size_t kColourCount = 8;
constexpr double kLeft_px = 54.0;
constexpr double kRight_px = 542.0;
constexpr double kTop_px = 16.0;
constexpr double kBottom_px = 292.0;

/// Axes' units to pixels.
struct Scale {
  const Axis& x;
  const Axis& y;

  double x_px(double value) const {
    return kLeft_px + (kRight_px - kLeft_px) * (value - x.min) / (x.max - x.min);
  }
  double y_px(double value) const {
    return kBottom_px - (kBottom_px - kTop_px) * (value - y.min) / (y.max - y.min);
  }
};

/// Widens one axis until a unit is as long on both.
void equalise(Axis& x, Axis& y) {
  const double wide = (x.max - x.min) / (kRight_px - kLeft_px);
  const double high = (y.max - y.min) / (kBottom_px - kTop_px);
  Axis& tight = wide > high ? y : x;
  const double lack = wide > high ? wide * (kBottom_px - kTop_px) - (y.max - y.min)
                                  : high * (kRight_px - kLeft_px) - (x.max - x.min);
  const double below = tight.tick * std::round(0.5 * lack / tight.tick);
  tight.min -= below;
  tight.max += lack - below;
}

std::string line(const char* css, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>", css,
                     coordinate(x1), coordinate(y1), coordinate(x2), coordinate(y2));
}

std::string text(const char* css, double x, double y, const std::string& content) {
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>", css, coordinate(x),
                     coordinate(y), escape_html(content));
}

std::string tick_label(const Axis& axis, int tick) {
  const auto index = static_cast<std::size_t>(tick);
  if (index < axis.tick_labels.size()) return axis.tick_labels[index];
  return fmt::format("{:.4g}", axis.min + tick * axis.tick);
}

std::string axes_svg(const LineChart& chart, const Scale& scale) {
  constexpr double kRounding = 1e-9;  // So that the last tick is not lost to rounding.
  std::string svg;
  for (int i = 0; i <= (chart.x.max - chart.x.min) / chart.x.tick * (1.0 + kRounding); ++i) {
    const double x = chart.x.min + i * chart.x.tick;
    svg += line("grid", scale.x_px(x), kTop_px, scale.x_px(x), kBottom_px);
    svg += text("tick mid", scale.x_px(x), kBottom_px + 17.0, tick_label(chart.x, i));
  }
  for (int i = 0; i <= (chart.y.max - chart.y.min) / chart.y.tick * (1.0 + kRounding); ++i) {
    const double y = chart.y.min + i * chart.y.tick;
    svg += line("grid", kLeft_px, scale.y_px(y), kRight_px, scale.y_px(y));
    svg += text("tick end", kLeft_px - 7.0, scale.y_px(y) + 4.0, tick_label(chart.y, i));
  }
  svg += line("axis", kLeft_px, kBottom_px, kRight_px, kBottom_px);
  svg += line("axis", kLeft_px, kTop_px, kLeft_px, kBottom_px);
  svg += text("label mid", 0.5 * (kLeft_px + kRight_px), kChartHeight_px - 10.0, chart.x.label);
  const double middle_px = 0.5 * (kTop_px + kBottom_px);
  svg +=
      fmt::format("<text class=\"label mid\" transform=\"translate(15 {}) rotate(-90)\">{}</text>",
                  coordinate(middle_px), escape_html(chart.y.label));
  return svg;
}

std::string guides_svg(const LineChart& chart, const Scale& scale) {
  std::string svg;
  for (const double y : chart.y_guides) {
    svg += line("guide", kLeft_px, scale.y_px(y), kRight_px, scale.y_px(y));
    svg += text("guidelabel", kLeft_px + 5.0, scale.y_px(y) - 5.0,
                fmt::format("{:g} {}", y, chart.y.unit));
  }
  if (chart.with_diagonal) svg += line("guide", kLeft_px, kBottom_px, kRight_px, kTop_px);
  return svg;
}

std::string series_svg(const Series& series, const Scale& scale) {
  std::string points;
  std::string dots;
  std::string bars;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const core::Vector2& point = series.points[i];
    const std::string x = coordinate(scale.x_px(point.x()));
    const std::string y = coordinate(scale.y_px(point.y()));
    points += (points.empty() ? "" : " ") + x + "," + y;
    if (series.with_dots) dots += "M" + x + " " + y + "h0";
    if (i < series.half_widths.size()) {
      bars += "M" + x + " " + coordinate(scale.y_px(point.y() - series.half_widths[i])) + "V" +
              coordinate(scale.y_px(point.y() + series.half_widths[i]));
    }
  }
  std::string svg =
      fmt::format("<g class=\"{}\" data-m=\"{}\" data-name=\"{}\">", method_classes(series.method),
                  series.method, escape_html(series.name));
  if (series.with_line) svg += "<polyline class=\"line\" points=\"" + points + "\"/>";
  if (!dots.empty()) svg += "<path class=\"dots\" d=\"" + dots + "\"/>";
  if (!bars.empty()) svg += "<path class=\"line\" d=\"" + bars + "\"/>";
  return svg + "</g>";
}

/// What the page's script needs to turn pixels back into the axes' units.
std::string hover_attributes(const LineChart& chart) {
  return fmt::format(
      "data-x0=\"{}\" data-x1=\"{}\" data-y0=\"{}\" data-y1=\"{}\" data-xmin=\"{:g}\" "
      "data-xmax=\"{:g}\" data-ymin=\"{:g}\" data-ymax=\"{:g}\" data-xunit=\"{}\" "
      "data-yunit=\"{}\"",
      coordinate(kLeft_px), coordinate(kRight_px), coordinate(kBottom_px), coordinate(kTop_px),
      chart.x.min, chart.x.max, chart.y.min, chart.y.max, escape_html(chart.x.unit),
      escape_html(chart.y.unit));
}

}  // namespace

Axis axis_over(double least, double most, int ticks, std::string label, std::string unit) {
  constexpr double kNarrowest = 1e-3;
  constexpr double kRounding = 1e-9;
  const double tick = nice_step(std::max(most - least, kNarrowest), ticks);
  Axis axis{std::move(label), std::move(unit), tick * std::ceil(most / tick - kRounding), tick,
            tick * std::floor(least / tick + kRounding)};
  if (axis.max <= axis.min) axis.max = axis.min + tick;
  return axis;
}

std::string svg_line_chart(const LineChart& drawn) {
  LineChart chart = drawn;
  if (chart.equal_scales) equalise(chart.x, chart.y);
  const Scale scale{chart.x, chart.y};
  std::string svg = fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" {}>",
      kChartWidth_px, kChartHeight_px, escape_html(chart.title), hover_attributes(chart));
  svg += axes_svg(chart, scale) + guides_svg(chart, scale);
  // A nested <svg> clips to its own box, without an id to keep unique.
  svg += fmt::format(
      "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">",
      kLeft_px, kTop_px - 4.0, kRight_px - kLeft_px + 4.0, kBottom_px - kTop_px + 8.0);
  for (const Series& series : chart.series) svg += series_svg(series, scale);
  svg += "</svg>" + line("cursor", kLeft_px, kTop_px, kLeft_px, kBottom_px);
  return svg + "</svg>\n";
}

double nice_step(double range, int count) {
  const double raw = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double leading = raw / power;
  if (leading <= 1.0) return power;
  if (leading <= 2.0) return 2.0 * power;
  return leading <= 5.0 ? 5.0 * power : 10.0 * power;
}

std::string method_classes(std::size_t method) {
  return fmt::format("c{} k{}", method % kColourCount, (method / 4) % 3);
}

}  // namespace waylode::eval
