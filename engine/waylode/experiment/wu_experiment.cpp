// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include "waylode/experiment/paper_experiments.hpp"
#include "waylode/experiment/room_walks.hpp"

namespace waylode::experiment {
namespace {

constexpr const char* kFingerprint = "fingerprint";
constexpr const char* kSteps = "steps";
constexpr const char* kFused = "fused";

const std::vector<Contender>& contenders() {
  static const std::vector<Contender> all = {
      {kFingerprint, "wknn+radio=region_wknn"},
      {"fingerprint, whole map", "wknn+radio=knn"},
      {kSteps, "wu2019+stride=improved+fusion=dead_reckoning"},
      {kFused, "wu2019"},
      {"fused when far apart", "wu2019+fusion=unscented_when_large"},
      {"last pairs (literal)", "wu2019+fusion=pairs"},
      {"Waylode's own", "fused"},
  };
  return all;
}

std::string data_of(const std::string& room, std::size_t walks) {
  return "simulation, " + room + ", " + std::to_string(walks) + " walks, one fix a second";
}

void add_charts(const Trials& trials, Outcome& outcome) {
  constexpr double kMost_m = 5.0;
  outcome.charts = {error_curves(trials, kMost_m), mean_bars(trials), example_tracks(trials)};
}

/// The paper's car park: three routers, a fixed route [Wu2019] 3.
core::Result<Outcome> car_park(const std::string& name, WuPreset preset,
                               const SimulationRequest& request,
                               const core::ProgressSink& progress) {
  const std::size_t walks = walks_for_percentages(request);
  const auto trials =
      run_trials([&](std::uint64_t seed) { return wu_room(preset, seed); }, request.first_seed,
                 walks, 1.0, contenders(), options_for_rooms(request), progress);
  if (!trials) return tl::unexpected(trials.error());
  Outcome outcome;
  outcome.paper = "wu2019";
  outcome.title = "Car park, preset " + name;
  outcome.data = data_of("16 m x 15.8 m, 3 routers", walks);

  Figure fused = mean_figure(*trials, kFused, "W-X1", "0.80");
  Figure below_fingerprint = reduction_figure(*trials, kFused, kFingerprint, "W-X2", "42");
  Figure below_steps = reduction_figure(*trials, kFused, kSteps, "W-X3", "46");
  if (preset == WuPreset::kI) {
    fused.bar = Bar{Bar::Sense::kAtMost, 0.80};
    below_fingerprint.bar = Bar{Bar::Sense::kAtLeast, 42.0};
    below_steps.bar = Bar{Bar::Sense::kAtLeast, 46.0};
  }
  if (preset == WuPreset::kA) {
    fused.note = "a single realistic scan a fix: 0.8 m is out of reach";
    below_steps.bar = Bar{Bar::Sense::kAtLeast, 15.0};
  }
  outcome.figures = {fused, below_fingerprint, below_steps};
  for (const Contender& contender : contenders()) {
    if (contender.label == kFused) continue;
    const char* paper = contender.label == kFingerprint ? "1.38"
                        : contender.label == kSteps     ? "1.48"
                                                        : "";
    outcome.figures.push_back(mean_figure(*trials, contender.label, "W-X1", paper));
    if (*paper != '\0')
      outcome.figures.back().note = "the paper's figure follows from its percentages";
  }
  add_charts(*trials, outcome);
  return outcome;
}

/// The teaching building: a corridor; the paper draws it and gives no number.
core::Result<Outcome> teaching_building(const SimulationRequest& request,
                                        const core::ProgressSink& progress) {
  const std::size_t walks = walks_for_percentages(request);
  const auto trials = run_trials(
      [](std::uint64_t seed) { return zhou_corridor(ZhouPreset::kA, seed); }, request.first_seed,
      walks, 1.0, contenders(), options_for_rooms(request), progress);
  if (!trials) return tl::unexpected(trials.error());
  Outcome outcome;
  outcome.paper = "wu2019";
  outcome.title = "Teaching building, a corridor";
  outcome.data = data_of("30 m x 3 m, 4 access points", walks);
  for (const char* label : {kFingerprint, kSteps, kFused}) {
    outcome.figures.push_back(mean_figure(*trials, label, "W-X4", ""));
  }
  Figure gain;
  gain.id = "W-X4";
  gain.what = "better single method's mean less the fused one's";
  gain.unit = std::string("m");
  const std::vector<std::vector<Unit>> three = {trials->of(kFingerprint), trials->of(kSteps),
                                                trials->of(kFused)};
  gain.ours = bootstrap(three, [](std::span<const std::vector<double>> values) {
    return std::min(mean_of(values[0]), mean_of(values[1])) - mean_of(values[2]);
  });
  gain.bar = Bar{Bar::Sense::kAtLeast, 0.0};
  outcome.figures.push_back(gain);
  add_charts(*trials, outcome);
  return outcome;
}

}  // namespace

core::Result<std::vector<Outcome>> run_wu2019(const SimulationRequest& request,
                                              const core::ProgressSink& progress) {
  std::vector<Outcome> outcomes;
  const std::array<std::pair<const char*, WuPreset>, 4> presets = {
      {{"I", WuPreset::kI}, {"C", WuPreset::kC}, {"A", WuPreset::kA}, {"D", WuPreset::kD}}};
  for (const auto& [name, preset] : presets) {
    if (request.preset && *request.preset != name) continue;
    auto outcome = car_park(name, preset, request, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  if (!request.preset || *request.preset == "corridor") {
    auto outcome = teaching_building(request, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  return outcomes;
}

}  // namespace waylode::experiment
