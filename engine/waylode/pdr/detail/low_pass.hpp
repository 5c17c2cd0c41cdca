// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::pdr::detail {

/// Two first-order stages: the phase is nearly linear below the cut-off.
class LowPass {
 public:
  explicit LowPass(double cut_off_hz) : cut_off_hz_(cut_off_hz) {}

  void restart(double value) { stage_one_ = stage_two_ = value; }
  double add(double value, double dt_s) {
    const double gain = 1.0 - std::exp(-2.0 * core::kPi * cut_off_hz_ * dt_s);
    stage_one_ += gain * (value - stage_one_);
    stage_two_ += gain * (stage_one_ - stage_two_);
    return stage_two_;
  }

 private:
  double cut_off_hz_;
  double stage_one_ = 0.0;
  double stage_two_ = 0.0;
};

}  // namespace waylode::pdr::detail
