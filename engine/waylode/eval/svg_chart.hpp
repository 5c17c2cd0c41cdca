// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"

namespace waylode::eval {

/// What svg_line_chart draws into.
inline constexpr double kChartWidth_px = 560.0;
inline constexpr double kChartHeight_px = 340.0;

/// One method's line.
struct Series {
  std::size_t method = 0;
  std::string name;
  std::vector<core::Vector2> points;  ///< In the axes' units, x ascending.
  bool with_dots = false;
  bool with_line = true;
  std::vector<double> half_widths{};  ///< Of vertical error bars, per point; empty for none.
};

struct Axis {
  std::string label;  ///< With its unit.
  std::string unit;   ///< For the hover readout.
  double max = 1.0;
  double tick = 1.0;
  double min = 0.0;                        ///< A multiple of `tick`, below `max`.
  std::vector<std::string> tick_labels{};  ///< Instead of the numbers, from `min` on.
};

/// An axis over [least, most] widened to whole ticks, about `ticks` of them.
Axis axis_over(double least, double most, int ticks, std::string label, std::string unit);

struct LineChart {
  std::string title;
  Axis x;
  Axis y;
  std::vector<double> y_guides;  ///< Dashed lines across the plot.
  bool with_diagonal = false;    ///< From the lower left corner to (x.max, y.max).
  bool equal_scales = false;     ///< A plan: one metre is as long on both axes.
  std::vector<Series> series;
};

/// An <svg> whose colours come from the page's style. Lines are cut at the plot's edges.
std::string svg_line_chart(const LineChart& chart);

/// 1, 2 or 5 times a power of ten, such that about `count` of them make `range` > 0.
double nice_step(double range, int count);

/// "c<colour> k<dash>": the classes that give a method its look.
std::string method_classes(std::size_t method);

}  // namespace waylode::eval
