// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/pipeline/options.hpp"

namespace waylode::experiment {

/// A paper whose experiments can be run.
struct Paper {
  std::string_view name;
  std::string presets;  ///< Names of its simulated rooms, separated by ", ".
};
std::span<const Paper> papers();

struct SimulationRequest {
  std::size_t seeds = 30;             ///< Worlds; figures in per cent take at least 100 walks.
  std::uint64_t first_seed = 1;       ///< Worlds first_seed, first_seed + 1, ...
  std::optional<std::string> preset;  ///< One room alone; none: all that have a bar, and more.
  pipeline::Options options;          ///< Of the engine.
};

/// The experiments of a paper in its simulated rooms. Deterministic. kInvalidArgument for a preset
/// that the paper does not have; `paper` is one of papers().
core::Result<std::vector<Outcome>> run_simulated(std::string_view paper,
                                                 const SimulationRequest& request,
                                                 const core::ProgressSink& progress);

}  // namespace waylode::experiment
