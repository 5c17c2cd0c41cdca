// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/decimator.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/core/assert.hpp"

namespace waylode::pdr {
namespace {

constexpr double kHalfWindow = 1.5;  // Intervals.

/// The next time on the grid after `due`, skipping those that lie more than an interval before
/// `now`.
core::DeviceTime next_due(core::DeviceTime due, core::DeviceTime now, core::Duration interval) {
  due += interval;
  if (due + interval <= now) due += (now - due) / interval * interval;
  return due;
}

}  // namespace

core::Result<void> Decimator::Options::validate() const {
  if (!(interval_s >= 1e-6 && interval_s <= 10.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "interval_s must be in [1e-6, 10]",
                      "decimator");
  }
  return {};
}

void Decimator::clear() {
  due_.reset();
  samples_.clear();
}

std::optional<TimedValue> Decimator::add(core::DeviceTime time, double value) {
  WAYLODE_ASSERT(std::isfinite(value));
  const core::Duration interval = core::from_seconds(options_.interval_s);
  if (!due_) due_ = time;
  if (options_.anti_alias) {
    // Nothing to average with what came so long before: it would be told for a time in between.
    const bool alone = !samples_.empty() && time - samples_.back().time > 2 * interval;
    if (alone) {
      samples_.clear();
      due_ = time + interval;
    }
    samples_.push_back({time, value});
    return alone ? std::optional(samples_.front()) : average(time);
  }
  // A tenth of an interval of grace, lest jitter makes every fifth sample of the fourth.
  if (time < *due_ - interval / 10) return std::nullopt;
  due_ = next_due(*due_, time, interval);
  return TimedValue{time, value};
}

std::optional<TimedValue> Decimator::average(core::DeviceTime now) {
  const core::Duration interval = core::from_seconds(options_.interval_s);
  const core::Duration half_window = core::from_seconds(kHalfWindow * options_.interval_s);
  if (now < *due_ + half_window) return std::nullopt;
  const core::DeviceTime centre = *due_ > now - half_window - interval ? *due_ : now - half_window;
  due_ = next_due(centre, now - half_window, interval);

  while (samples_.size() > 1 && samples_.front().time <= centre - half_window) samples_.pop_front();
  double weight_sum = 0.0;
  double sum = 0.0;
  for (const TimedValue& sample : samples_) {
    const double away = core::to_seconds(sample.time - centre) / core::to_seconds(half_window);
    const double weight = std::abs(away) < 1.0 ? 0.5 + 0.5 * std::cos(core::kPi * away) : 0.0;
    weight_sum += weight;
    sum += weight * sample.value;
  }
  WAYLODE_ASSERT(weight_sum > 0.0);
  return TimedValue{centre, sum / weight_sum};
}

}  // namespace waylode::pdr
