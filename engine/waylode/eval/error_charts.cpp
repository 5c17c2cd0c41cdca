// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/error_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "waylode/core/covariance.hpp"
#include "waylode/eval/detail/quantile.hpp"
#include "waylode/eval/svg_chart.hpp"

namespace waylode::eval::detail {
namespace {

constexpr double kCdfTop = 0.95;  // The x axis reaches this quantile of the widest method.
constexpr int kCdfPoints = 200;
constexpr double kShortest_s = 5.0;
constexpr std::size_t kFewestInBin = 3;  // A mean of fewer says nothing.

constexpr std::array kStatedProbabilities = {0.1, 0.2, 0.3, 0.4,  0.5, 0.6,
                                             0.7, 0.8, 0.9, 0.95, 0.99};

template <typename Value>
std::vector<double> sorted_values(const std::vector<PointError>& errors, Value value) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const PointError& error : errors) values.push_back(error.*value);
  std::sort(values.begin(), values.end());
  return values;
}

Axis axis_to(double most, int ticks, std::string label, std::string unit) {
  return axis_over(0.0, most, ticks, std::move(label), std::move(unit));
}

Axis percent_axis(std::string label) { return {std::move(label), "%", 100.0, 20.0}; }

/// Mean error in each span of `bin_s`, placed at its middle; spans with too few are left out.
std::vector<core::Vector2> mean_by_time(const std::vector<PointError>& errors, double bin_s,
                                        std::size_t bin_count) {
  std::vector<std::vector<double>> bins(bin_count);
  for (const PointError& error : errors) {
    const auto bin = static_cast<std::size_t>(std::max(0.0, error.since_start_s) / bin_s);
    if (bin < bin_count) bins[bin].push_back(error.horizontal_m);
  }
  std::vector<core::Vector2> points;
  for (std::size_t i = 0; i < bin_count; ++i) {
    if (bins[i].size() < kFewestInBin) continue;
    points.emplace_back((static_cast<double>(i) + 0.5) * bin_s, mean(bins[i]));
  }
  return points;
}

/// One curve per method through the quantiles of its sorted values.
std::string cdf_svg(const std::vector<MethodErrors>& methods,
                    const std::vector<std::vector<double>>& sorted_m, const char* title,
                    const char* x_label, const char* y_label) {
  LineChart chart;
  chart.title = title;
  double most_m = 0.0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (sorted_m[m].empty()) continue;
    Series series{m, methods[m].name, {core::Vector2::Zero()}, false};
    for (int i = 0; i <= kCdfPoints; ++i) {
      const double probability = static_cast<double>(i) / kCdfPoints;
      series.points.emplace_back(quantile(sorted_m[m], probability), 100.0 * probability);
    }
    most_m = std::max(most_m, quantile(sorted_m[m], kCdfTop));
    chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) return {};
  chart.x = axis_to(most_m, 8, x_label, "m");
  chart.y = percent_axis(y_label);
  chart.y_guides = {50.0, 90.0};
  return svg_line_chart(chart);
}

}  // namespace

std::string error_cdf_svg(const std::vector<MethodErrors>& methods) {
  std::vector<std::vector<double>> errors_m;
  for (const MethodErrors& method : methods) {
    errors_m.push_back(sorted_values(method.errors, &PointError::horizontal_m));
  }
  return cdf_svg(methods, errors_m, "Cumulative distribution of the error", "error (m)",
                 "share of positions (%)");
}

std::string recording_cdf_svg(const std::vector<MethodErrors>& methods) {
  std::vector<std::vector<double>> means_m;
  std::size_t most = 0;
  for (const MethodErrors& method : methods) {
    means_m.push_back(method.track_means_m);
    std::sort(means_m.back().begin(), means_m.back().end());
    most = std::max(most, means_m.back().size());
  }
  if (most < 2) return {};
  return cdf_svg(methods, means_m, "Cumulative distribution of the mean error of recordings",
                 "mean error of a recording (m)", "share of recordings (%)");
}

std::string reliability_svg(const std::vector<MethodErrors>& methods) {
  LineChart chart;
  chart.title = "Reliability of the stated regions";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto squared = sorted_values(methods[m].errors, &PointError::squared_mahalanobis);
    if (squared.empty()) continue;
    Series series{m, methods[m].name, {}, true};
    for (const double stated : kStatedProbabilities) {
      const auto inside =
          std::upper_bound(squared.begin(), squared.end(), core::chi_square_2_quantile(stated)) -
          squared.begin();
      series.points.emplace_back(100.0 * stated, 100.0 * static_cast<double>(inside) /
                                                     static_cast<double>(squared.size()));
    }
    chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) return {};
  chart.x = percent_axis("stated probability (%)");
  chart.y = percent_axis("truths inside the region (%)");
  chart.with_diagonal = true;
  return svg_line_chart(chart);
}

std::string error_over_time_svg(const std::vector<MethodErrors>& methods) {
  constexpr double kTimesShown = 0.98;
  std::vector<double> times_s;
  for (const MethodErrors& method : methods) {
    for (const PointError& error : method.errors) times_s.push_back(error.since_start_s);
  }
  std::sort(times_s.begin(), times_s.end());
  const double longest_s = times_s.empty() ? 0.0 : quantile(times_s, kTimesShown);
  if (longest_s < kShortest_s) return {};
  LineChart chart;
  chart.title = "Mean error over time since the start";
  const double bin_s = std::max(kShortest_s, nice_step(longest_s, 12));
  chart.x = axis_to(longest_s, 8, "time since the track's first truth (s)", "s");
  double most_m = 0.0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    Series series{m, methods[m].name, {}, true};
    series.points = mean_by_time(methods[m].errors, bin_s,
                                 static_cast<std::size_t>(std::ceil(chart.x.max / bin_s)));
    for (const core::Vector2& point : series.points) most_m = std::max(most_m, point.y());
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) return {};
  chart.y = axis_to(most_m, 6, "mean error (m)", "m");
  return svg_line_chart(chart);
}

}  // namespace waylode::eval::detail
