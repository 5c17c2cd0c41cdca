// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/experiment/papers.hpp"

namespace waylode::experiment {

/// Percentages of fewer walks move by several points from draw to draw.
inline std::size_t walks_for_percentages(const SimulationRequest& request) {
  constexpr std::size_t kFewest = 100;
  return std::max(kFewest, request.seeds);
}

/// The engine's options with the stride gains of the people who walk in the simulated rooms: the
/// papers preset theirs likewise, by people they measured. A single person's remain unknown.
inline pipeline::Options options_for_rooms(const SimulationRequest& request) {
  constexpr double kPopulationGain = 0.42;  // m per (m/s2)^(1/4), as sim::GaitOptions draws around.
  pipeline::Options options = request.options;
  options.pdr.stride.swing_gain = kPopulationGain;
  options.pdr.stride.gains.mean_gain = 0.0;
  options.pdr.stride.gains.swing_gain = kPopulationGain;
  return options;
}

/// Each paper's experiments, in its own file. The preset is one of the paper's or absent.
core::Result<std::vector<Outcome>> run_wu2019(const SimulationRequest& request,
                                              const core::ProgressSink& progress);
core::Result<std::vector<Outcome>> run_zhou2016(const SimulationRequest& request,
                                                const core::ProgressSink& progress);
core::Result<std::vector<Outcome>> run_zhao2019(const SimulationRequest& request,
                                                const core::ProgressSink& progress);
core::Result<std::vector<Outcome>> run_zhong2017(const SimulationRequest& request,
                                                 const core::ProgressSink& progress);

}  // namespace waylode::experiment
