// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/eval/detail/report_data.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval::detail {

/// Methods against metrics for one group, the best value of each column emphasised. Empty when no
/// row has the group.
std::string summary_table(std::span<const ResultRow> rows, std::string_view group,
                          const std::vector<MethodErrors>& methods);

/// Groups against methods: mean error, and small beside it the 90th percentile and the floor hit
/// ratio. Empty without groups other than "all" and "covered".
std::string group_table(std::span<const ResultRow> rows, const std::vector<MethodErrors>& methods);

/// "<b>name</b>" with the method's colour in front.
std::string method_label(std::string_view name, const std::vector<MethodErrors>& methods);

}  // namespace waylode::eval::detail
