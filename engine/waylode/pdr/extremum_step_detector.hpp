// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/pdr/decimator.hpp"
#include "waylode/pdr/detail/step_window.hpp"
#include "waylode/pdr/extremum_finder.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// A step is a peak above one threshold followed by a trough below another [Zhong2017], in the
/// vertical acceleration thinned out to 25 Hz and averaged over four values. The thresholds are the
/// person's: see calibrate_thresholds.
class ExtremumStepDetector final : public StepSource {
 public:
  struct Options {
    Decimator::Options decimator{};
    double peak_threshold_mps2 = 0.6;     ///< [Zhong2017] p.
    double trough_threshold_mps2 = -0.6;  ///< [Zhong2017] q, below p.
    /// On: once above p, then below q, whatever lies between. Off: the peak and the trough must
    /// follow each other at once, as printed; a ripple between them loses the step.
    bool hysteresis = true;
    double longest_interval_s = 1.2;  ///< A longer pause starts a new walk.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit ExtremumStepDetector(const Options& options)
      : options_(options), filter_(options.decimator), window_(options.longest_interval_s) {}

  /// Values that are not finite are passed over.
  std::optional<Step> add(const StepInput& input) override;

  /// The thinned and averaged signal that the thresholds apply to; calibrate_thresholds wants it.
  class Filter {
   public:
    explicit Filter(const Decimator::Options& options) : decimator_(options) {}
    std::optional<TimedValue> add(core::DeviceTime time, double value);
    void clear();

   private:
    Decimator decimator_;
    std::deque<TimedValue> last_;
  };

 private:
  std::optional<core::DeviceTime> by_level(const TimedValue& value);
  std::optional<core::DeviceTime> by_extremes(const TimedValue& value);

  Options options_;
  Filter filter_;
  detail::StepWindow window_;
  std::optional<core::DeviceTime> last_sample_;
  std::optional<TimedValue> highest_;  ///< Since the signal rose above p; armed while set.
  ExtremumFinder finder_;
  std::optional<Extremum> last_extremum_;
};

}  // namespace waylode::pdr
