// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace waylode::sim::detail {

/// Pressure above the sea by the international (standard atmosphere) barometric formula.
double pressure_hpa(double elevation_m, double sea_level_hpa);

}  // namespace waylode::sim::detail
