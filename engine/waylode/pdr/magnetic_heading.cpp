// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/magnetic_heading.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {

double LevelledField::horizontal_ut() const { return std::hypot(right_ut, forward_ut); }

double LevelledField::dip_rad() const { return std::atan2(-up_ut, horizontal_ut()); }

LevelledField level(const core::Vector3& field_ut, const core::Vector3& up_in_device) {
  constexpr double kUpright = 0.9;  // As heading_of_attitude has it.
  const core::Vector3 axis = std::abs(up_in_device.y()) <= kUpright
                                 ? core::Vector3(core::Vector3::UnitY())
                                 : core::Vector3(-core::Vector3::UnitZ());
  const core::Vector3 forward = (axis - axis.dot(up_in_device) * up_in_device).normalized();
  return {.right_ut = field_ut.dot(forward.cross(up_in_device)),
          .forward_ut = field_ut.dot(forward),
          .up_ut = field_ut.dot(up_in_device)};
}

std::optional<double> magnetic_azimuth_rad(const LevelledField& field) {
  constexpr double kWeakestHorizontal_ut = 5.0;  // Less, and the direction is the building's.
  const double horizontal_ut = field.horizontal_ut();
  if (!(horizontal_ut >= kWeakestHorizontal_ut) || !std::isfinite(horizontal_ut)) {
    return std::nullopt;
  }
  // [Wu2019] eq. (10), printed with twice the same component. Eq. (11) is std::atan2.
  return core::wrap_angle(std::atan2(-field.right_ut, field.forward_ut));
}

double true_azimuth_rad(double magnetic_azimuth_rad, double declination_rad) {
  // [Wu2019] eq. (12), whose minus sign counts the declination positive to the west.
  return core::wrap_angle(magnetic_azimuth_rad + declination_rad);
}

}  // namespace waylode::pdr
