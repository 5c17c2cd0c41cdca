// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/cadence_step_detector.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

/// Fine enough for 3 Hz, and coarse enough that samples at 50 Hz with jitter fill every cell.
constexpr core::Duration kCell = std::chrono::milliseconds(40);
constexpr double kCell_s = core::to_seconds(kCell);

/// Two peaks closer than this share of the rhythm's interval are one step.
constexpr double kApartRatio = 0.65;
/// Two peaks further apart than this many intervals hide a step of the other foot,
constexpr double kHiddenRatio = 1.5;
/// if the signal is at least so like itself after one step. A slow walker's whole step, taken for a
/// stride, tends to -1; a swinging arm's or a pocket's stride hardly ever falls so low.
constexpr double kOtherFootRatio = -0.5;
/// A peak is the highest as far on both sides; so much later it is known.
constexpr double kReachRatio = 0.3;
/// By then the signal must have fallen by so much of the prominence, else it merely came back to
/// rest after the last valley.
constexpr double kFallRatio = 0.1;
constexpr double kIdleReach_s = 0.15;  ///< The same before a rhythm is known.
/// Clear peaks begin a walk if the weakest is so much of the strongest,
constexpr double kAlikeRatio = 0.5;
/// and the longest interval no more than so many of the shortest.
constexpr double kEvenRatio = 1.4;
constexpr double kIntervalGain = 0.3;
constexpr double kProminenceGain = 0.2;

std::size_t cells_of(double span_s) {
  return static_cast<std::size_t>(std::lround(span_s / kCell_s));
}

/// Share of the way to the input that a first-order stage goes within `dt_s`.
double gain(double cut_off_hz, double dt_s) {
  return 1.0 - std::exp(-2.0 * core::kPi * cut_off_hz * dt_s);
}

bool is_usable(const StepInput& input) {
  constexpr double kLargest_mps2 = 1e3;  // Phones end at 16 g. Comparisons with NaN are false.
  return std::abs(input.norm_mps2) <= kLargest_mps2 &&
         std::abs(input.vertical_mps2) <= kLargest_mps2;
}

/// Where a parabola through three neighbours has its maximum, in spacings from the middle one.
double vertex(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
}

}  // namespace

core::Result<void> CadenceStepDetector::Options::validate() const {
  const bool positive = low_pass_hz > 0.0 && high_pass_hz > 0.0 && shortest_interval_s >= 0.1 &&
                        min_prominence_mps2 > 0.0 && clear_prominence_mps2 >= min_prominence_mps2 &&
                        first_steps >= 2;
  const bool ordered = longest_interval_s > shortest_interval_s && longest_interval_s <= 2.0 &&
                       pause_s > longest_interval_s && pause_s <= 10.0 &&
                       rhythm_window_s >= 2.0 * longest_interval_s + 10.0 * kCell_s &&
                       rhythm_window_s <= 20.0 && longest_delay_s > 0.0 && longest_delay_s <= 20.0;
  const bool ratios = relative_prominence_ratio >= 0.0 && relative_prominence_ratio < 1.0 &&
                      stay_correlation_ratio >= 0.0 &&
                      start_correlation_ratio >= stay_correlation_ratio &&
                      start_correlation_ratio < 1.0;
  if (!(positive && ordered && ratios)) {
    return core::fail(
        core::ErrorCode::kInvalidOptions,
        "need positive values, at least 2 first_steps, ratios in [0, 1) with start >= "
        "stay, 0.1 <= shortest < longest interval < pause, a rhythm window of twice "
        "the longest interval and 0.4 s or more",
        "cadence_step_detector");
  }
  return {};
}

std::optional<Step> CadenceStepDetector::add(const StepInput& input) {
  const bool in_order = !last_sample_ || input.time >= *last_sample_;
  if (!is_usable(input) || !in_order) return take_told();
  const bool gap = !last_sample_ || core::to_seconds(input.time - *last_sample_) > options_.pause_s;
  if (gap) {
    restart(input);
  } else {
    smooth(input);
  }
  last_sample_ = input.time;
  return take_told();
}

