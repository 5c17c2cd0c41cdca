// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "waylode/experiment/corridor_regression.hpp"
#include "waylode/experiment/kernel_regression.hpp"
#include "waylode/experiment/paper_experiments.hpp"
#include "waylode/experiment/room_walks.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::experiment {
namespace {

constexpr const char* kRvr = "Wi-Fi, relevance vectors";
constexpr const char* kWknn = "Wi-Fi, weighted nearest";
constexpr const char* kSteps = "steps from Wi-Fi start";
constexpr const char* kLiteral = "feedback without guard (literal)";
constexpr const char* kFused = "fused";

const std::vector<Contender>& contenders() {
  static const std::vector<Contender> all = {
      {kRvr, "wknn+radio=relevance_vectors"},
      {kWknn, "wknn+radio=knn"},
      {kSteps, "zhao2019+fusion=dead_reckoning"},
      {"steps from true start", "zhao2019+fusion=dead_reckoning", true},
      {kLiteral, "zhao2019+fusion=feedback_literal"},
      {kFused, "zhao2019"},
      {"Waylode's own", "fused"},
  };
  return all;
}

/// How many survey points a fix compares, in the circle and on the whole map [Zhao2019] 2.3.
core::Result<Figure> comparisons(ZhaoPreset preset, std::uint64_t seed) {
  const auto room = zhao_square(preset, seed);
  if (!room) return tl::unexpected(room.error());
  const auto map = radio::ReferenceMap::create(room->site.radio_map(), {});
  if (!map) return tl::unexpected(map.error());
  std::vector<Unit> counts;
  for (const sim::TruthState& truth : room->walk.truth) {
    std::size_t near = 0;
    for (const radio::ReferenceMap::Point& point : map->points()) {
      constexpr double kRadius_m = 2.0;
      if ((point.position_m - truth.position_m).norm() <= kRadius_m) ++near;
    }
    counts.push_back({static_cast<double>(near)});
  }
  Figure figure;
  figure.id = "R-X6";
  figure.what = "survey points compared per fix, in the circle";
  figure.paper = "fewer";
  figure.ours = bootstrap(counts, mean_of);
  figure.bar = Bar{Bar::Sense::kAtMost, 13.0};
  figure.note = "the whole map has " + std::to_string(map->points().size()) + " points";
  return figure;
}

core::Result<Outcome> square(const std::string& name, ZhaoPreset preset,
                             const SimulationRequest& request, const core::ProgressSink& progress) {
  const std::size_t walks = walks_for_percentages(request);
  constexpr double kStep_s = 0.55;
  const auto trials = run_trials([&](std::uint64_t seed) { return zhao_square(preset, seed); },
                                 request.first_seed, walks, kStep_s, contenders(), {}, progress);
  if (!trials) return tl::unexpected(trials.error());
  Outcome outcome;
  outcome.paper = "zhao2019";
  outcome.title = "Square corridor, preset " + name;
  outcome.data =
      "simulation, 10 m x 10 m square, " + std::to_string(walks) + " walks, a fix a step";
  std::vector<Figure>& figures = outcome.figures;
  figures.push_back(mean_figure(*trials, kFused, "R-X4", "1.24"));
  figures.push_back(mean_figure(*trials, kRvr, "R-X4", "2.64"));
  figures.push_back(mean_figure(*trials, kSteps, "R-X4", "1.82"));
  if (preset == ZhaoPreset::kHarsh) {
    figures[0].bar = Bar{Bar::Sense::kAtMost, 1.24};
    figures[1].bar = Bar{Bar::Sense::kAtLeast, 2.6};
    figures[1].note = "a check of the room: an easier one would prove nothing";
    figures[2].bar = Bar{Bar::Sense::kAtLeast, 1.8};
    figures[2].note = figures[1].note;
  }
  for (const char* label : {kWknn, "steps from true start", kLiteral, "Waylode's own"}) {
    figures.push_back(mean_figure(*trials, label, "R-X4", ""));
  }
  auto compared = comparisons(preset, request.first_seed);
  if (!compared) return tl::unexpected(compared.error());
  figures.push_back(*std::move(compared));
  constexpr double kMost_m = 6.0;
  outcome.charts = {error_curves(*trials, kMost_m), mean_bars(*trials), example_tracks(*trials)};
  return outcome;
}

}  // namespace

core::Result<std::vector<Outcome>> run_zhao2019(const SimulationRequest& request,
                                                const core::ProgressSink& progress) {
  std::vector<Outcome> outcomes;
  if (!request.preset || *request.preset == "kernel") {
    KernelRegression::Options options;
    options.first_seed += request.first_seed - 1;
    options.draws = request.seeds;
    auto outcome = kernel_regression_outcome(options);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  if (!request.preset || *request.preset == "corridor") {
    CorridorRegression::Options options;
    options.first_seed += request.first_seed - 1;
    options.draws = walks_for_percentages(request);
    auto outcome = corridor_regression_outcome(options);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  const std::array<std::pair<const char*, ZhaoPreset>, 3> presets = {
      {{"normal", ZhaoPreset::kNormal},
       {"harsh", ZhaoPreset::kHarsh},
       {"harsh_3s", ZhaoPreset::kHarshSlowScans}}};
  for (const auto& [name, preset] : presets) {
    if (request.preset && *request.preset != name) continue;
    auto outcome = square(name, preset, request, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  return outcomes;
}

}  // namespace waylode::experiment
