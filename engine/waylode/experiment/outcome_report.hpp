// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "waylode/experiment/outcome.hpp"

namespace waylode::experiment {

/// Aligned text for a terminal: the paper's figure, ours with its interval, the bar, the verdict.
std::string to_text(const std::vector<Outcome>& outcomes);

/// {"command", "outcomes": [...], "bars": {"reached", "judged"}}; what is not finite as null.
std::string to_json(const std::vector<Outcome>& outcomes, const std::string& command);

/// One self-contained HTML page with the figures and the papers' plots drawn from our data.
std::string to_html(const std::vector<Outcome>& outcomes, const std::string& command);

}  // namespace waylode::experiment
