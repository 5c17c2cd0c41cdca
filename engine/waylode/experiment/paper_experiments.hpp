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
