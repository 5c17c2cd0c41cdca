// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/pdr/step_detector.hpp"

namespace waylode::pdr {

/// Length of a step from its swing and cadence: constant + swing_gain * swing^(1/4) + cadence_gain
/// * (cadence - 1.9 Hz). With the constant and cadence_gain zero this is [Weinberg2002]. A person's
/// constant factor remains and is a state of fusion.
class StrideModel {
 public:
  struct Options {
    double constant_m = 0.0;
    double swing_gain = 0.41;  ///< m per (m/s2)^(1/4); [Weinberg2002] K.
    double cadence_gain_m_s = 0.0;
    double shortest_m = 0.25;
    double longest_m = 1.2;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit StrideModel(const Options& options) : options_(options) {}
  double length_m(const Step& step) const;

 private:
  Options options_;
};

}  // namespace waylode::pdr
