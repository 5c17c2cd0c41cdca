// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "waylode/eval/detail/report_data.hpp"

namespace waylode::eval::detail {

/// Share of positions within a distance of the truth, per method. Empty without errors.
std::string error_cdf_svg(const std::vector<MethodErrors>& methods);

/// Share of recordings whose mean error is at most a distance. Empty with fewer than two.
std::string recording_cdf_svg(const std::vector<MethodErrors>& methods);

/// Share of truths inside the region stated for a probability, against that probability.
std::string reliability_svg(const std::vector<MethodErrors>& methods);

/// Mean error against time since a track's first truth. Empty when no track lasts 5 s.
std::string error_over_time_svg(const std::vector<MethodErrors>& methods);

}  // namespace waylode::eval::detail
