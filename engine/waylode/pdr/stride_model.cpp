// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/stride_model.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pdr {

core::Result<void> StrideModel::Options::validate() const {
  if (!(shortest_m > 0.0 && longest_m > shortest_m && swing_gain >= 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need 0 < shortest_m < longest_m and swing_gain >= 0", "stride_model");
  }
  return {};
}

double StrideModel::length_m(const Step& step) const {
  constexpr double kTypicalCadence_hz = 1.9;
  // [Weinberg2002] fourth root of the swing.
  const double length_m = options_.constant_m +
                          options_.swing_gain * std::pow(std::max(0.0, step.swing_mps2), 0.25) +
                          options_.cadence_gain_m_s * (1.0 / step.interval_s - kTypicalCadence_hz);
  return std::clamp(length_m, options_.shortest_m, options_.longest_m);
}

}  // namespace waylode::pdr
