// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"
#include "waylode/observation/likelihood_raster.hpp"

/// What the estimators tell fusion. Plain values; fusion sees nothing else.
namespace waylode::observation {

/// What the length of a step follows from, kept so that the length law can be corrected on line.
struct StrideFeatures {
  double swing_root = 0.0;         ///< (Largest less smallest acceleration)^(1/4), (m/s2)^(1/4).
  double mean_abs_time_mps = 0.0;  ///< Mean |linear acceleration| times duration.

  bool operator==(const StrideFeatures&) const = default;
};

/// One step (or a stretch of standing, length 0). Headings are counter-clockwise from true east as
/// far as the phone knows: a constant offset (how it is held, declination, plan rotation) remains.
struct MotionDelta {
  core::DeviceTime begin;
  core::DeviceTime end;
  double length_m = 0.0;
  double heading_rad = 0.0;
  double length_sigma_m = 0.0;     ///< Random part only; a constant scale error remains.
  double heading_sigma_rad = 0.0;  ///< Random part only, drift since the previous delta included.
  StrideFeatures stride{};         ///< Zero where no step was measured.
  /// The magnetic field over the step, levelled: size of the horizontal part, vertical part (up
  /// positive). It does not depend on where the phone faces. nullopt: not felt.
  std::optional<core::Vector2> level_field_ut{};

  bool operator==(const MotionDelta&) const = default;
};

/// A surveyed place that resembles what was heard.
struct RadioCandidate {
  core::Vector2 position_m = core::Vector2::Zero();  ///< Floor frame.
  double weight = 0.0;                               ///< Sums to one within a floor.

  bool operator==(const RadioCandidate&) const = default;
};

/// What one radio scan says, if the person is on this floor.
struct FloorHypothesis {
  core::FloorId floor;
  double log_likelihood = 0.0;  ///< Of the floor, up to a constant common to all floors.
  core::Vector2 position_m = core::Vector2::Zero();         ///< Floor frame.
  core::Matrix2 covariance_m2 = core::Matrix2::Identity();  ///< Floor frame; error of position_m.
  std::vector<RadioCandidate> candidates;
  /// For trackers that weigh places one by one; null where the matcher does not make it.
  std::shared_ptr<const LikelihoodRaster> raster{};

  bool operator==(const FloorHypothesis&) const = default;
};

/// A scan matched against the radio map. Hypotheses by falling log_likelihood; never empty.
struct RadioObservation {
  core::DeviceTime measured;  ///< When the signals were in the air, not when they were delivered.
  core::DeviceTime delivered;
  double known_share_ratio = 0.0;  ///< Share of the signal that the radio map knows, 0 to 1.
  std::vector<FloorHypothesis> floors;

  bool operator==(const RadioObservation&) const = default;
};

/// A climb or descent, by stairs, a lift or an escalator, told by the air pressure as far as it has
/// gone. Reports of one climb have the same `begin`; each replaces the one before.
struct VerticalMotion {
  core::DeviceTime begin;
  core::DeviceTime end;
  double climb_m = 0.0;  ///< Upwards positive.
  double sigma_m = 0.5;  ///< Of the climb: noise, and the weather's drift meanwhile.

  bool operator==(const VerticalMotion&) const = default;
};

/// Where the magnetic field of the last seconds fits the magnetic map best.
struct MagneticObservation {
  core::DeviceTime time;  ///< Of the newest field that was matched.
  core::FloorId floor;
  core::Vector2 position_m = core::Vector2::Zero();         ///< Floor frame, at `time`.
  core::Matrix2 covariance_m2 = core::Matrix2::Identity();  ///< Floor frame; error of position_m.
  double mean_square_difference_ut2 = 0.0;                  ///< Of the best fit.

  bool operator==(const MagneticObservation&) const = default;
};

}  // namespace waylode::observation
