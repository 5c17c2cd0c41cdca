// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/decision_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {

core::Result<void> DecisionFlow::Options::validate() const {
  constexpr int kMostPairs = 1000;
  const bool sound = std::isfinite(threshold_m) && threshold_m >= 0.0 && pairs >= 1 &&
                     pairs <= kMostPairs && literal_gain_ratio >= 0.0 && literal_gain_ratio <= 1.0;
  if (!sound) {
    return core::fail(
        core::ErrorCode::kInvalidOptions,
        "threshold_m must not be negative, pairs 1 to 1000, literal_gain_ratio 0 to 1",
        "decision_flow");
  }
  return filter.validate();
}

DecisionFlow::DecisionFlow(const Options& options) : options_(options), filter_(options.filter) {}

void DecisionFlow::start(const PlanarEstimate& place) {
  filter_.start(place);
  begin(place);
}

void DecisionFlow::begin(const PlanarEstimate& place) {
  walked_ = place;
  last_fix_ = place.time;
  path_.clear();
  differences_m_.clear();
}

bool DecisionFlow::add(const observation::MotionDelta& motion) {
  if (!filter_.add(motion)) return false;
  const core::Vector2 step_m = displacement_m(motion);
  walked_.position_m += step_m;
  const double across_m = motion.length_m * motion.heading_sigma_rad;
  walked_.covariance_m2 += (motion.length_sigma_m * motion.length_sigma_m + across_m * across_m) *
                           core::Matrix2::Identity();
  walked_.time = std::max(walked_.time, motion.end);
  path_.add(motion);
  return true;
}

std::optional<DecisionFlow::Comparison> DecisionFlow::add(const PlanarMeasurement& fix) {
  if (!detail::is_sound(fix)) return std::nullopt;
  if (!started()) {
    filter_.add(fix);
    begin(filter_.at(fix.delivered));
    return Comparison{};
  }
  if (fix.delivered < last_fix_) return std::nullopt;
  last_fix_ = fix.delivered;
  if (options_.mode == DecisionMode::kWuLiteral) return compare_literally(fix);

  const core::Vector2 walked_m =
      filter_.filter().mean().head<2>() + filter_.walked_offset_m(fix.measured);
  Comparison result{(fix.position_m - walked_m).norm()};
  const bool is_large = result.difference_m > options_.threshold_m;
  if (options_.mode == DecisionMode::kEveryFix || is_large) {
    result.corrected = filter_.add(fix).has_value();
  }
  return result;
}

// [Wu2019] figure 3: the sample points are the last compared pairs; the corrected position lies
// between the means of the walked and of the fingerprint positions.
DecisionFlow::Comparison DecisionFlow::compare_literally(const PlanarMeasurement& fix) {
  walked_.time = std::max(walked_.time, fix.delivered);
  differences_m_.push_back(fix.position_m - path_.offset_m(fix.measured) - walked_.position_m);
  if (differences_m_.size() > static_cast<std::size_t>(options_.pairs)) differences_m_.pop_front();
  Comparison result{differences_m_.back().norm()};
  if (result.difference_m <= options_.threshold_m) return result;

  const core::Vector2 sum_m =
      std::accumulate(differences_m_.begin(), differences_m_.end(), core::Vector2(0.0, 0.0));
  const double gain = options_.literal_gain_ratio;
  const core::Vector2 shift_m = gain * sum_m / static_cast<double>(differences_m_.size());
  walked_.position_m += shift_m;
  for (core::Vector2& difference_m : differences_m_) difference_m -= shift_m;
  // Radio errors persist over the pairs: their mean is taken to be no better than one of them.
  walked_.covariance_m2 =
      (1.0 - gain) * (1.0 - gain) * walked_.covariance_m2 + gain * gain * fix.covariance_m2;
  result.corrected = true;
  return result;
}

PlanarEstimate DecisionFlow::at(core::DeviceTime time) const {
  WAYLODE_ASSERT(started());
  if (options_.mode != DecisionMode::kWuLiteral) return filter_.at(time);
  PlanarEstimate result = walked_;
  result.time = time;
  result.position_m += path_.offset_m(time);
  const double waited_s = std::max(0.0, core::to_seconds(time - walked_.time));
  result.covariance_m2 += std::pow(options_.filter.position_walk_m_per_sqrt_s, 2) * waited_s *
                          core::Matrix2::Identity();
  return result;
}

}  // namespace waylode::fusion
