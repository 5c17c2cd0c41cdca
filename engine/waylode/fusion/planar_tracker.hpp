// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// What the tracker estimates, all in one vector (site frame):
///   0, 1  position, m
///   2     heading offset: walking direction less PDR heading, rad
///   3     log of the step scale
///   4, 5  radio bias: the part of the radio error that persists from scan to scan, m
using PlanarVector = Eigen::Matrix<double, 6, 1>;
using PlanarMatrix = Eigen::Matrix<double, 6, 6>;

struct PlanarState {
  core::DeviceTime time;
  PlanarVector mean = PlanarVector::Zero();
  PlanarMatrix covariance = PlanarMatrix::Identity();

  core::Vector2 position_m() const { return mean.head<2>(); }
  core::Matrix2 position_covariance_m2() const { return covariance.topLeftCorner<2, 2>(); }
};

/// One prediction, as the smoother needs it: what was known before, how it moved, what was
/// expected.
struct PlanarTransition {
  PlanarState filtered;
  PlanarMatrix transition = PlanarMatrix::Identity();
  PlanarState predicted;
};

/// A position from outside, with the covariance of its own scan alone (site frame).
struct PlanarMeasurement {
  core::DeviceTime measured;
  core::DeviceTime delivered;
  core::Vector2 position_m = core::Vector2::Zero();
  core::Matrix2 covariance_m2 = core::Matrix2::Identity();
};

/// A measurement as it entered: the smoother weighs it again once the future is known.
struct PlanarRecord {
  PlanarMeasurement measurement;
  core::Vector2 pdr_since_m = core::Vector2::Zero();  ///< PDR path from `measured` to `delivered`.
  std::size_t node = 0;                               ///< Number of transitions before it.
};

/// Weight of a Student-t measurement, given the state's distribution at its node.
double measurement_weight(const PlanarRecord& record, const PlanarVector& mean,
                          const PlanarMatrix& covariance, double radio_sigma_scale,
                          double degrees_of_freedom);

/// A robust extended Kalman filter on one plane: steps move it, radio positions hold it. Radio
/// errors are Student-t (a far-off scan is doubted, not believed) and partly persistent (a scan
/// that repeats the last one's error is not new evidence). Causal; reads no clock.
class PlanarTracker {
 public:
  struct Options {
    double start_sigma_m = 60.0;  ///< Before the first scan, around its position.
    double heading_offset_sigma_rad = 0.35;
    double log_scale_sigma = 0.10;
    double heading_offset_walk_rad_per_sqrt_step = 0.03;
    double log_scale_walk_per_sqrt_step = 0.005;
    double position_walk_m_per_sqrt_s = 0.15;  ///< Movement that no step tells.
    double radio_bias_sigma_m = 5.0;
    double radio_bias_tau_s = 30.0;         ///< How long a radio error persists.
    double radio_sigma_scale = 1.2;         ///< On the scan's own sigma.
    double radio_degrees_of_freedom = 3.0;  ///< Of the Student-t; large is Gaussian.
    double lost_weight_ratio = 0.7;         ///< Scans weighted below this, on average, mean "lost".
    double lost_sigma_m = 20.0;             ///< Doubt added when lost.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// With `keep_history`, every prediction is recorded for a smoother.
  PlanarTracker(const Options& options, bool keep_history);

  /// Begins at a position known to `sigma_m` per axis.
  void start(core::DeviceTime time, const core::Vector2& position_m, double sigma_m);
  bool started() const { return started_; }

  /// A step; `heading_rad` inside is on the site frame up to the heading offset.
  void add(const observation::MotionDelta& motion);
  /// A position. Its weight (1 believed, towards 0 doubted) is found from the residual unless
  /// given. Returns the weight used. Starts the tracker when nothing has.
  double add(const PlanarMeasurement& measurement, std::optional<double> weight = std::nullopt);

  /// The state carried to `time` (not before the last event): a walker in mid-step is moved on.
  PlanarState at(core::DeviceTime time) const;
  const PlanarState& state() const { return state_; }
  const std::deque<PlanarTransition>& history() const { return history_; }
  const std::vector<PlanarRecord>& records() const { return records_; }
  /// Forgets history that ended before `time`; records then no longer name nodes.
  void forget_before(core::DeviceTime time);

 private:
  struct PathPoint {
    core::DeviceTime time;
    core::Vector2 path_m;  ///< Sum of the steps as PDR tells them, unscaled and unturned.
  };

  void let_time_pass(core::DeviceTime time, PlanarMatrix transition, PlanarMatrix noise,
                     const PlanarVector& moved);
  core::Vector2 path_at(core::DeviceTime time) const;
  void watch_for_loss(double weight);

  Options options_;
  bool keep_history_;
  bool started_ = false;
  PlanarState state_;
  std::deque<PlanarTransition> history_;
  std::vector<PlanarRecord> records_;
  std::deque<PathPoint> path_;  ///< The last half minute, for scans that tell of the past.
  std::optional<observation::MotionDelta> last_motion_;
  double mean_weight_ = 1.0;
};

}  // namespace waylode::fusion
