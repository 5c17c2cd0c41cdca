// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/sim/scenario.hpp"

namespace waylode::sim {

/// Where the walker really was.
struct TruthState {
  core::DeviceTime time;
  core::FloorId floor;
  core::Vector2 position_m;  ///< Floor frame.
  double heading_rad = 0.0;  ///< Of the body, counter-clockwise from +x, in (-pi, pi].
  double speed_mps = 0.0;    ///< Horizontal.
  bool operator==(const TruthState&) const = default;
};

/// One step: from a heel strike to the next one.
struct StepTruth {
  core::DeviceTime time;     ///< Of the strike that ends it.
  double length_m = 0.0;     ///< Horizontal.
  bool is_effective = true;  ///< Leads on; false for stepping in place, whose length is 0.
  bool operator==(const StepTruth&) const = default;
};

struct SimulatedRecording {
  std::string walker;
  bool is_survey = false;
  sample::RecordingInfo info;
  std::vector<sample::Sample> samples;  ///< Ordered by time.
  std::vector<TruthState> truth;        ///< At 10 Hz.
  std::vector<StepTruth> steps;
};

struct Simulation {
  Building building;
  std::vector<SimulatedRecording> recordings;  ///< In the order of Scenario::walkers.
};

/// Runs all walkers. Deterministic: the scenario's seed and a walker's name and options decide that
/// walker's recording, whoever else walks. `progress` counts walkers.
/// kScenarioInvalid for what `validate` finds and for places with no way between them.
core::Result<Simulation> simulate(const Scenario& scenario,
                                  const core::ProgressSink& progress = {});

}  // namespace waylode::sim
