// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "datasets/alteration.hpp"
#include "datasets/split.hpp"
#include "waylode/core/result.hpp"

namespace waylode::cli {

/// What `waylode evaluate` is told, as typed.
struct EvaluateArguments {
  std::string first;              ///< Folder, training table or site, by data set.
  std::string second;             ///< Validation table (uji).
  std::vector<std::string> logs;  ///< mcap.
  std::optional<std::string> split;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> fold;
  double unlabelled = 0.0;
  std::vector<std::string> methods = {"wknn", "fused", "smoothed"};
  std::string floor;
  double scan_period_s = 0.0;
  std::vector<std::string> scan_periods;
  std::string thin_bluetooth = "on";
  double device_offset_db = 0.0;
  double wrong_start_m = 0.0;
  std::optional<std::string> out;
  std::optional<std::string> report;
  std::optional<std::string> chart;
  std::optional<std::string> config;
};

/// Arguments that every data set has.
void add_common_arguments(Verb& verb, EvaluateArguments& arguments);
/// Those of data sets that can be dealt into training and test.
void add_split_arguments(Verb& verb, EvaluateArguments& arguments);

/// kInvalidArgument names the option; --seed and --fold say nothing beside a --split.
core::Result<Dealing> dealing_of(const EvaluateArguments& arguments);
Alteration alteration_of(const EvaluateArguments& arguments);
/// As recorded (0) first, then those given; empty without --scan-periods.
core::Result<std::vector<double>> scan_periods_of(const EvaluateArguments& arguments);
/// Options that need each other, before hours of work.
core::Result<void> check_arguments(const EvaluateArguments& arguments);

}  // namespace waylode::cli
