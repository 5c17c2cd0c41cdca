// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/papers.hpp"

#include <algorithm>
#include <array>

#include "waylode/experiment/paper_experiments.hpp"

namespace waylode::experiment {
namespace {

using Runner = core::Result<std::vector<Outcome>> (*)(const SimulationRequest&,
                                                      const core::ProgressSink&);

const std::array<Paper, 4> kPapers = {{
    {"wu2019", "I, C, A, D, corridor"},
    {"zhou2016", "A, H"},
    {"zhao2019", "kernel, corridor, normal, harsh, harsh_3s"},
    {"zhong2017", "straight, turns, photo, crowd, many"},
}};
constexpr std::array<Runner, 4> kRunners = {run_wu2019, run_zhou2016, run_zhao2019, run_zhong2017};

bool has_preset(const Paper& paper, std::string_view preset) {
  for (std::size_t from = 0; from < paper.presets.size();) {
    const std::size_t to = std::min(paper.presets.find(", ", from), paper.presets.size());
    if (std::string_view(paper.presets).substr(from, to - from) == preset) return true;
    from = to + 2;
  }
  return false;
}

}  // namespace

std::span<const Paper> papers() { return kPapers; }

core::Result<std::vector<Outcome>> run_simulated(std::string_view paper,
                                                 const SimulationRequest& request,
                                                 const core::ProgressSink& progress) {
  const auto found = std::ranges::find(kPapers, paper, &Paper::name);
  if (found == kPapers.end()) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "no such paper; known are wu2019, zhou2016, zhao2019, zhong2017",
                      std::string(paper));
  }
  if (request.preset && !has_preset(*found, *request.preset)) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "no such preset; " + std::string(paper) + " has " + found->presets,
                      "--preset " + *request.preset);
  }
  if (request.seeds == 0) {
    return core::fail(core::ErrorCode::kInvalidArgument, "at least one seed is needed", "--seeds");
  }
  return kRunners[static_cast<std::size_t>(found - kPapers.begin())](request, progress);
}

}  // namespace waylode::experiment
