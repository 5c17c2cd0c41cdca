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

}  // namespace

std::string to_json(const ReportOptions& options, std::span<const ResultRow> rows) {
  Json results = Json::array();
  for (const ResultRow& row : rows) results.push_back(row_json(row));
  const Json report = {
      {"dataset", options.dataset}, {"command", options.command}, {"results", results}};
  // Names are arbitrary bytes; what is not UTF-8 becomes U+FFFD. Numbers that are not finite become
  // null.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace waylode::eval
