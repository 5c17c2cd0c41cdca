// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
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
///
/// Steps come in the order of their ends, positions in the order of their delivery; a step may be
/// told after a position that was delivered before it was complete.
class StepPositionFilter {
 public:
  struct Options {
    SigmaSpread spread;
    double heading_offset_sigma_rad = 0.09;  ///< At the start; >= 0. Of a phone held ahead.
    double log_scale_sigma = 0.06;           ///< At the start; >= 0. Of strides over people.
    double heading_offset_walk_rad_per_sqrt_step = 0.007;  ///< >= 0.
    double log_scale_walk_per_sqrt_step = 0.0;             ///< >= 0.
    double position_walk_m_per_sqrt_s = 0.1;               ///< Movement that no step tells; > 0.
    double radio_bias_sigma_m = 0.5;   ///< Per axis; >= 0, where 0: every scan errs anew.
    double radio_bias_tau_s = 10.0;    ///< How long a radio error persists; > 0.
    double radio_sigma_scale = 1.5;    ///< On the measurement's own sigma; > 0.
    double radio_floor_sigma_m = 1.0;  ///< What that sigma does not know of; >= 0.
    /// Chi-square (two degrees of freedom) up to which a position is taken as it is; > 0, infinite
    /// for no doubt.
    double gate = 3.0;
    /// Lost: this many (0: never) of the newest `lost_window` radio positions lie beyond
    /// `lost_gate`. The filter then begins anew at the last of them, the heading free.
    int lost_failures = 4;
    int lost_window = 6;                  ///< >= lost_failures, at most 100.
    double lost_gate = 13.8;              ///< Chi-square, two degrees of freedom; > 0.
    double lost_heading_sigma_rad = 0.8;  ///< > 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };
  static constexpr int kStates = 6;
  using Filter = UnscentedKalmanFilter<kStates>;

  /// `options` are valid.
  explicit StepPositionFilter(const Options& options);

  /// Begins anew: steps that ended before are forgotten. Finite, the covariance valid.
  void start(const PlanarEstimate& place);
  /// Corrects the place at the end of the last step, keeping what is known of the heading offset
  /// and the step scale.
  void move_to(const PlanarEstimate& place);
  bool started() const { return filter_.has_value(); }

  /// False, and nothing changes: not sound, ended before the last step did, or nothing started.
  bool add(const observation::MotionDelta& motion);
  /// A position from outside; begins where nothing has. nullopt, and nothing changes: not finite,
  /// covariance not valid, delivered before the last one or before it was measured.
  std::optional<UnscentedUpdate> add(const PlanarMeasurement& measurement);
  /// The same for a position that is taken at its own sigma and shares no persistent error with
  /// the radio positions.
  std::optional<UnscentedUpdate> add_unbiased(const PlanarMeasurement& measurement);
  /// How far a position (as add() takes it) is from what is expected: chi-square with two degrees
  /// of freedom, and how wide the expectation was. Something has started.
  struct Surprise {
    double chi_square = 0.0;
    double log_determinant = 0.0;  ///< Of the innovation's covariance in m2.
  };
  Surprise surprise(const PlanarMeasurement& measurement) const;

  /// Where the walker is at `time`, seen from the end of the last step, as PathMemory tells it but
  /// with heading and scale corrected.
  core::Vector2 walked_offset_m(core::DeviceTime time) const;
  /// How often it was lost.
  int losses() const { return losses_; }

  /// Carried to `time`; a walker in mid-step is moved on. Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  core::DeviceTime time() const { return time_; }
  double heading_offset_rad() const;
  double heading_offset_sigma_rad() const;
  double step_scale() const;
  double log_scale_sigma() const;
  /// Something has started.
  const Filter& filter() const { return *filter_; }

 private:
  std::optional<UnscentedUpdate> update(const PlanarMeasurement& measurement, bool biased);
  void begin(const PlanarEstimate& place, double heading_sigma_rad);
  bool is_lost(double chi_square);
  core::Matrix2 noise_m2(const PlanarMeasurement& measurement) const;

  Options options_;
  core::DeviceTime time_;  ///< Of the newest event.
  core::DeviceTime last_delivery_;
  std::optional<Filter> filter_;
  PathMemory path_;
  std::deque<bool> doubts_;
  int losses_ = 0;
};

}  // namespace waylode::fusion
