// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/step_counting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "waylode/experiment/bootstrap.hpp"
#include "waylode/pdr/cadence_step_detector.hpp"
#include "waylode/pdr/gravity_filter.hpp"
#include "waylode/pdr/step_detector.hpp"

namespace waylode::experiment {
namespace {

CountedRecording count_steps_of(const StepRecording& recording, pdr::StepSource& detector) {
  CountedRecording result{recording.name, recording.placement, 0, recording.steps.size(), 0.0, 0.0};
  pdr::GravityFilter gravity{pdr::GravityFilter::Options{}};
  for (const sample::AccelerometerSample& sample : recording.samples) {
    gravity.add(sample);
    if (!gravity.up_in_device()) continue;
    pdr::StepInput input;
    input.time = sample.time;
    input.vertical_mps2 =
        sample.specific_force_mps2.dot(*gravity.up_in_device()) - pdr::kStandardGravity_mps2;
    input.norm_mps2 = sample.specific_force_mps2.norm() - pdr::kStandardGravity_mps2;
    const std::optional<pdr::Step> step = detector.add(input);
    if (!step) continue;
    ++result.counted;
    result.longest_delay_s =
        std::max(result.longest_delay_s, core::to_seconds(sample.time - step->time));
  }
  const auto walked = static_cast<double>(result.walked);
  result.error_ratio = (static_cast<double>(result.counted) - walked) / walked;
  return result;
}

std::vector<PlacementCount> by_placement(const std::vector<CountedRecording>& recordings) {
  std::map<std::string, PlacementCount> placements;
  for (const CountedRecording& recording : recordings) {
    PlacementCount& entry = placements[recording.placement];
    entry.placement = recording.placement;
    ++entry.recordings;
    entry.mean_abs_error_ratio += std::abs(recording.error_ratio);
  }
  std::vector<PlacementCount> result;
  for (const auto& [name, entry] : placements) {
    result.push_back(entry);
    result.back().mean_abs_error_ratio /= static_cast<double>(entry.recordings);
  }
  return result;
}

}  // namespace

StepCounting count_steps(const std::vector<StepRecording>& recordings,
                         const StepSourceFactory& make_detector) {
  StepCounting result;
  for (const StepRecording& recording : recordings) {
    if (recording.steps.empty()) continue;
    result.recordings.push_back(count_steps_of(recording, *make_detector()));
  }
  for (const CountedRecording& recording : result.recordings) {
    const auto count = static_cast<double>(result.recordings.size());
    result.mean_abs_error_ratio += std::abs(recording.error_ratio) / count;
    result.mean_error_ratio += recording.error_ratio / count;
  }
  result.placements = by_placement(result.recordings);
  return result;
}

core::Result<Outcome> step_counting_outcome(const std::vector<StepRecording>& recordings) {
  if (recordings.empty()) {
    return core::fail(core::ErrorCode::kLogLacksRecords, "no recording to count steps of",
                      "step counting");
  }
  const StepCounting cadence = count_steps(recordings, [] {
    return std::make_unique<pdr::CadenceStepDetector>(pdr::CadenceStepDetector::Options());
  });
  const StepCounting threshold = count_steps(
      recordings, [] { return std::make_unique<pdr::StepDetector>(pdr::StepDetector::Options()); });
  Outcome outcome;
  outcome.paper = "zhong2017";
  outcome.title = "Step counting on real walks";
  outcome.data = std::to_string(cadence.recordings.size()) +
                 " recordings with foot switches as truth, counted causally";
  const auto add = [&](const std::string& what, const StepCounting& counting,
                       const std::optional<std::string>& placement) {
    std::vector<Unit> units;
    for (const CountedRecording& counted : counting.recordings) {
      if (placement && counted.placement != *placement) continue;
      units.push_back({100.0 * std::abs(counted.error_ratio)});
    }
    Figure figure;
    figure.id = std::string("R-2.2");
    figure.what = what;
    figure.unit = std::string("%");
    figure.ours = bootstrap(units, mean_of);
    outcome.figures.push_back(std::move(figure));
  };
  add("mean absolute count error, cadence", cadence, std::nullopt);
  outcome.figures.back().bar = Bar{Bar::Sense::kAtMost, 2.0};
  add("mean absolute count error, threshold", threshold, std::nullopt);
  for (const PlacementCount& placement : cadence.placements) {
    add("cadence, " + placement.placement, cadence, placement.placement);
    add("threshold, " + placement.placement, threshold, placement.placement);
  }
  return outcome;
}

}  // namespace waylode::experiment
