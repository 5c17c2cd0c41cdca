// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/adaptive_peak_detector.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pdr {
namespace {

constexpr std::size_t kPeaksJudged = 3;  // [Wu2019] n.

std::size_t index_of(AdaptivePeakDetector::Gait gait) { return static_cast<std::size_t>(gait); }

/// How well each band explains the peaks; sums to one.
std::array<double, AdaptivePeakDetector::kGaitCount> likelihoods(
    const std::array<AdaptivePeakDetector::Band, AdaptivePeakDetector::kGaitCount>& bands,
    double mean_peak_mps2, double cadence_hz) {
  std::array<double, AdaptivePeakDetector::kGaitCount> logs{};
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const AdaptivePeakDetector::Band& band = bands[i];
    const double peak = (mean_peak_mps2 - band.peak_mps2) / band.peak_sigma_mps2;
    const double cadence = (cadence_hz - band.cadence_hz) / band.cadence_sigma_hz;
    logs[i] = -0.5 * (peak * peak + cadence * cadence) -
              std::log(band.peak_sigma_mps2 * band.cadence_sigma_hz);
  }
  // Relative to the best, lest all vanish between the bands.
  const double best = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (double& value : logs) sum += (value = std::exp(value - best));
  for (double& value : logs) value /= sum;
  return logs;
}

bool is_sound(const AdaptivePeakDetector::Band& band) {
  return std::isfinite(band.peak_mps2) && std::isfinite(band.cadence_hz) && band.peak_mps2 >= 0.0 &&
         band.peak_sigma_mps2 > 0.0 && std::isfinite(band.peak_sigma_mps2) &&
         band.cadence_sigma_hz > 0.0 && std::isfinite(band.cadence_sigma_hz);
}

}  // namespace

std::array<AdaptivePeakDetector::Band, AdaptivePeakDetector::kGaitCount>
AdaptivePeakDetector::Options::default_bands() {
  return {{{.peak_mps2 = 0.2, .peak_sigma_mps2 = 0.3, .cadence_hz = 0.5, .cadence_sigma_hz = 0.8},
           {.peak_mps2 = 1.2, .peak_sigma_mps2 = 0.5, .cadence_hz = 1.4, .cadence_sigma_hz = 0.25},
           {.peak_mps2 = 2.4, .peak_sigma_mps2 = 0.9, .cadence_hz = 1.8, .cadence_sigma_hz = 0.2},
           {.peak_mps2 = 4.5, .peak_sigma_mps2 = 1.5, .cadence_hz = 2.2, .cadence_sigma_hz = 0.25},
           {.peak_mps2 = 9.0, .peak_sigma_mps2 = 3.5, .cadence_hz = 2.7, .cadence_sigma_hz = 0.4}}};
}

core::Result<void> AdaptivePeakDetector::Options::validate() const {
  const bool sound = low_pass_hz > 0.0 && history_weight >= 0.0 && history_weight < 1.0 &&
                     history_tau_s > 0.0 && relative_peak_ratio > 0.0 &&
                     relative_peak_ratio < 1.0 && noise_peak_mps2 > 0.0 &&
                     shortest_interval_s > 0.0 && longest_interval_s > shortest_interval_s &&
                     std::all_of(bands.begin(), bands.end(), is_sound);
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need positive values, history_weight and relative_peak_ratio below 1 and "
                      "longest > shortest interval",
                      "adaptive_peak_detector");
  }
  return {};
}

AdaptivePeakDetector::AdaptivePeakDetector(const Options& options)
    : options_(options), low_pass_(options.low_pass_hz), window_(options.longest_interval_s) {
  for (std::size_t i = 0; i < kGaitCount; ++i) mean_peak_mps2_[i] = options.bands[i].peak_mps2;
}

std::optional<Step> AdaptivePeakDetector::add(const StepInput& input) {
  if (!std::isfinite(input.vertical_mps2)) return std::nullopt;
  const double dt_s = last_sample_ ? core::to_seconds(input.time - *last_sample_) : 0.0;
  if (!last_sample_ || dt_s > options_.longest_interval_s) {
    low_pass_.restart(input.vertical_mps2);
    window_.clear();
    rising_.reset();
    stand_still();
  }
  last_sample_ = input.time;
  const double value_mps2 = low_pass_.add(input.vertical_mps2, dt_s);
  window_.add(input.time, value_mps2);
  if (value_mps2 > 0.0) {
    if (!rising_ || value_mps2 > rising_->height_mps2) rising_ = Peak{input.time, value_mps2};
  } else if (rising_) {
    take_peak(input.time);
  }
  const bool paused = !recent_.empty() && core::to_seconds(input.time - recent_.back().time) >
                                              options_.longest_interval_s;
  if (paused) stand_still();
  return tell();
}

void AdaptivePeakDetector::stand_still() {
  recent_.clear();
  waiting_.clear();
  gait_ = Gait::kStill;
}

void AdaptivePeakDetector::take_peak(core::DeviceTime now) {
  const Peak peak = *rising_;
  rising_.reset();
  if (peak.height_mps2 < options_.noise_peak_mps2) return;
  if (!recent_.empty()) {
    const double since_s = core::to_seconds(peak.time - recent_.back().time);
    if (since_s > options_.longest_interval_s) stand_still();
    if (since_s < options_.shortest_interval_s) return;
  }
  recent_.push_back(peak);
  if (recent_.size() > kPeaksJudged) recent_.pop_front();
  judge_gait(now);
  if (!is_step(peak)) return;
  waiting_.push_back(window_.take(peak.time));
  if (gait_ == Gait::kStill && waiting_.size() >= kPeaksJudged) waiting_.pop_front();
}

void AdaptivePeakDetector::judge_gait(core::DeviceTime now) {
  if (recent_.size() < kPeaksJudged) return;
  double mean_peak_mps2 = 0.0;
  for (const Peak& peak : recent_) mean_peak_mps2 += peak.height_mps2 / kPeaksJudged;
  const double cadence_hz =
      (kPeaksJudged - 1) / core::to_seconds(recent_.back().time - recent_.front().time);

  // [Wu2019] 2.2: the gait before counts less and less the longer it has lasted.
  const double weight = options_.history_weight *
                        std::exp(-core::to_seconds(now - gait_since_) / options_.history_tau_s);
  std::array<double, kGaitCount> scores = likelihoods(options_.bands, mean_peak_mps2, cadence_hz);
  for (double& score : scores) score *= 1.0 - weight;
  scores[index_of(gait_)] += weight;
  const auto best =
      static_cast<Gait>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  if (best != gait_) {
    gait_ = best;
    gait_since_ = now;
  }
  constexpr double kForget = 0.1;  // Share of the newest peaks in the gait's mean.
  double& mean = mean_peak_mps2_[index_of(gait_)];
  mean += kForget * (mean_peak_mps2 - mean);
}

bool AdaptivePeakDetector::is_step(const Peak& peak) const {
  // Who stands may be about to walk slowly.
  const Gait gait = std::max(gait_, Gait::kSlow);
  return peak.height_mps2 >= options_.relative_peak_ratio * mean_peak_mps2_[index_of(gait)];
}

std::optional<Step> AdaptivePeakDetector::tell() {
  if (gait_ == Gait::kStill || waiting_.empty()) return std::nullopt;
  const Step step = waiting_.front();
  waiting_.pop_front();
  return step;
}

}  // namespace waylode::pdr
