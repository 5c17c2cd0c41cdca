// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/fusion/path_memory.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/fusion/unscented_kalman_filter.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// Steps and radio positions in an unscented Kalman filter [Wu2019] 2.5. State: place, heading
/// offset (walking direction less PDR heading), log of the step scale, and the part of the radio
/// error that persists from scan to scan. A position that does not fit is believed less: its
/// covariance grows with its chi-square distance. Causal.
class StepPositionFilter {
 public:
  struct Options {
    SigmaSpread spread;
    double heading_offset_sigma_rad = 0.10;  ///< At the start; >= 0. Wide for a phone in the hand.
    double log_scale_sigma = 0.08;           ///< At the start; >= 0. Spread of strides over people.
    double heading_offset_walk_rad_per_sqrt_step = 0.007;  ///< >= 0.
    double log_scale_walk_per_sqrt_step = 0.002;           ///< >= 0.
    double position_walk_m_per_sqrt_s = 0.08;              ///< Movement that no step tells; > 0.
    double radio_bias_sigma_m = 1.0;                       ///< Per axis; 0: every scan errs anew.
    double radio_bias_tau_s = 10.0;  ///< How long a radio error persists; > 0.
    double radio_sigma_scale = 1.0;  ///< On the measurement's own sigma; > 0.
    /// Chi-square (two degrees of freedom) up to which a position is taken as it is; > 0, infinite:
    /// no doubt.
    double gate = 6.0;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };
  static constexpr int kStates = 6;
  using Filter = UnscentedKalmanFilter<kStates>;

  /// `options` are valid.
  explicit StepPositionFilter(const Options& options);

  /// Begins anew. The covariance is valid.
  void start(const PlanarEstimate& place);
  bool started() const { return filter_.has_value(); }

  /// False, and nothing changes: not sound, before the last event, or nothing started.
  bool add(const observation::MotionDelta& motion);
  /// A position from outside; begins where nothing has. nullopt, and nothing changes: not finite,
  /// covariance not valid, delivered before the last event or before it was measured.
  std::optional<UnscentedUpdate> add(const PlanarMeasurement& measurement);
  /// The same for a position whose error does not share the persistent part of the radio's.
  std::optional<UnscentedUpdate> add_unbiased(const PlanarMeasurement& measurement);

  /// Carried to `time` (not before the last event). Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  core::DeviceTime time() const { return time_; }
  double heading_offset_rad() const;
  double heading_offset_sigma_rad() const;
  double step_scale() const;
  double log_scale_sigma() const;
  const Filter& filter() const { return *filter_; }

 private:
  std::optional<UnscentedUpdate> update(const PlanarMeasurement& measurement, bool biased);
  void let_time_pass(core::DeviceTime time);

  Options options_;
  core::DeviceTime time_;
  std::optional<Filter> filter_;
  PathMemory path_;
};

}  // namespace waylode::fusion
