// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/air.hpp"

#include <cmath>

namespace waylode::sim::detail {

double pressure_hpa(double elevation_m, double sea_level_hpa) {
  // [ISO2533]: 288.15 K at the sea, 6.5 K less per kilometre.
  constexpr double kSeaLevel_k = 288.15;
  constexpr double kLapse_kpm = 0.0065;
  constexpr double kExponent = 5.25588;
  return sea_level_hpa * std::pow(1.0 - kLapse_kpm * elevation_m / kSeaLevel_k, kExponent);
}

}  // namespace waylode::sim::detail
