// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "waylode/eval/metrics.hpp"

namespace waylode::eval {

/// The figures with scans that come no oftener than every `period_s`; 0 is as recorded.
struct ScanPeriodRows {
  double period_s = 0.0;
  std::vector<ResultRow> rows;  ///< As of summarise().
};

/// Mean error against the scan period, one line per method, for one group. Periods are evenly
/// spaced in the given order, as they are told apart by their labels. An <svg> for the report's
/// page; empty when no row has the group.
std::string scan_period_svg(const std::vector<ScanPeriodRows>& periods, const std::string& group);

/// The same as an SVG file that needs no page around it, with a legend.
std::string scan_period_svg_file(const std::vector<ScanPeriodRows>& periods,
                                 const std::string& group);

}  // namespace waylode::eval