void CadenceStepDetector::restart(const StepInput& input) {
  stage_one_ = stage_two_ = {input.norm_mps2, input.vertical_mps2};
  slow_mps2_ = input.norm_mps2;
  origin_ = input.time + kCell;
  cells_.clear();
  peaks_.clear();
  open_ = {};
  forgotten_ = next_candidate_ = last_peak_cell_ = 0;
  walking_ = false;
  last_step_.reset();
}

void CadenceStepDetector::smooth(const StepInput& input) {
  const double dt_s = core::to_seconds(input.time - *last_sample_);
  const double low_gain = gain(options_.low_pass_hz, dt_s);
  const Smoothed before = stage_two_;
  const double norm_before_mps2 = before.norm_mps2 - slow_mps2_;
  stage_one_.norm_mps2 += low_gain * (input.norm_mps2 - stage_one_.norm_mps2);
  stage_one_.vertical_mps2 += low_gain * (input.vertical_mps2 - stage_one_.vertical_mps2);
  stage_two_.norm_mps2 += low_gain * (stage_one_.norm_mps2 - stage_two_.norm_mps2);
  stage_two_.vertical_mps2 += low_gain * (stage_one_.vertical_mps2 - stage_two_.vertical_mps2);
  slow_mps2_ += gain(options_.high_pass_hz, dt_s) * (stage_two_.norm_mps2 - slow_mps2_);
  close_cells(input.time, before, norm_before_mps2);
  if (dt_s > 0.0) open_.take(stage_two_.vertical_mps2);
}

void CadenceStepDetector::close_cells(core::DeviceTime time, const Smoothed& before,
                                      double norm_before_mps2) {
  const double norm_mps2 = stage_two_.norm_mps2 - slow_mps2_;
  for (core::DeviceTime end = time_of(cell_count()); end <= time; end += kCell) {
    const double share =
        core::to_seconds(end - *last_sample_) / core::to_seconds(time - *last_sample_);
    open_.norm_mps2 = norm_before_mps2 + share * (norm_mps2 - norm_before_mps2);
    open_.take(before.vertical_mps2 + share * (stage_two_.vertical_mps2 - before.vertical_mps2));
    cells_.push_back(open_);
    open_ = {};
    look_for_peak();
  }
  const std::size_t kept = cells_of(
      std::max(options_.rhythm_window_s, options_.longest_delay_s + 2.0 * options_.pause_s));
  for (; cells_.size() > kept; ++forgotten_) cells_.pop_front();
}

void CadenceStepDetector::Cell::take(double vertical_mps2) {
  highest_mps2 = count == 0 ? vertical_mps2 : std::max(highest_mps2, vertical_mps2);
  lowest_mps2 = count == 0 ? vertical_mps2 : std::min(lowest_mps2, vertical_mps2);
  sum_mps2 += vertical_mps2;
  abs_sum_mps2 += std::abs(vertical_mps2);
  ++count;
}

core::DeviceTime CadenceStepDetector::time_of(std::size_t index) const {
  return origin_ + static_cast<core::Duration::rep>(index) * kCell;
}

std::size_t CadenceStepDetector::reach() const {
  const double reach_s = walking_ ? kReachRatio * interval_s_ : kIdleReach_s;
  return std::max<std::size_t>(2, cells_of(reach_s));
}

void CadenceStepDetector::look_for_peak() {
  for (; next_candidate_ + reach() < cell_count(); ++next_candidate_) {
    if (!is_highest(next_candidate_, reach())) continue;
    const Peak peak = peak_at(next_candidate_);
    const double fall_mps2 =
        cell(next_candidate_).norm_mps2 - cell(next_candidate_ + reach()).norm_mps2;
    if (fall_mps2 < kFallRatio * peak.prominence_mps2) continue;
    const double least_mps2 =
        std::max(options_.min_prominence_mps2,
                 walking_ ? options_.relative_prominence_ratio * prominence_mps2_ : 0.0);
    if (peak.prominence_mps2 < least_mps2) continue;
    last_peak_cell_ = next_candidate_;
    peaks_.push_back(peak);
    while (core::to_seconds(peak.time - peaks_.front().time) > options_.longest_delay_s) {
      peaks_.pop_front();
    }
    judge(peak);
  }
}

