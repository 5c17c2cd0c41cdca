// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "datasets/alteration.hpp"
#include "datasets/dataset.hpp"
#include "waylode/core/result.hpp"
#include "waylode/eval/evaluated_track.hpp"
#include "waylode/pipeline/method.hpp"

namespace waylode::cli {

/// Begins every session at a place that is wrong by a known distance, in a seeded direction.
struct WrongStart {
  double offset_m = 0.0;  ///< > 0.
  double sigma_m = 2.0;   ///< As the session is told; > 0.
  std::uint64_t seed = 1;
};

struct EvaluationOptions {
  std::vector<pipeline::Method> methods;
  bool floor_known = false;
  unsigned threads = 1;
  Alteration alteration{};  ///< Of the tests.
  /// Fills EvaluatedTrack::path of every track; of tracks that change floor it always is filled.
  /// Its cost counts as the method's.
  bool with_path = false;
  std::optional<WrongStart> wrong_start{};
};

/// Runs every method on every test, each with nothing it may not know. Truths before the first scan
/// with a reading are not scored for methods that answer live (but see TestCase::score_all), nor is
/// the start that dead reckoning is told. Results in the order of the tests, and on failure the
/// error or exception of the first test that fails, whatever the number of threads.
core::Result<std::vector<eval::EvaluatedTrack>> run_evaluation(const Dataset& dataset,
                                                               const EvaluationOptions& options,
                                                               const core::ProgressSink& progress);

}  // namespace waylode::cli
