// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/step_length.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "waylode/experiment/bootstrap.hpp"
#include "waylode/pdr/gravity_filter.hpp"
#include "waylode/pdr/step_detector.hpp"

namespace waylode::experiment {
namespace {

constexpr double kShortest_m = 8.0;
constexpr std::size_t kFewestSteps = 8;
constexpr double kShortestStep_m = 0.35;
constexpr double kLongestStep_m = 1.0;

/// What a step adds to each column of a linear model of the walked distance.
using StepTerm = double (*)(const pdr::Step&);

double one(const pdr::Step&) { return 1.0; }
double cadence_hz(const pdr::Step& step) { return 1.0 / step.interval_s; }
double swing_root(const pdr::Step& step) { return std::pow(step.swing_mps2, 0.25); }
double mean_time(const pdr::Step& step) { return step.mean_abs_mps2 * step.interval_s; }

struct FittedModel {
  const char* name;
  std::vector<StepTerm> terms;
};

const std::array<FittedModel, 5> kFitted = {{
    {"constant", {one}},
    {"Weinberg", {swing_root}},             // [Weinberg2002], [Zhao2019] eq. (14)
    {"improved", {mean_time, swing_root}},  // [Wu2019] eq. (9), [Zhao2019] eq. (15)
    {"cadence", {one, cadence_hz}},
    {"three terms", {one, cadence_hz, swing_root}},
}};

/// A model with the papers' constants, as they stand.
struct FixedModel {
  const char* name;
  StepTerm length_m;
};

double weinberg_as_printed(const pdr::Step& step) { return 0.3426 * swing_root(step); }
double improved_as_printed(const pdr::Step& step) {
  return 0.1124 * mean_time(step) + 0.2243 * swing_root(step);
}
/// The reading that takes the acceleration with gravity.
double improved_with_gravity(const pdr::Step& step) {
  constexpr double kGravity_mps2 = 9.80665;
  return 0.1124 * kGravity_mps2 * step.interval_s + 0.2243 * swing_root(step);
}

const std::array<FixedModel, 3> kFixed = {{
    {"Weinberg as printed", weinberg_as_printed},
    {"improved as printed", improved_as_printed},
    {"improved, gravity included", improved_with_gravity},
}};

Eigen::MatrixXd design(std::span<const MeasuredWalk> walks, const std::vector<StepTerm>& terms) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(walks.size()),
                                               static_cast<Eigen::Index>(terms.size()));
  for (std::size_t w = 0; w < walks.size(); ++w) {
    for (std::size_t t = 0; t < terms.size(); ++t) {
      double& sum = rows(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(t));
      for (const pdr::Step& step : walks[w].steps) sum += terms[t](step);
    }
  }
  return rows;
}

Eigen::VectorXd distances(std::span<const MeasuredWalk> walks) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(walks.size()));
  for (std::size_t w = 0; w < walks.size(); ++w) {
    column(static_cast<Eigen::Index>(w)) = walks[w].distance_m;
  }
  return column;
}

/// Least squares on relative errors, over the rows where `used` says so.
Eigen::VectorXd fit(const Eigen::MatrixXd& rows, const Eigen::VectorXd& lengths_m,
                    const std::function<bool(Eigen::Index)>& used) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(rows.cols(), rows.cols());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(rows.cols());
  for (Eigen::Index w = 0; w < rows.rows(); ++w) {
    if (!used(w)) continue;
    const Eigen::VectorXd relative = rows.row(w).transpose() / lengths_m(w);
    normal += relative * relative.transpose();
    right += relative;
  }
  return normal.ldlt().solve(right);
}

StepLengthResult cross_validate(const FittedModel& model, std::span<const MeasuredWalk> walks,
                                std::size_t folds) {
  const Eigen::MatrixXd rows = design(walks, model.terms);
  const Eigen::VectorXd lengths_m = distances(walks);
  StepLengthResult result;
  result.model = model.name;
  const Eigen::VectorXd all = fit(rows, lengths_m, [](Eigen::Index) { return true; });
  result.coefficients.assign(all.begin(), all.end());
  const auto fold_count = static_cast<Eigen::Index>(folds);
  std::vector<Eigen::VectorXd> by_fold;
  for (Eigen::Index fold = 0; fold < fold_count; ++fold) {
    by_fold.push_back(fit(rows, lengths_m, [&](Eigen::Index w) { return w % fold_count != fold; }));
  }
  for (Eigen::Index w = 0; w < rows.rows(); ++w) {
    const double told_m = rows.row(w).dot(by_fold[static_cast<std::size_t>(w % fold_count)]);
    result.relative_errors_pct.push_back(100.0 * (told_m / lengths_m(w) - 1.0));
  }
  return result;
}

