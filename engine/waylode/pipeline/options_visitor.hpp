// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <variant>

#include "waylode/pipeline/options.hpp"

namespace waylode::pipeline {

/// An option that is one of several words.
struct Choice {
  std::span<const std::string_view> names;
  std::function<std::size_t()> get;  ///< Index into `names`.
  std::function<void(std::size_t)> set;
};

/// As `smallest`, stands for "above zero".
inline constexpr double kAboveZero = 1e-9;

/// One tunable of an Options object, as configuration files see it.
struct OptionRef {
  std::string_view table;  ///< "fused.planar".
  std::string_view name;   ///< "start_sigma_m"; says the unit.
  std::variant<double*, float*, int*, std::size_t*, Choice> target;
  double smallest = 0.0;  ///< Numbers must lie in [smallest, largest].
  double largest = 0.0;
  std::string_view comment;  ///< What it does and when to change it; one sentence, ASCII.
};

/// Calls `visit` for every tunable, tables together, always in the same order. References point
/// into `options`. Limits of single values are checked against the range given here; what holds
/// between values is Options::validate's.
void for_each_option(Options& options, const std::function<void(const OptionRef&)>& visit);

}  // namespace waylode::pipeline
