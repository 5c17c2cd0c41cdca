// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "waylode/experiment/outcome.hpp"

namespace waylode::experiment {

/// The values of one independent unit (a walk's errors). Units are drawn whole: the values within
/// one are not independent.
using Unit = std::vector<double>;

/// A statistic of all values of the drawn units together.
using Statistic = std::function<double(std::span<const double>)>;

/// The statistic over all units, with its 95 % percentile bootstrap interval [EfronTibshirani1993].
/// Deterministic. NaN for no values.
Interval bootstrap(std::span<const Unit> units, const Statistic& statistic);

/// The same for a statistic of several methods on the same walks: walks are drawn once for all.
/// `methods[m][w]` are method m's values on walk w; every method has the same walks.
using JointStatistic = std::function<double(std::span<const std::vector<double>>)>;
Interval bootstrap(std::span<const std::vector<Unit>> methods, const JointStatistic& statistic);

double mean_of(std::span<const double> values);
/// Linear between order statistics; `q` in [0, 1].
double quantile_of(std::span<const double> values, double q);
/// Share of values of at most `limit`, in per cent.
double percent_within(std::span<const double> values, double limit);

}  // namespace waylode::experiment
