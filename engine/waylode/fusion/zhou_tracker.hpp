// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/fusion/constant_velocity_filter.hpp"
#include "waylode/fusion/interval_weighting.hpp"
#include "waylode/fusion/path_memory.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/fusion/velocity_blend.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// Wi-Fi, magnetic field and steps in one plane [Zhou2016] 2: begin by Wi-Fi, walk by steps,
/// correct by the weighted Wi-Fi and magnetic point, filter. With `robust_filter` one filter takes
/// all of them as they are instead. Causal.
class ZhouTracker {
 public:
  struct Options {
    int start_scans = 6;          ///< Wi-Fi positions that the start averages; 1 to 1000.
    double start_within_s = 4.0;  ///< The start waits no longer for them; >= 0.
    bool robust_filter = true;    ///< One filter of raw terms, rather than blends and a filter.
    IntervalWeighting::Options weighting;
    VelocityBlend::Options blend;
    bool filter_blend = true;  ///< The constant-velocity filter behind the blends.
    ConstantVelocityFilter::Options velocity_filter;
    /// Share of the way to the weighted point that one correction moves; (0, 1].
    double correction_ratio = 0.25;

    // Of the robust filter.
    double step_walk_m_per_sqrt_s = 0.25;  ///< Error of walking that the steps do not state; > 0.
    double wifi_sigma_scale = 1.0;         ///< > 0.
    double magnetic_sigma_scale = 2.5;     ///< > 0; successive matches share most of their window.
    double gate = 4.0;                     ///< Chi-square beyond which a term is doubted; > 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` are valid.
  explicit ZhouTracker(const Options& options);

  void start(const PlanarEstimate& place);
  bool started() const { return started_; }
  /// Each returns false, and changes nothing, for what is not sound or lies before the last event.
  /// Steps and magnetic positions before the start are passed over (false).
  bool add(const observation::MotionDelta& motion);
  /// A scan dated in the past is carried forward by the steps since.
  bool add_radio(const PlanarMeasurement& measurement);
  bool add_magnetic(const PlanarEstimate& place);

  /// Carried to `time` (not before the last event). Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  /// The last weighted Wi-Fi and magnetic point, if any.
  const std::optional<PlanarEstimate>& weighted_point() const { return weighted_point_; }

 private:
  Options options_;
  bool started_ = false;
  core::DeviceTime time_;
  core::DeviceTime started_at_;
  PlanarEstimate estimate_;
  PathMemory path_;
  std::vector<PlanarEstimate> start_scans_;
  std::optional<PlanarEstimate> wifi_;      ///< The newest, walked on.
  std::optional<PlanarEstimate> magnetic_;  ///< The newest, walked on.
  std::optional<PlanarEstimate> weighted_point_;
  VelocityBlend blend_;
  ConstantVelocityFilter velocity_filter_;
};

}  // namespace waylode::fusion
