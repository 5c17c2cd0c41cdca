// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/calibrate_thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "waylode/pdr/extremum_finder.hpp"

namespace waylode::pdr {
namespace {

/// Peaks in falling order, with the ends of the search. Troughs are peaks of the negated signal.
struct Peaks {
  std::vector<double> falling;
  double lowest = 0.0;  ///< Of the signal.
  double centre = 0.0;
  double highest = 0.0;
};

struct Threshold {
  double value = 0.0;
  std::size_t count = 0;  ///< Peaks above it.
};

std::size_t count_above(const Peaks& peaks, double threshold) {
  return static_cast<std::size_t>(
      std::lower_bound(peaks.falling.begin(), peaks.falling.end(), threshold, std::greater<>()) -
      peaks.falling.begin());
}

Peaks peaks_of(std::span<const double> signal, double sign) {
  Peaks peaks;
  ExtremumFinder finder;
  core::DeviceTime time;
  peaks.lowest = peaks.highest = sign * signal.front();
  for (const double unsigned_value : signal) {
    const double value = sign * unsigned_value;
    peaks.lowest = std::min(peaks.lowest, value);
    peaks.highest = std::max(peaks.highest, value);
    const auto extremum = finder.add(time, value);
    if (extremum && extremum->is_peak) peaks.falling.push_back(extremum->value);
    time += core::Duration(1);
  }
  std::sort(peaks.falling.begin(), peaks.falling.end(), std::greater<>());
  peaks.centre = 0.5 * (peaks.highest + peaks.lowest);
  return peaks;
}

std::size_t miss(std::size_t count, std::size_t wanted) {
  return count > wanted ? count - wanted : wanted - count;
}

/// Midway in the gap below the peak that is nearest to the wanted-th. Ripples below the centre do
/// not widen the gap: the search goes no further down.
Threshold closed_form(const Peaks& peaks, std::size_t wanted) {
  Threshold best;
  bool found = false;
  for (std::size_t count = 1; count <= peaks.falling.size(); ++count) {
    const double last = peaks.falling[count - 1];
    const bool is_end = count == peaks.falling.size();
    if (!is_end && peaks.falling[count] == last) continue;  // No threshold parts equals.
    if (found && miss(count, wanted) >= miss(best.count, wanted)) continue;
    double bound = is_end ? peaks.lowest : peaks.falling[count];
    if (last > peaks.centre) bound = std::max(bound, peaks.centre);
    best = {0.5 * (last + bound), count};
    found = true;
  }
  return best;
}

/// The first threshold on the way that lets exactly `wanted` peaks through, else the nearest.
Threshold search(const Peaks& peaks, std::size_t wanted, double begin, double end, double step) {
  const double direction = end > begin ? 1.0 : -1.0;
  const auto steps = static_cast<std::size_t>(std::abs(end - begin) / step);
  Threshold best{begin, count_above(peaks, begin)};
  for (std::size_t i = 1; i <= steps && best.count != wanted; ++i) {
    const double value = begin + direction * step * static_cast<double>(i);
    const std::size_t count = count_above(peaks, value);
    if (miss(count, wanted) < miss(best.count, wanted)) best = {value, count};
  }
  return best;
}

/// [Zhong2017] 2.3: p1 from the centre outwards, p2 from the edge inwards, p between them. The
/// printed loops over p2 and q2 assign p1 and q1; that is taken for a slip.
Threshold stepping(const Peaks& peaks, std::size_t wanted, double step) {
  const Threshold inner = search(peaks, wanted, peaks.centre, peaks.highest, step);
  const Threshold outer = search(peaks, wanted, peaks.highest, peaks.centre, step);
  const double middle = 0.5 * (inner.value + outer.value);
  return {middle, count_above(peaks, middle)};
}

core::Result<void> check(std::span<const double> signal, std::size_t step_count) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (signal.empty() || !std::all_of(signal.begin(), signal.end(), finite)) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the calibration walk is empty or holds a value that is not a number",
                      "calibrate_thresholds");
  }
  if (step_count == 0) {
    return core::fail(core::ErrorCode::kInvalidArgument, "tell how many steps were walked",
                      "calibrate_thresholds");
  }
  return {};
}

}  // namespace

core::Result<void> ThresholdOptions::validate() const {
  if (!(stepping_mps2 >= 1e-6 && std::isfinite(stepping_mps2))) {
    return core::fail(core::ErrorCode::kInvalidOptions, "stepping_mps2 must be at least 1e-6",
                      "calibrate_thresholds");
  }
  return {};
}

core::Result<StepThresholds> calibrate_thresholds(std::span<const double> filtered_mps2,
                                                  std::size_t step_count,
                                                  const ThresholdOptions& options) {
  if (const auto sound = options.validate(); !sound) return tl::unexpected(sound.error());
  if (const auto sound = check(filtered_mps2, step_count); !sound) {
    return tl::unexpected(sound.error());
  }
  const Peaks peaks = peaks_of(filtered_mps2, 1.0);
  const Peaks troughs = peaks_of(filtered_mps2, -1.0);
  if (peaks.falling.empty() || troughs.falling.empty()) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the calibration walk has no peak or no trough; record a walk",
                      "calibrate_thresholds");
  }
  const auto find = [&](const Peaks& of) {
    return options.search == ThresholdOptions::Search::kClosedForm
               ? closed_form(of, step_count)
               : stepping(of, step_count, options.stepping_mps2);
  };
  const Threshold peak = find(peaks);
  const Threshold trough = find(troughs);
  StepThresholds result;
  result.peak_threshold_mps2 = peak.value;
  result.trough_threshold_mps2 = -trough.value;
  result.calibration_ok = peak.count == step_count && trough.count == step_count &&
                          result.peak_threshold_mps2 > result.trough_threshold_mps2;
  return result;
}

}  // namespace waylode::pdr
