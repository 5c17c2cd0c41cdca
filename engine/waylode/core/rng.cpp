// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/rng.hpp"

#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::core {

double Rng::uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }

std::uint64_t Rng::below(std::uint64_t count) {
  WAYLODE_ASSERT(count > 0);
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
  std::uint64_t value = engine_();
  while (value >= limit) value = engine_();
  return value % count;
}

double Rng::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0.0;
  double v = 0.0;
  double s = 0.0;
  do {
    u = uniform(-1.0, 1.0);
    v = uniform(-1.0, 1.0);
    s = u * u + v * v;
  } while (s >= 1.0 || s == 0.0);
  const double factor = std::sqrt(-2.0 * std::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

}  // namespace waylode::core
