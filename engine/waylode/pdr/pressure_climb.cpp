// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/pressure_climb.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::pdr {
namespace {

/// Height above where the pressure is that of the standard atmosphere at sea level. Only
/// differences are used: the weather moves all of it.
double height_of(double pressure_hpa) {
  constexpr double kSeaLevel_hpa = 1013.25;
  constexpr double kScale_m = 44330.77;
  constexpr double kExponent = 0.190263;
  return kScale_m * (1.0 - std::pow(pressure_hpa / kSeaLevel_hpa, kExponent));
}

}  // namespace

core::Result<void> PressureClimb::Options::validate() const {
  if (!(averaging_s > 0.0 && drift_tau_s > averaging_s && certain_climb_m > 0.0 &&
        report_step_m > 0.0 && least_rise_s >= 0.0 && rest_s > averaging_s && rest_band_m > 0.0 &&
        sigma_m > 0.0 && longest_gap_s > averaging_s)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "all must be positive; drift_tau_s, rest_s and longest_gap_s above "
                      "averaging_s",
                      "pressure_climb");
  }
  return {};
}

std::optional<observation::VerticalMotion> PressureClimb::add(
    const sample::BarometerSample& sample) {
  if (!std::isfinite(sample.pressure_hpa) || !(sample.pressure_hpa > 0.0)) return std::nullopt;
  if (block_begin_) {
    if (sample.time <= newest_) return std::nullopt;
    if (core::to_seconds(sample.time - newest_) > options_.longest_gap_s) restart();
  }
  std::optional<observation::VerticalMotion> told;
  if (block_begin_ && core::to_seconds(sample.time - *block_begin_) >= options_.averaging_s) {
    told = take(Height{newest_, block_sum_m_ / static_cast<double>(block_count_)});
    block_begin_.reset();
  }
  if (!block_begin_) {
    block_begin_ = sample.time;
    block_sum_m_ = 0.0;
    block_count_ = 0;
  }
  newest_ = sample.time;
  block_sum_m_ += height_of(sample.pressure_hpa);
  ++block_count_;
  return told;
}

std::optional<observation::VerticalMotion> PressureClimb::take(const Height& height) {
  recent_.push_back(height);
  while (core::to_seconds(height.time - recent_.front().time) > options_.rest_s) {
    recent_.pop_front();
  }
  if (!rest_) {
    rest_ = height;
    low_until_ = height.time;
    return std::nullopt;
  }
  return climbing_since_ ? climb(height) : rest(height);
}

std::optional<observation::VerticalMotion> PressureClimb::rest(const Height& height) {
  const double off_m = height.height_m - rest_->height_m;
  if (std::abs(off_m) >= options_.certain_climb_m) {
    if (jumped(height)) {
      rest_->height_m = height.height_m;
      low_until_ = height.time;
      return std::nullopt;
    }
    climbing_since_ = low_until_;
    return tell(height.time, off_m);
  }
  // What may be the beginning of a climb moves the rest height little, or slow stairs would hide.
  constexpr double kSlower = 0.2;
  const bool low = std::abs(off_m) <= options_.certain_climb_m / 3.0;
  if (low) low_until_ = height.time;
  const double passed_s = core::to_seconds(height.time - rest_->time);
  const double share = std::min(1.0, (low ? 1.0 : kSlower) * passed_s / options_.drift_tau_s);
  rest_->height_m += share * off_m;
  rest_->time = height.time;
  return std::nullopt;
}

bool PressureClimb::jumped(const Height& height) const {
  constexpr double kMost = 0.9;
  return std::ranges::any_of(recent_, [&](const Height& before) {
    return core::to_seconds(height.time - before.time) < options_.least_rise_s &&
           std::abs(height.height_m - before.height_m) >= kMost * options_.certain_climb_m;
  });
}

std::optional<observation::VerticalMotion> PressureClimb::climb(const Height& height) {
  const auto [least, most] = std::ranges::minmax_element(recent_, {}, &Height::height_m);
  const double seen_s =
      core::to_seconds(height.time - std::max(recent_.front().time, *climbing_since_));
  const bool rests = seen_s >= options_.rest_s - 2.0 * options_.averaging_s &&
                     most->height_m - least->height_m <= options_.rest_band_m;
  if (!rests) {
    const double climb_m = height.height_m - rest_->height_m;
    if (std::abs(climb_m - told_m_) < options_.report_step_m) return std::nullopt;
    return tell(height.time, climb_m);
  }
  double mean_m = 0.0;
  for (const Height& each : recent_) mean_m += each.height_m / static_cast<double>(recent_.size());
  const double climb_m = mean_m - rest_->height_m;
  std::optional<observation::VerticalMotion> told;
  if (std::abs(climb_m - told_m_) >= 0.5 * options_.report_step_m) {
    told = tell(height.time, climb_m);
  }
  climbing_since_.reset();
  rest_ = Height{height.time, mean_m};
  low_until_ = height.time;
  return told;
}

observation::VerticalMotion PressureClimb::tell(core::DeviceTime end, double climb_m) {
  told_m_ = climb_m;
  return {*climbing_since_, end, climb_m, options_.sigma_m};
}

void PressureClimb::restart() {
  block_begin_.reset();
  rest_.reset();
  climbing_since_.reset();
  recent_.clear();
}

}  // namespace waylode::pdr
