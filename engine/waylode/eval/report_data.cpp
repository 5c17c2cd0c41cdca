// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "waylode/eval/detail/methods.hpp"
#include "waylode/eval/detail/quantile.hpp"

namespace waylode::eval::detail {
namespace {

double mean_error_m(const EvaluatedTrack& track) {
  std::vector<double> errors_m;
  for (const PointError& error : track_errors(track)) errors_m.push_back(error.horizontal_m);
  return mean(errors_m);
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Recordings that have at least one scored truth, by name within group.
std::vector<Recording> scored_recordings(std::span<const EvaluatedTrack> tracks) {
  const std::vector<std::string> methods = methods_in_order(tracks);
  std::map<std::pair<std::string, std::string>, Recording> by_name;
  for (const EvaluatedTrack& track : tracks) {
    const double mean_m = mean_error_m(track);
    if (std::isnan(mean_m)) continue;
    by_name[{track.group, track.name}].methods.push_back(
        {index_of(methods, track.method), &track, mean_m});
  }
  std::vector<Recording> recordings;
  for (auto& [name, recording] : by_name) {
    std::stable_sort(
        recording.methods.begin(), recording.methods.end(),
        [](const MethodTrack& a, const MethodTrack& b) { return a.method < b.method; });
    recordings.push_back(std::move(recording));
  }
  return recordings;
}

}  // namespace

std::vector<MethodErrors> errors_by_method(std::span<const EvaluatedTrack> tracks) {
  const std::vector<std::string> names = methods_in_order(tracks);
  std::vector<MethodErrors> methods;
  for (const std::string& name : names) methods.push_back({name, {}, {}});
  for (const EvaluatedTrack& track : tracks) {
    MethodErrors& method = methods[index_of(names, track.method)];
    for (const PointError& error : track_errors(track)) method.errors.push_back(error);
    const double mean_m = mean_error_m(track);
    if (!std::isnan(mean_m)) method.track_means_m.push_back(mean_m);
  }
  return methods;
}

ChosenRecordings choose_recordings(std::span<const EvaluatedTrack> tracks, std::size_t most) {
  std::vector<Recording> recordings = scored_recordings(tracks);
  std::stable_sort(recordings.begin(), recordings.end(), [](const auto& a, const auto& b) {
    return a.methods.front().mean_m > b.methods.front().mean_m;
  });
  if (recordings.size() <= most) return {std::move(recordings), {}};
  const std::size_t worst_count = (most + 1) / 2;
  const std::size_t median_count = most - worst_count;
  const std::size_t centred_begin = recordings.size() / 2 - median_count / 2;
  const std::size_t median_begin =
      std::clamp(centred_begin, worst_count, recordings.size() - median_count);
  const auto at = [&](std::size_t i) {
    return recordings.begin() + static_cast<std::ptrdiff_t>(i);
  };
  return {{at(0), at(worst_count)}, {at(median_begin), at(median_begin + median_count)}};
}

}  // namespace waylode::eval::detail
