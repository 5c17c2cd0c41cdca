// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/time.hpp"

namespace waylode::pdr {

/// Where a signal turned round.
struct Extremum {
  core::DeviceTime time;
  double value = 0.0;
  bool is_peak = false;  ///< Else a trough.
};

/// Local extremes of a stream, told by the first value beyond them. A plateau counts once, at its
/// beginning, and only if the signal leaves it the way it came. The first and the last value are
/// never extremes.
class ExtremumFinder {
 public:
  std::optional<Extremum> add(core::DeviceTime time, double value);

 private:
  enum class Slope { kUnknown, kRising, kFalling };
  std::optional<Extremum> last_;  ///< Where the newest value was first reached.
  Slope slope_ = Slope::kUnknown;
};

}  // namespace waylode::pdr
