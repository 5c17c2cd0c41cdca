// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/pdr/detail/low_pass.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// Finds footfalls in the vertical acceleration as it streams, with no look ahead: a peak is a step
/// once the signal has fallen back through zero. The threshold follows the walker's own peaks.
class StepDetector final : public StepSource {
 public:
  struct Options {
    double low_pass_hz = 3.0;          ///< Cut-off of the smoothing; cadence is below 3 Hz.
    double min_peak_mps2 = 0.55;       ///< Lower peaks are never steps.
    double relative_peak_ratio = 0.4;  ///< Of the recent peaks, what a new one must reach.
    double shortest_interval_s = 0.28;
    double longest_interval_s = 1.2;  ///< A longer pause starts a new walk.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit StepDetector(const Options& options)
      : options_(options), low_pass_(options.low_pass_hz) {}

  /// Looks at the vertical acceleration alone. Values that are not finite are passed over.
  std::optional<Step> add(const StepInput& input) override;

 private:
  double smooth(core::DeviceTime time, double vertical_mps2);
  bool continues_walk() const;
  double threshold_mps2() const;
  void forget_extremes();
  Step take_step();

  Options options_;
  std::optional<core::DeviceTime> last_sample_;
  detail::LowPass low_pass_;
  double recent_peak_mps2_ = 0.0;
  std::optional<core::DeviceTime> last_step_;
  // Extremes since the last step, and the peak that waits for its confirmation.
  double lowest_mps2_ = 0.0;
  double peak_mps2_ = 0.0;
  core::DeviceTime peak_time_;
  double sum_mps2_ = 0.0;
  double abs_sum_mps2_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace waylode::pdr
