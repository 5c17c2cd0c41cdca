// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/fusion/constant_velocity_filter.hpp"
#include "waylode/fusion/interval_weighting.hpp"
#include "waylode/fusion/path_memory.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/fusion/step_position_filter.hpp"
#include "waylode/fusion/velocity_blend.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// Wi-Fi, magnetic field and steps in one plane [Zhou2016] 2: begin by Wi-Fi, walk by steps,
/// correct by the weighted Wi-Fi and magnetic point, filter. With `robust_filter` one filter takes
/// the three as they are instead: the errors of blends and of smoothed points are not white. Beside
/// either runs a filter of Wi-Fi and steps alone, which a magnetic position must not contradict: a
/// matcher that has slipped to another place fits well there, too. Causal.
///
/// Steps come in the order of their ends, positions in the order of their delivery.
class ZhouTracker {
 public:
  struct Options {
    int start_scans = 6;          ///< Wi-Fi positions that the start averages; 1 to 1000.
    double start_within_s = 4.0;  ///< From the first of them; >= 0.
    bool robust_filter = false;

    double magnetic_sigma_scale = 1.0;    ///< > 0; successive matches share most of their window.
    double magnetic_floor_sigma_m = 0.3;  ///< What a magnetic sigma does not know of; >= 0.
    /// Chi-square distance from Wi-Fi and steps beyond which a magnetic position is left; > 0.
    double magnetic_gate = 9.21;

    // Blends and a filter behind them, as published.
    IntervalWeighting::Options weighting;
    VelocityBlend::Options blend;
    double correction_ratio = 0.25;  ///< Way towards the weighted point that each moves; (0, 1].
    double fused_velocity_s = 2.0;  ///< Span of weighted points that a velocity is taken over; > 0.
    bool filter_blend = true;       ///< The constant-velocity filter.
    ConstantVelocityFilter::Options velocity_filter;

    /// The robust filter, and the one of Wi-Fi and steps.
    StepPositionFilter::Options filter = filter_defaults();

    static StepPositionFilter::Options filter_defaults();
    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit ZhouTracker(const Options& options);

  /// Begins anew at a known place. Finite, the covariance valid.
  void start(const PlanarEstimate& place);
  bool started() const { return main_.started(); }
  /// Each returns false, and changes nothing, for what is not sound or not in order, and for steps
  /// and magnetic positions before the start. False also for a magnetic position that contradicts
  /// Wi-Fi and steps.
  bool add(const observation::MotionDelta& motion);
  /// A scan dated in the past is carried forward by the steps since. Begins where nothing has.
  bool add_radio(const PlanarMeasurement& measurement);
  bool add_magnetic(const PlanarEstimate& place);

  /// Carried to `time`. Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  /// The last weighted Wi-Fi and magnetic point, before it corrected anything.
  const std::optional<PlanarEstimate>& weighted_point() const { return weighted_point_; }

 private:
  void begin(const PlanarEstimate& place);
  bool begins_with(const PlanarMeasurement& measurement);
  bool contradicts_wifi(const PlanarMeasurement& magnetic) const;
  void blend_step(const observation::MotionDelta& motion);
  void correct_blend(core::DeviceTime time);
  PolarVelocity fused_velocity() const;

  Options options_;
  StepPositionFilter main_;       ///< Of everything.
  StepPositionFilter reference_;  ///< Of Wi-Fi and steps.
  PathMemory path_;
  core::DeviceTime started_at_;
  core::DeviceTime last_radio_;
  core::DeviceTime last_magnetic_;
  PlanarEstimate start_mean_;  ///< Of the first scans, walked on.
  int start_count_ = 0;
  // Of the blends.
  PlanarEstimate blended_;
  PolarVelocity velocity_;
  std::optional<PlanarEstimate> wifi_;      ///< The newest, walked on.
  std::optional<PlanarEstimate> magnetic_;  ///< The newest, walked on.
  std::optional<PlanarEstimate> weighted_point_;
  std::deque<PlanarEstimate> weighted_points_;
  ConstantVelocityFilter velocity_filter_;
};

}  // namespace waylode::fusion
