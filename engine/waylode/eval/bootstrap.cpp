// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "waylode/core/assert.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/eval/detail/methods.hpp"
#include "waylode/eval/detail/quantile.hpp"
#include "waylode/eval/metrics.hpp"

namespace waylode::eval {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What one track adds to a mean and to a paired difference of means.
struct Share {
  double sum_m = 0.0;
  double count = 0.0;
  double difference_sum_m = 0.0;
  double common = 0.0;  ///< Truths scored for both methods.

  void operator+=(const Share& other) {
    sum_m += other.sum_m;
    count += other.count;
    difference_sum_m += other.difference_sum_m;
    common += other.common;
  }
  double mean_m() const { return count > 0.0 ? sum_m / count : kNaN; }
  double difference_m() const { return common > 0.0 ? difference_sum_m / common : kNaN; }
};

/// Group, name, and which of several of that name: recordings in an order of their own.
using Key = std::tuple<std::string, std::string, std::size_t>;
using Tracks = std::map<Key, const EvaluatedTrack*>;

Tracks tracks_of(std::span<const EvaluatedTrack> tracks, const std::string& method,
                 bool covered_only) {
  Tracks chosen;
  for (const EvaluatedTrack& track : tracks) {
    if (track.method != method || (covered_only && !track.covered)) continue;
    std::size_t repetition = 0;
    while (!chosen.try_emplace({track.group, track.name, repetition}, &track).second) ++repetition;
  }
  return chosen;
}

/// Per truth; NaN where it is not scored.
std::vector<double> errors_m(const EvaluatedTrack& track) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < track.truths.size(); ++i) {
    const TruthPoint& truth = track.truths[i];
    errors.push_back(
        truth.scored ? point_error(*track.site, truth, track.fixes[i], track.truths.front().time)
                           .horizontal_m
                     : kNaN);
  }
  return errors;
}

Share share_of(const EvaluatedTrack& track, const EvaluatedTrack* first) {
  const std::vector<double> own_m = errors_m(track);
  const std::vector<double> first_m = first == nullptr ? std::vector<double>{} : errors_m(*first);
  Share share;
  for (std::size_t i = 0; i < own_m.size(); ++i) {
    if (std::isnan(own_m[i])) continue;
    share.sum_m += own_m[i];
    share.count += 1.0;
    if (i >= first_m.size() || std::isnan(first_m[i])) continue;
    share.difference_sum_m += own_m[i] - first_m[i];
    share.common += 1.0;
  }
  return share;
}

std::vector<Share> shares_of(const Tracks& tracks, const Tracks& first) {
  std::vector<Share> shares;
  for (const auto& [key, track] : tracks) {
    const auto other = first.find(key);
    const Share share = share_of(*track, other == first.end() ? nullptr : other->second);
    if (share.count > 0.0) shares.push_back(share);
  }
  return shares;
}

Interval interval_95(std::vector<double>& values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  std::sort(values.begin(), values.end());
  return {detail::quantile(values, 0.025), detail::quantile(values, 0.975)};
}

MeanInterval resample(const std::vector<Share>& shares, const BootstrapOptions& options) {
  Share whole;
  for (const Share& share : shares) whole += share;
  MeanInterval result;
  result.tracks = shares.size();
  result.mean_m = whole.mean_m();
  result.difference_m = whole.difference_m();
  core::Rng rng(options.seed);
  std::vector<double> means_m;
  std::vector<double> differences_m;
  for (std::size_t i = 0; i < options.resamples && !shares.empty(); ++i) {
    Share drawn;
    for (std::size_t j = 0; j < shares.size(); ++j) drawn += shares[rng.below(shares.size())];
    means_m.push_back(drawn.mean_m());
    differences_m.push_back(drawn.difference_m());
  }
  result.mean_95_m = interval_95(means_m);
  result.difference_95_m = interval_95(differences_m);
  return result;
}

}  // namespace

std::vector<MeanInterval> bootstrap_means(std::span<const EvaluatedTrack> tracks, bool with_covered,
                                          const BootstrapOptions& options) {
  WAYLODE_ASSERT(options.resamples > 0);
  std::vector<MeanInterval> intervals;
  const std::vector<std::string> methods = detail::methods_in_order(tracks);
  for (const std::string& method : methods) {
    for (const bool covered_only : {false, true}) {
      if (covered_only && !with_covered) continue;
      MeanInterval interval = resample(shares_of(tracks_of(tracks, method, covered_only),
                                                 tracks_of(tracks, methods.front(), covered_only)),
                                       options);
      interval.method = method;
      interval.group = covered_only ? "covered" : "all";
      intervals.push_back(std::move(interval));
    }
  }
  return intervals;
}

}  // namespace waylode::eval
