// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/magnetic_heading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

using core::kPi;
using core::Quaternion;
using core::radians_from_degrees;
using core::Vector3;

constexpr double kHorizontal_ut = 31.0;
constexpr double kDown_ut = 38.0;

/// The earth's field in a phone whose long axis points at `azimuth_rad`, then pitched and rolled.
struct Seen {
  Vector3 field_ut;
  Vector3 up;
};
Seen seen(double azimuth_rad, double pitch_rad, double roll_rad) {
  const Quaternion enu_from_device(Eigen::AngleAxisd(-azimuth_rad, Vector3::UnitZ()) *
                                   Eigen::AngleAxisd(pitch_rad, Vector3::UnitX()) *
                                   Eigen::AngleAxisd(roll_rad, Vector3::UnitY()));
  const Quaternion device_from_enu = enu_from_device.conjugate();
  return {device_from_enu * Vector3(0.0, kHorizontal_ut, -kDown_ut),
          device_from_enu * Vector3::UnitZ()};
}

TEST(MagneticHeading, IsTheArcTangentOfEquationTen) {
  // Flat, long axis at azimuth psi: m_x = -H sin psi, m_y = H cos psi.
  for (const double degrees : {-170.0, -90.0, -13.0, 0.0, 55.0, 90.0, 179.0}) {
    const double psi = radians_from_degrees(degrees);
    const auto azimuth_rad = magnetic_azimuth_rad(
        {.right_ut = -30.0 * std::sin(psi), .forward_ut = 30.0 * std::cos(psi), .up_ut = -40.0});
    ASSERT_TRUE(azimuth_rad);
    EXPECT_NEAR(*azimuth_rad, psi, 1e-12);
  }
}

TEST(MagneticHeading, DoesNotDependOnTheTilt) {
  for (const double degrees : {-135.0, 20.0, 178.0}) {
    for (const double pitch : {0.0, 0.6, -0.4, 1.0}) {
      for (const double roll : {0.0, 0.5, -0.7}) {
        const Seen now = seen(radians_from_degrees(degrees), pitch, roll);
        const LevelledField field = level(now.field_ut, now.up);
        // Roll about a pitched long axis leaves where that axis points.
        EXPECT_NEAR(core::degrees_from_radians(*magnetic_azimuth_rad(field)), degrees, 1e-9);
        EXPECT_NEAR(field.horizontal_ut(), kHorizontal_ut, 1e-9);
        EXPECT_NEAR(field.up_ut, -kDown_ut, 1e-9);
        EXPECT_NEAR(field.dip_rad(), std::atan2(kDown_ut, kHorizontal_ut), 1e-12);
      }
    }
  }
}

TEST(MagneticHeading, IsThatOfTheBackWhenUpright) {
  const Seen now = seen(radians_from_degrees(70.0), kPi / 2.0, 0.0);
  EXPECT_NEAR(core::degrees_from_radians(*magnetic_azimuth_rad(level(now.field_ut, now.up))), 70.0,
              1e-9);
}

TEST(MagneticHeading, TurnsIntoAHeadingCounterClockwiseFromEast) {
  EXPECT_NEAR(core::heading_from_azimuth(true_azimuth_rad(radians_from_degrees(30.0), 0.0)),
              radians_from_degrees(60.0), 1e-12);
}

TEST(MagneticHeading, AddsADeclinationToTheEast) {
  // Where magnetic north lies 5 degrees west of true north, the compass reads 5 too much.
  EXPECT_NEAR(true_azimuth_rad(radians_from_degrees(92.0), radians_from_degrees(-5.0)),
              radians_from_degrees(87.0), 1e-12);
  EXPECT_NEAR(true_azimuth_rad(radians_from_degrees(178.0), radians_from_degrees(4.0)),
              radians_from_degrees(-178.0), 1e-12);
}

TEST(MagneticHeading, NamesNoneOfAWeakOrSenselessField) {
  EXPECT_FALSE(magnetic_azimuth_rad({.right_ut = 3.0, .forward_ut = -2.0, .up_ut = -50.0}));
  EXPECT_FALSE(magnetic_azimuth_rad({}));
  EXPECT_FALSE(magnetic_azimuth_rad(
      {.right_ut = std::numeric_limits<double>::quiet_NaN(), .forward_ut = 30.0}));
  EXPECT_FALSE(magnetic_azimuth_rad(
      {.right_ut = std::numeric_limits<double>::infinity(), .forward_ut = 30.0}));
}

TEST(MagneticHeading, NeedsNoOtherArcTangentThanTheLibrarys) {
  // [Wu2019] eq. (11): 2 arctan(y / (hypot(x, y) + x)), pi where y is 0 and x negative.
  for (int i = -179; i <= 180; ++i) {
    const double angle = radians_from_degrees(i);
    const double x = 2.5 * std::cos(angle);
    const double y = i == 180 ? 0.0 : 2.5 * std::sin(angle);
    const double printed = y == 0.0 && x < 0.0 ? kPi : 2.0 * std::atan(y / (std::hypot(x, y) + x));
    EXPECT_NEAR(std::atan2(y, x), printed, 1e-12) << i;
  }
}

}  // namespace
}  // namespace waylode::pdr
