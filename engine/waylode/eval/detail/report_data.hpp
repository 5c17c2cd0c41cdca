// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "waylode/eval/evaluated_track.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval::detail {

/// Everything one method was scored on.
struct MethodErrors {
  std::string name;
  std::vector<PointError> errors;
  std::vector<double> track_means_m;  ///< Of tracks with scored truths.
};

/// Methods in the order of their first appearance.
std::vector<MethodErrors> errors_by_method(std::span<const EvaluatedTrack> tracks);

/// What one method said on a recording.
struct MethodTrack {
  std::size_t method = 0;  ///< Index into errors_by_method().
  const EvaluatedTrack* track = nullptr;
  double mean_m = 0.0;  ///< Over scored truths; NaN without any.
};

/// One recording with all methods that ran on it; they share its truths and its site.
struct Recording {
  std::vector<MethodTrack> methods;  ///< Never empty.
};

/// Which recordings to draw: all of them, worst first, when they fit in `most`; otherwise the worst
/// and those around the median. "Worst" by the mean of each recording's first method.
struct ChosenRecordings {
  std::vector<Recording> worst;
  std::vector<Recording> median;  ///< Empty when all recordings are in `worst`.
};
ChosenRecordings choose_recordings(std::span<const EvaluatedTrack> tracks, std::size_t most);

}  // namespace waylode::eval::detail
