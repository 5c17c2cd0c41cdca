// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <optional>

#include "waylode/core/assert.hpp"
#include "waylode/eval/detail/methods.hpp"
#include "waylode/eval/findings.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval {
namespace {

/// On the straight line between the marks around `time`; nullopt past the last and across floors.
std::optional<TruthPoint> truth_between(const EvaluatedTrack& track, core::DeviceTime time) {
  const auto after = std::ranges::lower_bound(track.truths, time, {}, &TruthPoint::time);
  if (after == track.truths.end()) return std::nullopt;
  if (after->time == time) return *after;
  if (after == track.truths.begin()) return std::nullopt;
  const TruthPoint& before = *std::prev(after);
  if (before.floor != after->floor) return std::nullopt;
  const double share =
      core::to_seconds(time - before.time) / core::to_seconds(after->time - before.time);
  return TruthPoint{time, before.floor,
                    before.position_m + share * (after->position_m - before.position_m), true};
}

/// The path's first fix at least that long after the start.
const core::Fix* fix_judged(const EvaluatedTrack& track, double judged_at_s) {
  for (const core::Fix& fix : track.path) {
    if (core::to_seconds(fix.time - track.truths.front().time) >= judged_at_s) return &fix;
  }
  return nullptr;
}

/// nullopt when the track cannot be judged.
std::optional<bool> has_recovered(const EvaluatedTrack& perturbed, const EvaluatedTrack& alone,
                                  const WrongStartRule& rule) {
  if (perturbed.truths.empty()) return std::nullopt;
  const core::Fix* fix = fix_judged(perturbed, rule.judged_at_s);
  const core::Fix* fix_alone = fix_judged(alone, rule.judged_at_s);
  if (fix == nullptr || fix_alone == nullptr) return std::nullopt;
  const auto truth = truth_between(perturbed, fix->time);
  if (!truth) return std::nullopt;
  const core::DeviceTime start = perturbed.truths.front().time;
  const PointError error = point_error(*perturbed.site, *truth, *fix, start);
  const PointError error_alone = point_error(*alone.site, *truth, *fix_alone, start);
  return error.horizontal_m < rule.near_m ||
         error.horizontal_m <= error_alone.horizontal_m + rule.allowance_m;
}

}  // namespace

std::vector<WrongStartRow> judge_wrong_starts(std::span<const EvaluatedTrack> perturbed,
                                              std::span<const EvaluatedTrack> alone,
                                              bool with_covered, const WrongStartRule& rule) {
  WAYLODE_ASSERT(perturbed.size() == alone.size());
  std::vector<WrongStartRow> rows;
  for (const std::string& method : detail::methods_in_order(perturbed)) {
    for (const bool covered_only : {false, true}) {
      if (covered_only && !with_covered) continue;
      WrongStartRow row{method, covered_only ? "covered" : "all", 0, 0, false};
      for (std::size_t i = 0; i < perturbed.size(); ++i) {
        if (perturbed[i].method != method || (covered_only && !perturbed[i].covered)) continue;
        row.takes_start = row.takes_start || perturbed[i].path != alone[i].path;
        const std::optional<bool> recovered = has_recovered(perturbed[i], alone[i], rule);
        row.n += recovered ? 1 : 0;
        row.recovered += recovered.value_or(false) ? 1 : 0;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace waylode::eval
