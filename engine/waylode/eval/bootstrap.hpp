// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "waylode/eval/evaluated_track.hpp"

namespace waylode::eval {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// How sure a mean error is, given that other walks could have been recorded.
struct MeanInterval {
  std::string method;
  std::string group;          ///< "all" or "covered".
  std::size_t tracks = 0;     ///< With scored truths.
  double mean_m = 0.0;        ///< NaN without any, as is all that follows.
  Interval mean_95_m;         ///< 95 % interval of the mean.
  double difference_m = 0.0;  ///< Less the first method's mean, where both are scored.
  Interval difference_95_m;   ///< Of tracks drawn for both methods together.
};

struct BootstrapOptions {
  std::size_t resamples = 2000;  ///< >= 1.
  std::uint64_t seed = 1;
};

/// Percentile intervals of the bootstrap [EfronTibshirani1993] 13.3 over whole tracks, since errors
/// within one are alike. Differences are paired: over truths that the method and the first one are
/// both scored on, from the same drawn tracks. Methods in the order of their first appearance,
/// "all" before "covered" (when `with_covered`); the same for any order of the recordings.
std::vector<MeanInterval> bootstrap_means(std::span<const EvaluatedTrack> tracks, bool with_covered,
                                          const BootstrapOptions& options);

}  // namespace waylode::eval
