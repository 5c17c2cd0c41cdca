// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "waylode/eval/report.hpp"

namespace waylode::eval {
namespace {

using Json = nlohmann::ordered_json;  // Keys stay in the order of the contract.

Json row_json(const ResultRow& row) {
  const Metrics& metrics = row.metrics;
  return {{"method", row.method},
          {"group", row.group},
          {"n", metrics.n},
          {"mean_m", metrics.mean_m},
          {"p50_m", metrics.p50_m},
          {"p75_m", metrics.p75_m},
          {"p90_m", metrics.p90_m},
          {"p95_m", metrics.p95_m},
          {"ipin_p75_m", metrics.ipin_p75_m},
          {"floor_hit_ratio", metrics.floor_hit_ratio},
          {"inside_68_ratio", metrics.inside_68_ratio},
          {"inside_95_ratio", metrics.inside_95_ratio},
          {"unknown_ratio", metrics.unknown_ratio},
          {"n_before_scan", metrics.n_before_scan},
          {"n_ok", metrics.n_ok},
          {"ok_mean_m", metrics.ok_mean_m},
          {"after10s_mean_m", metrics.after10s_mean_m},
          {"trace_floor_hit_ratio", metrics.trace_floor_hit_ratio},
          {"within_1_m", metrics.within_1_m},
          {"within_1p5_m", metrics.within_1p5_m},
          {"within_2_m", metrics.within_2_m},
          {"within_3_m", metrics.within_3_m},
          {"region_95_median_m2", metrics.region_95_median_m2},
          {"walked_s", metrics.walked_s},
          {"cpu_s", metrics.cpu_s}};
}

Json row_json(const MeanInterval& row);
Json row_json(const ReliabilityPoint& point);
Json row_json(const TimeSpanError& span);
Json row_json(const MethodFindings& row);
Json row_json(const ScanPeriodRows& period);
Json row_json(const WrongStartRow& row);

template <typename Rows>
Json rows_json(const Rows& rows) {
  Json array = Json::array();
  for (const auto& row : rows) array.push_back(row_json(row));
  return array;
}

Json row_json(const MeanInterval& row) {
  return {{"method", row.method},
          {"group", row.group},
          {"tracks", row.tracks},
          {"mean_m", row.mean_m},
          {"mean_95_m", {row.mean_95_m.low, row.mean_95_m.high}},
          {"difference_m", row.difference_m},
          {"difference_95_m", {row.difference_95_m.low, row.difference_95_m.high}}};
}

Json row_json(const ReliabilityPoint& point) {
  return {{"stated_ratio", point.stated_ratio}, {"inside_ratio", point.inside_ratio}};
}

Json row_json(const TimeSpanError& span) {
  return {{"from_s", span.from_s}, {"to_s", span.to_s}, {"n", span.n}, {"mean_m", span.mean_m}};
}

Json row_json(const MethodFindings& row) {
  const FloorChanges& changes = row.floor_changes;
  return {{"method", row.method},
          {"group", row.group},
          {"ok_ratio", row.ok_ratio},
          {"whole_trace_floor_hit_ratio", row.whole_trace_floor_hit_ratio},
          {"region_95_median_m2", row.region_95_median_m2},
          {"reliability", rows_json(row.reliability)},
          {"by_time", rows_json(row.by_time)},
          {"floor_changes",
           {{"n", changes.n},
            {"found", changes.found},
            {"median_s", changes.median_s},
            {"worst_s", changes.worst_s},
            {"within_10s_ratio", changes.within_10s_ratio}}}};
}

Json row_json(const ScanPeriodRows& period) {
  return {{"period_s", period.period_s}, {"results", rows_json(period.rows)}};
}

Json row_json(const WrongStartRow& row) {
  return {{"method", row.method},
          {"group", row.group},
          {"n", row.n},
          {"recovered", row.recovered},
          {"takes_start", row.takes_start}};
}

void add_findings(Json& report, const Findings& findings) {
  if (!findings.intervals.empty()) report["intervals"] = rows_json(findings.intervals);
  if (!findings.methods.empty()) report["findings"] = rows_json(findings.methods);
  if (!findings.scan_periods.empty()) report["scan_periods"] = rows_json(findings.scan_periods);
  if (findings.wrong_starts.empty()) return;
  const WrongStartRule& rule = findings.wrong_start_rule;
  report["wrong_start"] = {
      {"offset_m", rule.offset_m},       {"sigma_m", rule.sigma_m},
      {"judged_at_s", rule.judged_at_s}, {"near_m", rule.near_m},
      {"allowance_m", rule.allowance_m}, {"results", rows_json(findings.wrong_starts)}};
}

}  // namespace

std::string to_json(const ReportOptions& options, std::span<const ResultRow> rows,
                    const Findings& findings) {
  Json report = {
      {"dataset", options.dataset}, {"command", options.command}, {"results", rows_json(rows)}};
  add_findings(report, findings);
  // Names are arbitrary bytes; what is not UTF-8 becomes U+FFFD. Numbers that are not finite become
  // null.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace waylode::eval
