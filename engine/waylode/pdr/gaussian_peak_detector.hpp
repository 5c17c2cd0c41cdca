// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/pdr/detail/step_window.hpp"
#include "waylode/pdr/extremum_finder.hpp"
#include "waylode/pdr/gaussian_smoother.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// Every peak of the Gaussian-smoothed vertical acceleration above a fixed height is a step
/// [Zhao2019].
class GaussianPeakDetector final : public StepSource {
 public:
  struct Options {
    double window_s = 0.2;              ///< Of the smoothing, in (0, 5]; longer erases fast steps.
    double min_peak_mps2 = 0.5;         ///< Lower peaks are no steps.
    double sample_interval_s = 0.0;     ///< Take one sample per so many seconds; 0 takes all.
    double shortest_interval_s = 0.25;  ///< Between two steps; 0 takes every peak for a step.
    double longest_interval_s = 1.2;    ///< A longer pause starts a new walk.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// As the paper prints it: one sample in 200 ms, ten of them in the window. Loses nearly every
  /// step, which take half a second.
  static Options as_printed();

  explicit GaussianPeakDetector(const Options& options)
      : options_(options), smoother_(options.window_s), window_(options.longest_interval_s) {}

  /// Values that are not finite are passed over.
  std::optional<Step> add(const StepInput& input) override;

 private:
  bool is_taken(core::DeviceTime time);

  Options options_;
  GaussianSmoother smoother_;
  ExtremumFinder extremes_;
  detail::StepWindow window_;
  std::optional<core::DeviceTime> last_sample_;
};

}  // namespace waylode::pdr