StepLengthResult apply_as_is(const FixedModel& model, std::span<const MeasuredWalk> walks) {
  StepLengthResult result;
  result.model = model.name;
  for (const MeasuredWalk& walk : walks) {
    double told_m = 0.0;
    for (const pdr::Step& step : walk.steps) told_m += model.length_m(step);
    result.relative_errors_pct.push_back(100.0 * (told_m / walk.distance_m - 1.0));
  }
  return result;
}

double mean_cadence_hz(const MeasuredWalk& walk) {
  std::vector<double> cadences;
  for (const pdr::Step& step : walk.steps) cadences.push_back(cadence_hz(step));
  return quantile_of(cadences, 0.5);
}

/// Absolute errors of the chosen walks, one unit a walk.
std::vector<Unit> absolute_errors(const StepLengthResult& result,
                                  const std::vector<std::size_t>& chosen) {
  std::vector<Unit> units;
  for (const std::size_t w : chosen) units.push_back({std::abs(result.relative_errors_pct[w])});
  return units;
}

const StepLengthResult& find_model(const std::vector<StepLengthResult>& results,
                                   std::string_view name) {
  return *std::ranges::find(results, name, &StepLengthResult::model);
}

/// How much less the improved model errs than Weinberg's, on the same walks.
Figure advantage(const std::vector<StepLengthResult>& results,
                 const std::vector<std::size_t>& chosen, const std::string& where,
                 const std::string& paper) {
  const std::vector<std::vector<Unit>> methods = {
      absolute_errors(find_model(results, "Weinberg"), chosen),
      absolute_errors(find_model(results, "improved"), chosen)};
  Figure figure;
  figure.id = "R-X5";
  figure.what = fmt::format("Weinberg's error less the improved one's, {}", where);
  figure.unit = std::string("%");
  figure.paper = paper;
  figure.ours = bootstrap(methods, [](std::span<const std::vector<double>> values) {
    return mean_of(values[0]) - mean_of(values[1]);
  });
  figure.bar = Bar{Bar::Sense::kAtLeast, 0.0};
  figure.note = "mean absolute error of the walked distance, out of fold";
  return figure;
}