bool CadenceStepDetector::is_highest(std::size_t index, std::size_t reach) const {
  if (index < reach + forgotten_) return false;
  const double height_mps2 = cell(index).norm_mps2;
  for (std::size_t i = 1; i <= reach; ++i) {
    // Of a flat top the first cell.
    if (cell(index - i).norm_mps2 >= height_mps2) return false;
    if (cell(index + i).norm_mps2 > height_mps2) return false;
  }
  return true;
}

CadenceStepDetector::Peak CadenceStepDetector::peak_at(std::size_t index) const {
  const double height_mps2 = cell(index).norm_mps2;
  const std::size_t before = cells_of(options_.pause_s);
  const std::size_t begin =
      std::max({last_peak_cell_, forgotten_, index > before ? index - before : 0});
  double valley_mps2 = height_mps2;
  for (std::size_t i = begin; i < index; ++i) {
    valley_mps2 = std::min(valley_mps2, cell(i).norm_mps2);
  }
  const double beside_s =
      kCell_s * vertex(cell(index - 1).norm_mps2, height_mps2, cell(index + 1).norm_mps2);
  return {time_of(index) + core::from_seconds(beside_s), height_mps2 - valley_mps2};
}

std::optional<Rhythm> CadenceStepDetector::rhythm() const {
  const std::size_t window = std::min(cells_of(options_.rhythm_window_s), cells_.size());
  std::vector<double> signal;
  signal.reserve(window);
  for (std::size_t i = cells_.size() - window; i < cells_.size(); ++i) {
    signal.push_back(cells_[i].norm_mps2);
  }
  return find_rhythm(signal, kCell_s, {options_.shortest_interval_s, options_.longest_interval_s});
}

void CadenceStepDetector::judge(const Peak& peak) {
  const std::optional<Rhythm> found = rhythm();
  const double since_s =
      last_step_ ? core::to_seconds(peak.time - *last_step_) : 2.0 * options_.pause_s;
  const bool in_rhythm =
      !found || found->stride_correlation_ratio >= options_.stay_correlation_ratio;
  walking_ = walking_ && since_s <= options_.pause_s && in_rhythm;
  if (!walking_) {
    const bool certain =
        found && found->stride_correlation_ratio >= options_.start_correlation_ratio;
    const std::optional<Rhythm> start = certain ? found : rhythm_of_clear_peaks();
    if (start) begin_walk(*start);
    return;
  }
  if (found) interval_s_ += kIntervalGain * (found->step_interval_s - interval_s_);
  if (since_s < kApartRatio * interval_s_) return;
  prominence_mps2_ += kProminenceGain * (peak.prominence_mps2 - prominence_mps2_);
  if (found && hides_a_step(since_s, *found)) {
    tell(*last_step_ + (peak.time - *last_step_) / 2);
  }
  tell(peak.time);
}

/// Of the newest peaks, if they are clear, alike and even; without a sign of hidden steps.
std::optional<Rhythm> CadenceStepDetector::rhythm_of_clear_peaks() const {
  if (peaks_.size() < options_.first_steps) return std::nullopt;
  const auto first = peaks_.end() - static_cast<std::ptrdiff_t>(options_.first_steps);
  const auto [weakest, strongest] = std::minmax_element(
      first, peaks_.end(),
      [](const Peak& a, const Peak& b) { return a.prominence_mps2 < b.prominence_mps2; });
  double shortest_s = options_.longest_interval_s;
  double longest_s = options_.shortest_interval_s;
  for (auto peak = first + 1; peak != peaks_.end(); ++peak) {
    const double interval_s = core::to_seconds(peak->time - (peak - 1)->time);
    shortest_s = std::min(shortest_s, interval_s);
    longest_s = std::max(longest_s, interval_s);
  }
  const bool clear = weakest->prominence_mps2 >= options_.clear_prominence_mps2 &&
                     weakest->prominence_mps2 >= kAlikeRatio * strongest->prominence_mps2;
  const bool even = shortest_s >= options_.shortest_interval_s &&
                    longest_s <= options_.longest_interval_s &&
                    longest_s <= kEvenRatio * shortest_s;
  if (!clear || !even) return std::nullopt;
  const double span_s = core::to_seconds(peaks_.back().time - first->time);
  return Rhythm{span_s / static_cast<double>(options_.first_steps - 1), -1.0, 0.0};
}

