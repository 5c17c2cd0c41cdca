// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr::testing {

/// A made-up walker: how often, how strongly, how unevenly.
struct Gait {
  double cadence_hz = 1.8;
  double swing_mps2 = 7.0;
  double cadence_spread_ratio = 0.03;  ///< From step to step.
  double swing_spread_ratio = 0.06;
  double noise_mps2 = 0.35;  ///< Of each sample.
  double rate_hz = 100.0;
  double time_jitter_s = 0.0;  ///< Of each sample's time; below half a sample.
};

struct Walk {
  std::vector<StepInput> inputs;
  std::vector<core::DeviceTime> step_begins;
};

/// Stands, walks so many steps, stands. A step's wave has a second and a third harmonic, as heel
/// and toe make them.
inline Walk walk(const Gait& gait, std::size_t step_count, core::Rng& rng, double begin_s = 0.0,
                 double stand_s = 1.5) {
  Walk result;
  std::vector<double> begins_s;
  std::vector<double> swings_mps2;
  double time_s = begin_s + stand_s;
  for (std::size_t i = 0; i < step_count; ++i) {
    begins_s.push_back(time_s);
    result.step_begins.push_back(core::device_time_from_seconds(time_s));
    swings_mps2.push_back(gait.swing_mps2 * std::exp(gait.swing_spread_ratio * rng.normal()));
    time_s += 1.0 / (gait.cadence_hz * (1.0 + gait.cadence_spread_ratio * rng.normal()));
  }
  begins_s.push_back(time_s);
  const double end_s = time_s + stand_s;
  std::size_t step = 0;
  for (int i = 0; begin_s + i / gait.rate_hz < end_s; ++i) {
    const double now_s = begin_s + i / gait.rate_hz + gait.time_jitter_s * rng.uniform(-1.0, 1.0);
    while (step + 1 < begins_s.size() && now_s >= begins_s[step + 1]) ++step;
    double value_mps2 = gait.noise_mps2 * rng.normal();
    if (step < step_count && now_s >= begins_s[step]) {
      const double phase_rad =
          2.0 * core::kPi * (now_s - begins_s[step]) / (begins_s[step + 1] - begins_s[step]);
      const double wave = std::sin(phase_rad - core::kPi / 2.0) +
                          0.28 * std::sin(2.0 * phase_rad + 0.6) + 0.1 * std::sin(3.0 * phase_rad);
      constexpr double kWaveSwing = 2.4;  // Largest less smallest of the above, nearly.
      value_mps2 += swings_mps2[step] / kWaveSwing * wave;
    }
    result.inputs.push_back({core::device_time_from_seconds(now_s), value_mps2, value_mps2});
  }
  return result;
}

/// All that a detector tells of a stream.
inline std::vector<Step> feed(StepSource& source, const std::vector<StepInput>& inputs) {
  std::vector<Step> steps;
  for (const StepInput& input : inputs) {
    if (const auto step = source.add(input)) steps.push_back(*step);
  }
  return steps;
}

/// A plain sinusoid of so many seconds.
inline std::vector<StepInput> sinusoid(double amplitude_mps2, double frequency_hz, double rate_hz,
                                       double duration_s, double begin_s = 0.0) {
  std::vector<StepInput> inputs;
  for (int i = 0; i < static_cast<int>(duration_s * rate_hz); ++i) {
    const double value_mps2 =
        amplitude_mps2 * std::sin(2.0 * core::kPi * frequency_hz * i / rate_hz);
    inputs.push_back(
        {core::device_time_from_seconds(begin_s + i / rate_hz), value_mps2, value_mps2});
  }
  return inputs;
}

}  // namespace waylode::pdr::testing
