// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "waylode/eval/evaluated_track.hpp"
#include "waylode/eval/findings.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval {

struct ReportOptions {
  std::string title;
  std::string dataset;
  std::string command;  ///< What made the figures, for the reader to repeat it.
  /// Drawn on plans: the worst by the first method, and the median ones.
  std::size_t max_tracks = 24;
};

/// {"dataset", "command", "results": [...]} with the keys of Metrics, then what there is of
/// "intervals", "findings", "scan_periods" and "wrong_start"; NaN as null.
std::string to_json(const ReportOptions& options, std::span<const ResultRow> rows,
                    const Findings& findings = {});

/// The error table as aligned text for a terminal.
std::string to_text(std::span<const ResultRow> rows);

/// One self-contained HTML page: plans with tracks per method, truth and 95 % ellipses, error CDFs,
/// reliability, the table. No script or style from elsewhere, no network.
std::string to_html(const ReportOptions& options, std::span<const EvaluatedTrack> tracks,
                    std::span<const ResultRow> rows, const Findings& findings = {});

}  // namespace waylode::eval
