// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::pdr {

/// Tells stairs, lifts and escalators by the air pressure, from the height at which the person
/// last rested. The weather's drift is followed; jumps of the pressure, as of a door, are not taken
/// for climbs.
class PressureClimb {
 public:
  struct Options {
    double averaging_s = 0.3;      ///< Samples are averaged over this long, s; 0.2 to 2.
    double drift_tau_s = 20.0;     ///< The rest height follows what is measured this slowly, s.
    double certain_climb_m = 1.5;  ///< From this far off the rest height it is a climb, m.
    double report_step_m = 0.5;    ///< A climb is told again when it has gone this far on, m.
    /// Nine tenths of certain_climb_m in less time than this, s, are a jump of the pressure, as of
    /// a door; lifts take longer to get going.
    double least_rise_s = 0.7;
    double rest_s = 12.0;         ///< A climb has ended when this long, s, ...
    double rest_band_m = 0.6;     ///< ... all heights lie within this of each other, m.
    double sigma_m = 0.6;         ///< Of each climb told.
    double longest_gap_s = 60.0;  ///< Without samples for longer, all starts anew, s.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit PressureClimb(const Options& options) : options_(options) {}

  /// Samples by time; those that are not finite and positive or come late are passed over. Reports
  /// of one climb have the same `begin`; each replaces the one before.
  std::optional<observation::VerticalMotion> add(const sample::BarometerSample& sample);

 private:
  struct Height {
    core::DeviceTime time;
    double height_m = 0.0;
  };

  std::optional<observation::VerticalMotion> take(const Height& height);
  std::optional<observation::VerticalMotion> rest(const Height& height);
  std::optional<observation::VerticalMotion> climb(const Height& height);
  bool jumped(const Height& height) const;
  observation::VerticalMotion tell(core::DeviceTime end, double climb_m);
  void restart();

  Options options_;
  std::optional<core::DeviceTime> block_begin_;  ///< Of the samples being averaged.
  core::DeviceTime newest_;
  double block_sum_m_ = 0.0;
  std::size_t block_count_ = 0;
  std::optional<Height> rest_;  ///< Where the person rests or last rested, and when it was there.
  core::DeviceTime low_until_;  ///< Newest time within a third of a climb from the rest height.
  std::optional<core::DeviceTime> climbing_since_;
  double told_m_ = 0.0;        ///< Of the present climb.
  std::deque<Height> recent_;  ///< The last rest_s.
};

}  // namespace waylode::pdr
