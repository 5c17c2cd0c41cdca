// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "waylode/eval/detail/methods.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval {
namespace detail {

std::vector<std::string> methods_in_order(std::span<const EvaluatedTrack> tracks) {
  std::vector<std::string> methods;
  for (const EvaluatedTrack& track : tracks) {
    if (std::find(methods.begin(), methods.end(), track.method) == methods.end()) {
      methods.push_back(track.method);
    }
  }
  return methods;
}

}  // namespace detail

std::vector<ResultRow> summarise(std::span<const EvaluatedTrack> tracks, bool with_covered) {
  std::vector<ResultRow> rows;
  for (const std::string& method : detail::methods_in_order(tracks)) {
    std::vector<const EvaluatedTrack*> all;
    std::vector<const EvaluatedTrack*> covered;
    std::map<std::string, std::vector<const EvaluatedTrack*>> by_group;
    for (const EvaluatedTrack& track : tracks) {
      if (track.method != method) continue;
      all.push_back(&track);
      if (track.covered) covered.push_back(&track);
      by_group[track.group].push_back(&track);
    }
    rows.push_back({method, "all", compute_metrics(all)});
    if (with_covered) rows.push_back({method, "covered", compute_metrics(covered)});
    for (const auto& [group, members] : by_group) {
      rows.push_back({method, group, compute_metrics(members)});
    }
  }
  return rows;
}

}  // namespace waylode::eval
