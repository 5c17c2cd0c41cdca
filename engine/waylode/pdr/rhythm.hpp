// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

namespace waylode::pdr {

/// How regularly a walker steps.
struct Rhythm {
  double step_interval_s = 0.0;
  /// Of the signal with itself one step earlier, -1 to 1.
  double step_correlation_ratio = 0.0;
  /// Of the signal with itself one stride (two steps) earlier: the same foot comes round
  /// whatever the phone's place, while left and right may differ much.
  double stride_correlation_ratio = 0.0;
};

/// Where steps may be looked for.
struct StepIntervalRange {
  double shortest_s = 0.0;
  double longest_s = 0.0;
};

/// The rhythm of a signal sampled every `spacing_s`: the interval at which the mean of its
/// autocorrelation after one step and after two is largest, or half of that interval if the signal
/// is alike after it too. Nothing when the signal is constant or shorter than two of the longest
/// intervals and 10 samples.
std::optional<Rhythm> find_rhythm(std::span<const double> signal, double spacing_s,
                                  const StepIntervalRange& range);

}  // namespace waylode::pdr
