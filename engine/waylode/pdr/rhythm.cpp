// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/rhythm.hpp"

#include <cmath>
#include <numeric>
#include <vector>

namespace waylode::pdr {
namespace {

/// The signal without its mean.
std::vector<double> centred(std::span<const double> signal) {
  const double mean =
      std::accumulate(signal.begin(), signal.end(), 0.0) / static_cast<double>(signal.size());
  std::vector<double> values(signal.begin(), signal.end());
  for (double& value : values) value -= mean;
  return values;
}

/// By lag, from 0 to `longest`: the correlation of what overlaps.
std::vector<double> autocorrelation(const std::vector<double>& values, std::size_t longest) {
  const std::size_t count = values.size();
  std::vector<double> energy(count + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) energy[i + 1] = energy[i] + values[i] * values[i];
  std::vector<double> correlation(longest + 1, 0.0);
  for (std::size_t lag = 0; lag <= longest; ++lag) {
    double product = 0.0;
    for (std::size_t i = lag; i < count; ++i) product += values[i] * values[i - lag];
    const double scale = std::sqrt(energy[count - lag] * (energy[count] - energy[lag]));
    if (scale > 0.0) correlation[lag] = product / scale;
  }
  return correlation;
}

/// The correlation half way to `stride`.
double at_step(const std::vector<double>& correlation, std::size_t stride) {
  return 0.5 * (correlation[stride / 2] + correlation[(stride + 1) / 2]);
}

double score(const std::vector<double>& correlation, std::size_t stride) {
  return 0.5 * (at_step(correlation, stride) + correlation[stride]);
}

bool is_peak(const std::vector<double>& correlation, std::size_t lag) {
  return correlation[lag] >= correlation[lag - 1] && correlation[lag] >= correlation[lag + 1];
}

/// The lag of the best score from `first` to `last`; where the correlation has peaks there, of
/// these, since what is on a peak's flank belongs to a period out of range.
std::size_t best_stride(const std::vector<double>& correlation, std::size_t first,
                        std::size_t last) {
  std::size_t best = first;
  for (std::size_t lag = first + 1; lag <= last; ++lag) {
    const bool gains = is_peak(correlation, lag) && !is_peak(correlation, best);
    const bool loses = !is_peak(correlation, lag) && is_peak(correlation, best);
    if (gains || (!loses && score(correlation, lag) > score(correlation, best))) best = lag;
  }
  return best;
}

/// The lag of the maximum near `lag` of a parabola through it and its neighbours.
double refine(const std::vector<double>& correlation, std::size_t lag) {
  const double before = correlation[lag - 1];
  const double at = correlation[lag];
  const double after = correlation[lag + 1];
  const double curvature = before - 2.0 * at + after;
  const bool refinable = is_peak(correlation, lag) && curvature < 0.0;
  return static_cast<double>(lag) + (refinable ? 0.5 * (before - after) / curvature : 0.0);
}

}  // namespace

std::optional<Rhythm> find_rhythm(std::span<const double> signal, double spacing_s,
                                  const StepIntervalRange& range) {
  constexpr std::size_t kLeastOverlap = 10;  // Fewer products say nothing about likeness.
  const auto shortest = static_cast<std::size_t>(std::lround(2.0 * range.shortest_s / spacing_s));
  const auto longest = static_cast<std::size_t>(std::lround(2.0 * range.longest_s / spacing_s));
  if (shortest < 1 || longest < shortest || signal.size() < longest + kLeastOverlap) return {};

  const std::vector<double> correlation = autocorrelation(centred(signal), longest + 1);
  if (correlation[0] <= 0.0) return {};
  std::size_t stride = best_stride(correlation, shortest, longest);
  // A runner's stride is as long as a slow walker's step, but the runner's feet are alike.
  constexpr double kAlikeRatio = 0.5;
  if (stride / 2 > shortest && at_step(correlation, stride / 2) >= kAlikeRatio) {
    stride = best_stride(correlation, stride / 2 - 1, stride / 2 + 1);
  }
  return Rhythm{0.5 * spacing_s * refine(correlation, stride), at_step(correlation, stride),
                correlation[stride]};
}

}  // namespace waylode::pdr
