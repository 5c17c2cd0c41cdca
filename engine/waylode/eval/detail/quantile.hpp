// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace waylode::eval::detail {

/// Linear interpolation between order statistics: rank (n - 1) * probability, counted from 0
/// ([HyndmanFan1996] type 7). `sorted` ascends; NaN when empty. `probability` in [0, 1].
double quantile(std::span<const double> sorted, double probability);

/// NaN when empty. Summed in the given order.
double mean(std::span<const double> values);

}  // namespace waylode::eval::detail
