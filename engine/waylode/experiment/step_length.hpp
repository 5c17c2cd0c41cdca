// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/pdr/step_source.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::experiment {

/// A walk whose length is known from marks, and its steps.
struct MeasuredWalk {
  std::string name;
  double distance_m = 0.0;  ///< Along the marks, straight from one to the next.
  std::vector<pdr::Step> steps;
};

struct Mark {
  core::DeviceTime time;
  core::Vector2 position_m = core::Vector2::Zero();
};

/// The steps between the first and the last mark, by the default detector. nullopt when the walk is
/// too short to judge a step length by: under 8 m, under 8 steps, or implausible (outside 0.35 to
/// 1.0 m per step: marks and steps do not belong together).
std::optional<MeasuredWalk> measure_walk(const std::string& name,
                                         std::span<const sample::Sample> samples,
                                         std::span<const Mark> marks);

/// One step-length model, fitted to the other folds' walks and tried on each.
struct StepLengthResult {
  std::string model;
  std::vector<double> coefficients;         ///< Fitted to all walks; empty for a fixed model.
  std::vector<double> relative_errors_pct;  ///< Signed, per walk, out of fold; fixed: as it is.
};

/// All models on the same walks. Folds are dealt over whole walks in turn, in the order given;
/// coefficients minimise relative errors. kSurveyInsufficient for fewer walks than folds, or fewer
/// than five.
core::Result<std::vector<StepLengthResult>> compare_step_lengths(
    std::span<const MeasuredWalk> walks, std::size_t folds);

/// The comparison beside the paper: improved against Weinberg [Zhao2019] 3.3, over all walks and
/// over the slowest and the fastest fifth by cadence.
core::Result<Outcome> step_length_outcome(std::span<const MeasuredWalk> walks);

}  // namespace waylode::experiment
