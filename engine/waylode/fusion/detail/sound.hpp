// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "waylode/core/covariance.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/observation/observation.hpp"

/// What the parts take; the rest is passed over.
namespace waylode::fusion::detail {

/// Finite, of a length and sigmas that are not negative, and not ending before it begins.
inline bool is_sound(const observation::MotionDelta& motion) {
  const auto is_size = [](double value) { return std::isfinite(value) && value >= 0.0; };
  return motion.begin <= motion.end && std::isfinite(motion.heading_rad) &&
         is_size(motion.length_m) && is_size(motion.length_sigma_m) &&
         is_size(motion.heading_sigma_rad);
}

inline bool is_sound(const PlanarEstimate& place) {
  return place.position_m.allFinite() && core::is_valid_covariance(place.covariance_m2);
}

inline bool is_sound(const PlanarMeasurement& measurement) {
  return measurement.measured <= measurement.delivered && measurement.position_m.allFinite() &&
         core::is_valid_covariance(measurement.covariance_m2);
}

}  // namespace waylode::fusion::detail
