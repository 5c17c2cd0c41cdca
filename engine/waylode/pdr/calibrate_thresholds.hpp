// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "waylode/core/result.hpp"

namespace waylode::pdr {

/// Thresholds of the ExtremumStepDetector that fit one person.
struct StepThresholds {
  double peak_threshold_mps2 = 0.0;    ///< [Zhong2017] p.
  double trough_threshold_mps2 = 0.0;  ///< [Zhong2017] q.
  /// Both thresholds part exactly the known number of extremes, and p > q. Else they are the
  /// nearest to it.
  bool calibration_ok = false;

  bool operator==(const StepThresholds&) const = default;
};

struct ThresholdOptions {
  enum class Search {
    kClosedForm,  ///< Midway between the last extreme that counts and the first that does not.
    kStepping,    ///< The same found by small steps from both ends, as printed.
  };
  Search search = Search::kClosedForm;
  double stepping_mps2 = 0.001;  ///< Of kStepping, the paper's small Delta; > 0.

  core::Result<void> validate() const;
  bool operator==(const ThresholdOptions&) const = default;
};

/// Thresholds of the widest margin from a walk of known step number: as many peaks above p, and as
/// many troughs below q, as there were steps. `filtered_mps2` comes from
/// ExtremumStepDetector::Filter. Fails on values that are not finite, on no steps and on a signal
/// without a peak or without a trough.
core::Result<StepThresholds> calibrate_thresholds(std::span<const double> filtered_mps2,
                                                  std::size_t step_count,
                                                  const ThresholdOptions& options = {});

}  // namespace waylode::pdr
