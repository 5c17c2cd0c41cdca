// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/geometry.hpp"

namespace waylode::pdr {

/// The magnetic field as a phone held level, or upright, would see it.
struct LevelledField {
  double right_ut = 0.0;    ///< [Wu2019] m_x.
  double forward_ut = 0.0;  ///< [Wu2019] m_y: along the long axis, or the back of an upright phone.
  double up_ut = 0.0;

  double horizontal_ut() const;
  double dip_rad() const;  ///< Of the field below the horizontal; positive in the north.

  bool operator==(const LevelledField&) const = default;
};

/// Takes the tilt out. `up_in_device` is a unit vector.
LevelledField level(const core::Vector3& field_ut, const core::Vector3& up_in_device);

/// Compass azimuth, clockwise from magnetic north, of what is forward; in (-pi, pi]. nullopt where
/// the horizontal field is too weak, or no number, to name one.
std::optional<double> magnetic_azimuth_rad(const LevelledField& field);

/// Azimuth from true north. `declination_rad` is positive where magnetic north lies east of true
/// north, so it is always added.
double true_azimuth_rad(double magnetic_azimuth_rad, double declination_rad);

}  // namespace waylode::pdr
