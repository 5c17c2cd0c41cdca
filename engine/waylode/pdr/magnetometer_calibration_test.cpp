// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/magnetometer_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::pdr {
namespace {

using core::Vector3;
using Eigen::Matrix3d;

Vector3 any_direction(core::Rng& rng) {
  return Vector3(rng.normal(), rng.normal(), rng.normal()).normalized();
}

/// Symmetric, determinant one: what the phone's iron is undone by.
Matrix3d soft_iron() {
  Matrix3d matrix;
  matrix << 1.10, 0.06, -0.03, 0.06, 0.93, 0.04, -0.03, 0.04, 1.01;
  return matrix / std::cbrt(matrix.determinant());
}
const Vector3 kHardIron_ut(24.0, -41.0, 13.0);
constexpr double kField_ut = 48.5;

std::vector<Vector3> readings(std::size_t count, double noise_ut, core::Rng& rng) {
  const Matrix3d distortion = soft_iron().inverse();
  std::vector<Vector3> raw_ut;
  for (std::size_t i = 0; i < count; ++i) {
    raw_ut.push_back(distortion * (kField_ut * any_direction(rng)) + kHardIron_ut +
                     noise_ut * Vector3(rng.normal(), rng.normal(), rng.normal()));
  }
  return raw_ut;
}

TEST(MagnetometerCalibration, UndoesHardAndSoftIron) {
  core::Rng rng(1);
  const auto calibration = calibrate_magnetometer(readings(200, 0.0, rng));
  ASSERT_TRUE(calibration);
  EXPECT_NEAR((calibration->hard_iron_ut - kHardIron_ut).norm(), 0.0, 1e-6);
  EXPECT_NEAR((calibration->soft_iron - soft_iron()).norm(), 0.0, 1e-6);
  EXPECT_NEAR(calibration->field_ut, kField_ut, 1e-6);
  EXPECT_NEAR(calibration->residual_ut, 0.0, 1e-6);
}

TEST(MagnetometerCalibration, BearsTheNoiseOfAPhone) {
  core::Rng rng(2);
  const auto calibration = calibrate_magnetometer(readings(1000, 0.5, rng));
  ASSERT_TRUE(calibration);
  EXPECT_NEAR((calibration->hard_iron_ut - kHardIron_ut).norm(), 0.0, 0.3);
  EXPECT_NEAR((calibration->soft_iron - soft_iron()).norm(), 0.0, 0.01);
  // The radial part of the noise remains.
  EXPECT_NEAR(calibration->residual_ut, 0.5, 0.05);
}

TEST(MagnetometerCalibration, LeavesACleanPhoneAlone) {
  core::Rng rng(3);
  std::vector<Vector3> raw_ut;
  for (int i = 0; i < 100; ++i) raw_ut.push_back(50.0 * any_direction(rng));
  const auto calibration = calibrate_magnetometer(raw_ut);
  ASSERT_TRUE(calibration);
  EXPECT_NEAR(calibration->hard_iron_ut.norm(), 0.0, 1e-6);
  EXPECT_NEAR((calibration->soft_iron - Matrix3d::Identity()).norm(), 0.0, 1e-8);
}

TEST(MagnetometerCalibration, RefusesAPhoneTurnedInOnePlane) {
  core::Rng rng(4);
  std::vector<Vector3> raw_ut;
  for (int i = 0; i < 300; ++i) {
    const double angle = 0.05 * i;
    raw_ut.push_back(Vector3(30.0 * std::cos(angle), 30.0 * std::sin(angle), -40.0) +
                     0.3 * Vector3(rng.normal(), rng.normal(), rng.normal()));
  }
  EXPECT_FALSE(calibrate_magnetometer(raw_ut));
}

TEST(MagnetometerCalibration, RefusesAHalfTurnedPhone) {
  core::Rng rng(5);
  std::vector<Vector3> raw_ut;
  for (const Vector3& each : readings(2000, 0.3, rng)) {
    const Vector3 away = each - kHardIron_ut;
    if (away.x() > 5.0 && away.y() > 5.0) raw_ut.push_back(each);
  }
  ASSERT_GT(raw_ut.size(), 200U);
  EXPECT_FALSE(calibrate_magnetometer(raw_ut));
}

TEST(MagnetometerCalibration, RefusesADisturbedPlace) {
  core::Rng rng(6);
  EXPECT_FALSE(calibrate_magnetometer(readings(500, 12.0, rng)));
}

TEST(MagnetometerCalibration, RefusesWhatIsTooFewConstantOrNoNumber) {
  core::Rng rng(7);
  EXPECT_FALSE(calibrate_magnetometer({}));
  EXPECT_FALSE(calibrate_magnetometer(readings(9, 0.0, rng)));
  EXPECT_FALSE(calibrate_magnetometer(std::vector<Vector3>(100, Vector3(10.0, 20.0, -30.0))));
  std::vector<Vector3> raw_ut = readings(100, 0.1, rng);
  raw_ut[40].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(calibrate_magnetometer(raw_ut));
  EXPECT_FALSE(calibrate_magnetometer(readings(100, 0.1, rng), {.min_sample_count = 5}));
}

}  // namespace
}  // namespace waylode::pdr
