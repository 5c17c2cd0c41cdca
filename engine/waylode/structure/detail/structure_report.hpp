// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/structure/adjusted_structure.hpp"
#include "waylode/structure/detail/network.hpp"

namespace waylode::structure::detail {

/// The solved network in the structure's own frame, with its accuracy. kSurveyInsufficient when it
/// has no edge.
core::Result<AdjustedStructure> report(const Survey& survey, const Network& network,
                                       const SolveSummary& summary, std::vector<Closure> found,
                                       std::vector<Closure> rejected,
                                       const PoseGraphOptions& options);

}  // namespace waylode::structure::detail