/// Whether the other foot stepped between two peaks without a peak of its own. It must show in the
/// signal's likeness to itself after one step, else a slow walker would be counted double.
bool CadenceStepDetector::hides_a_step(double span_s, const Rhythm& found) const {
  return span_s >= kHiddenRatio * interval_s_ && span_s <= options_.pause_s &&
         found.step_correlation_ratio >= kOtherFootRatio;
}

/// Goes back from the newest peak along those that fit the rhythm, and tells them if they suffice.
void CadenceStepDetector::begin_walk(const Rhythm& found) {
  interval_s_ = found.step_interval_s;
  const double apart_s = kApartRatio * interval_s_;
  std::vector<core::DeviceTime> times;
  double sum_mps2 = 0.0;
  std::size_t peaks = 0;
  for (auto peak = peaks_.rbegin(); peak != peaks_.rend(); ++peak) {
    if (last_step_ && core::to_seconds(peak->time - *last_step_) < apart_s) break;
    if (peaks > 0) {
      const core::Duration span = times.back() - peak->time;
      const double span_s = core::to_seconds(span);
      if (span_s < apart_s) continue;
      const double least_ratio = options_.relative_prominence_ratio / static_cast<double>(peaks);
      if (span_s > options_.pause_s || peak->prominence_mps2 < least_ratio * sum_mps2) break;
      if (hides_a_step(span_s, found)) times.push_back(peak->time + span / 2);
    }
    times.push_back(peak->time);
    sum_mps2 += peak->prominence_mps2;
    ++peaks;
  }
  if (times.size() < options_.first_steps) return;
  walking_ = true;
  prominence_mps2_ = sum_mps2 / static_cast<double>(peaks);
  for (auto time = times.rbegin(); time != times.rend(); ++time) tell(*time);
}

void CadenceStepDetector::tell(core::DeviceTime time) {
  const double since_s = last_step_ ? core::to_seconds(time - *last_step_) : 2.0 * options_.pause_s;
  Step step;
  step.time = time;
  step.interval_s = std::min(since_s, options_.pause_s);
  // After a pause the standing before the first step says nothing about it.
  const double span_s = since_s <= options_.pause_s ? since_s : interval_s_;
  const core::DeviceTime end = time + kCell / 2;
  const core::DeviceTime begin = end - core::from_seconds(span_s);
  Cell whole;
  for (std::size_t i = forgotten_; i < cell_count(); ++i) {
    if (time_of(i) <= begin || time_of(i) > end) continue;
    whole.highest_mps2 = whole.count == 0 ? cell(i).highest_mps2
                                          : std::max(whole.highest_mps2, cell(i).highest_mps2);
    whole.lowest_mps2 =
        whole.count == 0 ? cell(i).lowest_mps2 : std::min(whole.lowest_mps2, cell(i).lowest_mps2);
    whole.sum_mps2 += cell(i).sum_mps2;
    whole.abs_sum_mps2 += cell(i).abs_sum_mps2;
    whole.count += cell(i).count;
  }
  const double count = std::max(1.0, static_cast<double>(whole.count));
  step.swing_mps2 = whole.highest_mps2 - whole.lowest_mps2;
  step.mean_abs_mps2 = whole.abs_sum_mps2 / count;
  step.mean_mps2 = whole.sum_mps2 / count;
  step.lowest_mps2 = whole.lowest_mps2;
  last_step_ = time;
  told_.push_back(step);
}

std::optional<Step> CadenceStepDetector::take_told() {
  if (told_.empty()) return std::nullopt;
  const Step step = told_.front();
  told_.pop_front();
  return step;
}

}  // namespace waylode::pdr
