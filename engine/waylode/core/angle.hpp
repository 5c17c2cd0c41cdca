// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <optional>
#include <span>

namespace waylode::core {

inline constexpr double kPi = std::numbers::pi;

/// The same direction in (-pi, pi]. Exact for input already in range.
double wrap_angle(double angle_rad);

constexpr double radians_from_degrees(double angle_deg) { return angle_deg * (kPi / 180.0); }
constexpr double degrees_from_radians(double angle_rad) { return angle_rad * (180.0 / kPi); }

/// Heading (counter-clockwise from east) of a compass azimuth (clockwise from north).
double heading_from_azimuth(double azimuth_rad);
/// The inverse, in [0, 2 pi).
double azimuth_from_heading(double heading_rad);

struct CircularMean {
  double mean_rad = 0.0;         ///< In (-pi, pi].
  double resultant_ratio = 0.0;  ///< Mean resultant length: 1 all agree, 0 no direction at all.
};

/// Weighted circular mean; nullopt when there is nothing to average or the directions cancel.
/// `weights` is empty (all one) or as long as `angles_rad`.
std::optional<CircularMean> circular_mean(std::span<const double> angles_rad,
                                          std::span<const double> weights = {});

}  // namespace waylode::core
