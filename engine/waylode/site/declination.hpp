// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"

namespace waylode::site {

/// The earth's magnetic field in one place, on the ellipsoid.
struct EarthField {
  double declination_rad = 0.0;  ///< Of magnetic north from true north, positive to the east.
  double dip_rad = 0.0;          ///< Below the horizontal.
  double strength_ut = 0.0;

  bool operator==(const EarthField&) const = default;
};

/// After the World Magnetic Model 2025 [WMM2025]. `year` with its fraction, in [2025, 2030], the
/// span for which the model was made. Its declination errs by half a degree or so, more near the
/// magnetic poles and over ore. Fails on a place or a year that is out of range.
core::Result<EarthField> earth_field(const core::GeoPoint& place, double year);

/// The declination alone, in radians, positive to the east: what to add to a compass azimuth.
core::Result<double> magnetic_declination_rad(const core::GeoPoint& place, double year);

}  // namespace waylode::site
