// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/time.hpp"

namespace waylode::pdr {

/// A value of a stream that may run behind its input.
struct TimedValue {
  core::DeviceTime time;
  double value = 0.0;

  bool operator==(const TimedValue&) const = default;
};

}  // namespace waylode::pdr