eval::LineChart error_curves(const std::vector<StepLengthResult>& results) {
  eval::LineChart chart;
  chart.title = "Error of the walked distance, out of fold";
  chart.x = eval::axis_over(0.0, 40.0, 8, "error at most (%)", "%");
  chart.y = eval::axis_over(0.0, 100.0, 5, "walks (%)", "%");
  for (std::size_t m = 0; m < kFitted.size(); ++m) {
    eval::Series series;
    series.method = m;
    series.name = results[m].model;
    std::vector<double> sorted;
    for (const double error : results[m].relative_errors_pct) sorted.push_back(std::abs(error));
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      series.points.emplace_back(
          sorted[i], 100.0 * static_cast<double>(i + 1) / static_cast<double>(sorted.size()));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::optional<MeasuredWalk> measure_walk(const std::string& name,
                                         std::span<const sample::Sample> samples,
                                         std::span<const Mark> marks) {
  MeasuredWalk walk;
  walk.name = name;
  for (std::size_t i = 1; i < marks.size(); ++i) {
    walk.distance_m += (marks[i].position_m - marks[i - 1].position_m).norm();
  }
  if (marks.size() < 2 || walk.distance_m < kShortest_m) return std::nullopt;
  pdr::GravityFilter gravity{pdr::GravityFilter::Options()};
  pdr::StepDetector detector{pdr::StepDetector::Options()};
  // Of the first step of a walk nobody knows how long it took: an ordinary one is assumed.
  const double longest_s = pdr::StepDetector::Options().longest_interval_s;
  constexpr double kOrdinaryStep_s = 0.55;
  for (const sample::Sample& sample : samples) {
    if (const auto* rate = std::get_if<sample::GyroscopeSample>(&sample)) gravity.add(*rate);
    const auto* force = std::get_if<sample::AccelerometerSample>(&sample);
    if (force == nullptr) continue;
    gravity.add(*force);
    if (!gravity.up_in_device()) continue;
    const double vertical_mps2 =
        force->specific_force_mps2.dot(*gravity.up_in_device()) - pdr::kStandardGravity_mps2;
    const double norm_mps2 = force->specific_force_mps2.norm() - pdr::kStandardGravity_mps2;
    auto step = detector.add({force->time, vertical_mps2, norm_mps2});
    if (!step || step->time < marks.front().time || step->time > marks.back().time) continue;
    if (step->interval_s >= longest_s) step->interval_s = kOrdinaryStep_s;
    walk.steps.push_back(*step);
  }
  if (walk.steps.size() < kFewestSteps) return std::nullopt;
  const double step_m = walk.distance_m / static_cast<double>(walk.steps.size());
  if (step_m < kShortestStep_m || step_m > kLongestStep_m) return std::nullopt;
  return walk;
}

core::Result<std::vector<StepLengthResult>> compare_step_lengths(
    std::span<const MeasuredWalk> walks, std::size_t folds) {
  constexpr std::size_t kFewestWalks = 5;
  if (folds < 2 || walks.size() < std::max(folds, kFewestWalks)) {
    return core::fail(core::ErrorCode::kSurveyInsufficient,
                      "too few walks to compare step lengths; give at least five, and as many as "
                      "folds",
                      std::to_string(walks.size()) + " walks");
  }
  std::vector<StepLengthResult> results;
  for (const FittedModel& model : kFitted) results.push_back(cross_validate(model, walks, folds));
  for (const FixedModel& model : kFixed) results.push_back(apply_as_is(model, walks));
  return results;
}

core::Result<Outcome> step_length_outcome(std::span<const MeasuredWalk> walks) {
  constexpr std::size_t kFolds = 5;
  const auto results = compare_step_lengths(walks, kFolds);
  if (!results) return tl::unexpected(results.error());

  std::vector<double> cadences_hz;
  for (const MeasuredWalk& walk : walks) cadences_hz.push_back(mean_cadence_hz(walk));
  const double slow_hz = quantile_of(cadences_hz, 0.2);
  const double fast_hz = quantile_of(cadences_hz, 0.8);
  std::vector<std::size_t> all;
  std::vector<std::size_t> slow;
  std::vector<std::size_t> fast;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    all.push_back(w);
    if (cadences_hz[w] <= slow_hz) slow.push_back(w);
    if (cadences_hz[w] >= fast_hz) fast.push_back(w);
  }

  Outcome outcome;
  outcome.paper = "zhao2019";
  outcome.title = "Step-length models on real walks";
  outcome.data = std::to_string(walks.size()) +
                 " recorded walks between surveyed marks, 5 folds of whole walks";
  for (const StepLengthResult& result : *results) {
    Figure figure;
    figure.id = "R-X5";
    figure.what = fmt::format("mean absolute error, {}", result.model);
    figure.unit = std::string("%");
    figure.ours = bootstrap(absolute_errors(result, all), mean_of);
    for (const double coefficient : result.coefficients) {
      figure.note += (figure.note.empty() ? "coefficients " : ", ") + std::to_string(coefficient);
    }
    outcome.figures.push_back(figure);
  }
  outcome.figures.push_back(advantage(*results, all, "all walks", "better in 15 of 16 runs"));
  outcome.figures.push_back(advantage(*results, slow, "slowest fifth", "better in 7 of 8 runs"));
  outcome.figures.push_back(advantage(*results, fast, "fastest fifth", "better in 8 of 8 runs"));
  outcome.charts.push_back(error_curves(*results));
  outcome.notes.emplace_back(
      "Surveyors and phones are shared between folds: optimistic for a new person.");
  return outcome;
}

}  // namespace waylode::experiment
