// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/pdr/step_source.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::experiment {

/// An accelerometer worn while walking, and the footfalls by an instrument of their own.
struct StepRecording {
  std::string name;
  std::string placement;  ///< Where the phone was worn.
  std::string phone;
  std::vector<sample::AccelerometerSample> samples;  ///< By time.
  std::vector<core::DeviceTime> steps;               ///< Truth, by time.
};

/// A detector without history; one is made per recording.
using StepSourceFactory = std::function<std::unique_ptr<pdr::StepSource>()>;

struct CountedRecording {
  std::string name;
  std::string placement;
  std::size_t counted = 0;
  std::size_t walked = 0;
  double error_ratio = 0.0;      ///< (counted - walked) / walked.
  double longest_delay_s = 0.0;  ///< From a step's time to the sample at which it was told.
};

struct PlacementCount {
  std::string placement;
  std::size_t recordings = 0;
  double mean_abs_error_ratio = 0.0;
};

struct StepCounting {
  std::vector<CountedRecording> recordings;  ///< In the order given.
  std::vector<PlacementCount> placements;    ///< By name.
  double mean_abs_error_ratio = 0.0;         ///< Every recording counts alike.
  double mean_error_ratio = 0.0;             ///< The same with its sign: the bias.
};

/// Runs a detector over recordings sample by sample, as it would run on the phone. Recordings
/// without a true step have no relative error and are left out; no figure is made of none (0).
StepCounting count_steps(const std::vector<StepRecording>& recordings,
                         const StepSourceFactory& make_detector);

/// Counted by the detector for any placement, and by the default one for comparison, placement by
/// placement; the bar is the first one's mean over all recordings. kLogLacksRecords without
/// recordings.
core::Result<Outcome> step_counting_outcome(const std::vector<StepRecording>& recordings);

}  // namespace waylode::experiment
