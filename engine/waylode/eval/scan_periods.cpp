// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/scan_periods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "waylode/eval/svg_chart.hpp"
#include "waylode/eval/svg_file.hpp"

namespace waylode::eval {
namespace {

Series& series_of(std::vector<Series>& all, const std::string& method) {
  for (Series& series : all) {
    if (series.name == method) return series;
  }
  all.push_back({all.size(), method, {}, true});
  return all.back();
}

LineChart chart_of(const std::vector<ScanPeriodRows>& periods, const std::string& group) {
  LineChart chart;
  chart.title = "Mean error by scan period";
  chart.x = {"least time between Wi-Fi scans", "", 0.5, 1.0, 0.0};
  chart.x.max = std::max(1.0, static_cast<double>(periods.size()) - 1.0);
  double most_m = 0.0;
  for (std::size_t i = 0; i < periods.size(); ++i) {
    chart.x.tick_labels.push_back(
        periods[i].period_s > 0.0 ? fmt::format("{:g} s", periods[i].period_s) : "as recorded");
    for (const ResultRow& row : periods[i].rows) {
      if (row.group != group || !std::isfinite(row.metrics.mean_m)) continue;
      series_of(chart.series, row.method)
          .points.emplace_back(static_cast<double>(i), row.metrics.mean_m);
      most_m = std::max(most_m, row.metrics.mean_m);
    }
  }
  chart.y = axis_over(0.0, most_m, 6, "mean error (m)", "m");
  return chart;
}

}  // namespace

std::string scan_period_svg(const std::vector<ScanPeriodRows>& periods, const std::string& group) {
  const LineChart chart = chart_of(periods, group);
  return chart.series.empty() ? std::string() : svg_line_chart(chart);
}

std::string scan_period_svg_file(const std::vector<ScanPeriodRows>& periods,
                                 const std::string& group) {
  const LineChart chart = chart_of(periods, group);
  std::vector<LegendEntry> legend;
  for (const Series& series : chart.series) {
    legend.push_back({method_classes(series.method), series.name});
  }
  return svg_file({{kChartWidth_px, kChartHeight_px, svg_line_chart(chart)}},
                  fmt::format("Mean error by scan period ({})", group), legend);
}

}  // namespace waylode::eval
