// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/gaussian_smoother.hpp"

#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::pdr {

std::optional<TimedValue> GaussianSmoother::add(core::DeviceTime time, double value) {
  WAYLODE_ASSERT(std::isfinite(value));
  window_.push_back({time, value});
  const core::DeviceTime begin = time - core::from_seconds(window_s_);
  if (window_.front().time > begin) return std::nullopt;
  while (window_.size() > 1 && window_[1].time <= begin) window_.pop_front();

  // [Zhao2019] eq. (13): weights exp(-t^2 / 2 sigma^2) about the middle of the window.
  const core::DeviceTime centre = time - core::from_seconds(0.5 * window_s_);
  const double sigma_s = window_s_ / 6.0;
  double weight_sum = 0.0;
  double sum = 0.0;
  for (const TimedValue& each : window_) {
    const double away = core::to_seconds(each.time - centre) / sigma_s;
    const double weight = std::exp(-0.5 * away * away);
    weight_sum += weight;
    sum += weight * each.value;
  }
  // Where the samples are far apart, all weights may vanish.
  if (!(weight_sum > 0.0)) return TimedValue{time, value};
  return TimedValue{centre, sum / weight_sum};
}

}  // namespace waylode::pdr
