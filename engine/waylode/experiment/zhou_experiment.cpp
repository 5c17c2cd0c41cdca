// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "waylode/experiment/paper_experiments.hpp"
#include "waylode/experiment/room_walks.hpp"

namespace waylode::experiment {
namespace {

constexpr const char* kWifi = "Wi-Fi";
constexpr const char* kMagnetic = "magnetic";
constexpr const char* kSteps = "steps from Wi-Fi start";
constexpr const char* kStepsKnown = "steps from known start";
constexpr const char* kFused = "fused";
constexpr const char* kIntervals = "as published";
constexpr const char* kUnfiltered = "as published, before the filter";

std::vector<Contender> contenders(bool told_start) {
  return {
      {kWifi, "wknn+radio=window_knn"},
      {kMagnetic, "zhou2016+fusion=magnetic", told_start},
      {kSteps, "zhou2016+magnetic=none+fusion=dead_reckoning"},
      {kStepsKnown, "zhou2016+magnetic=none+fusion=dead_reckoning", true},
      {kFused, "zhou2016", told_start},
      {kIntervals, "zhou2016+fusion=intervals", told_start},
      {kUnfiltered, "zhou2016+fusion=intervals_unfiltered", told_start},
      {"Waylode's own", "fused"},
  };
}

/// Mean, share within 1 m and within 3 m of one method beside the paper's three figures.
void add_three(const Trials& trials, const char* label, const char* id, const char* mean,
               const char* within_1, const char* within_3, std::vector<Figure>& figures) {
  figures.push_back(mean_figure(trials, label, id, mean));
  figures.push_back(within_figure(trials, label, 1.0, id, within_1));
  figures.push_back(within_figure(trials, label, 3.0, id, within_3));
}

core::Result<Outcome> corridor(const std::string& name, ZhouPreset preset,
                               const SimulationRequest& request,
                               const core::ProgressSink& progress) {
  const std::size_t walks = walks_for_percentages(request);
  const bool judged = preset == ZhouPreset::kA;
  // The hard set asks what the field does once the start is known.
  const auto trials = run_trials([&](std::uint64_t seed) { return zhou_corridor(preset, seed); },
                                 request.first_seed, walks, 0.5, contenders(!judged),
                                 options_for_rooms(request), progress);
  if (!trials) return tl::unexpected(trials.error());
  Outcome outcome;
  outcome.paper = "zhou2016";
  outcome.title = "Corridor, preset " + name;
  outcome.data = "simulation, 30 m x 3 m, 4 access points, " + std::to_string(walks) +
                 " walks there and back, two fixes a second";
  std::vector<Figure>& figures = outcome.figures;
  add_three(*trials, kWifi, "Z-X1", "2.75", "18", "57", figures);
  add_three(*trials, kMagnetic, "Z-X2", "1.64", "34", "91", figures);
  add_three(*trials, kSteps, "Z-X3", "1.63", "24", "78", figures);
  add_three(*trials, kStepsKnown, "Z-X3", "1.63", "24", "78", figures);
  const std::size_t fused_at = figures.size();
  add_three(*trials, kFused, "Z-X4", "1.0", "50", "97", figures);
  figures[fused_at].note = "one Kalman filter of Wi-Fi, field and steps as they are";
  add_three(*trials, kIntervals, "Z-X4", "1.0", "50", "97", figures);
  figures[fused_at + 3].note =
      "weights by inverse variance, blended speed and heading, filter behind";
  figures.push_back(mean_figure(*trials, kUnfiltered, "Z-X4", "1.3"));
  figures.push_back(mean_figure(*trials, "Waylode's own", "Z-X4", ""));
  if (judged) {
    figures[0].bar = Bar{Bar::Sense::kAtLeast, 2.4};
    figures[0].note = "a check of the room: an easier one would prove nothing";
    figures[3].bar = Bar{Bar::Sense::kAtMost, 1.64};
    figures[5].bar = Bar{Bar::Sense::kAtLeast, 91.0};
    figures[fused_at].bar = Bar{Bar::Sense::kAtMost, 1.0};
    figures[fused_at + 1].bar = Bar{Bar::Sense::kAtLeast, 50.0};
    figures[fused_at + 2].bar = Bar{Bar::Sense::kAtLeast, 97.0};
  }
  constexpr double kMost_m = 6.0;
  outcome.charts = {error_curves(*trials, kMost_m), mean_bars(*trials), example_tracks(*trials)};
  return outcome;
}

}  // namespace

core::Result<std::vector<Outcome>> run_zhou2016(const SimulationRequest& request,
                                                const core::ProgressSink& progress) {
  std::vector<Outcome> outcomes;
  const std::array<std::pair<const char*, ZhouPreset>, 2> presets = {
      {{"A", ZhouPreset::kA}, {"H", ZhouPreset::kH}}};
  for (const auto& [name, preset] : presets) {
    if (request.preset && *request.preset != name) continue;
    auto outcome = corridor(name, preset, request, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  return outcomes;
}

}  // namespace waylode::experiment
