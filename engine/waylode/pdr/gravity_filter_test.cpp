// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/gravity_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using core::Vector3;

constexpr GravityFilter::Options kOptions{.accelerometer_tau_s = 2.0};

sample::AccelerometerSample force(double time_s, const Vector3& direction) {
  return {device_time_from_seconds(time_s), kStandardGravity_mps2 * direction.normalized()};
}

sample::GyroscopeSample rate(double time_s, const Vector3& rate_radps) {
  return {device_time_from_seconds(time_s), rate_radps};
}

double angle_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(GravityFilter, KnowsNothingBeforeTheFirstAccelerometer) {
  GravityFilter filter(kOptions);
  filter.add(rate(0.0, Vector3(1.0, 0.0, 0.0)));
  EXPECT_FALSE(filter.up_in_device());
}

TEST(GravityFilter, StartsWithTheFirstDirectionHeard) {
  GravityFilter filter(kOptions);
  filter.add(force(0.0, Vector3(1.0, 2.0, 2.0)));
  ASSERT_TRUE(filter.up_in_device());
  EXPECT_LT((*filter.up_in_device() - Vector3(1.0, 2.0, 2.0) / 3.0).norm(), 1e-12);
}

TEST(GravityFilter, PassesOverFreeFall) {
  GravityFilter filter(kOptions);
  filter.add(sample::AccelerometerSample{device_time_from_seconds(0.0), Vector3(0.0, 0.4, 0.0)});
  EXPECT_FALSE(filter.up_in_device());
}

TEST(GravityFilter, CarriesUpThroughARotationByTheGyroscopeAlone) {
  GravityFilter filter(kOptions);
  filter.add(force(0.0, Vector3::UnitZ()));
  constexpr double kRate_radps = 1.3;
  constexpr double kInterval_s = 0.01;
  const Vector3 axis = Vector3(2.0, -1.0, 0.5).normalized();
  int samples = 0;
  for (; samples <= 150; ++samples) filter.add(rate(samples * kInterval_s, kRate_radps * axis));
  // The device turns by +angle, so what is fixed in the world turns by -angle in the device.
  const double angle_rad = kRate_radps * kInterval_s * (samples - 1);
  const Vector3 expected = Eigen::AngleAxisd(-angle_rad, axis) * Vector3::UnitZ();
  EXPECT_LT(angle_between(*filter.up_in_device(), expected), 1e-9);
  EXPECT_NEAR(filter.up_in_device()->norm(), 1.0, 1e-12);
}

TEST(GravityFilter, ApproachesTheAccelerometerWithItsTimeConstant) {
  GravityFilter filter(kOptions);
  constexpr double kStart_rad = 0.1;
  constexpr double kInterval_s = 0.02;
  filter.add(force(0.0, Vector3(std::sin(kStart_rad), 0.0, std::cos(kStart_rad))));
  for (int i = 1; i <= 150; ++i) filter.add(force(i * kInterval_s, Vector3::UnitZ()));
  // Small angles: a first-order low pass, e^(-3 s / 2 s) of the start.
  const double left_rad = angle_between(*filter.up_in_device(), Vector3::UnitZ());
  EXPECT_NEAR(left_rad, kStart_rad * std::exp(-1.5), 0.02 * kStart_rad);
}

TEST(GravityFilter, DoesNotBridgeAGapOfTheGyroscope) {
  GravityFilter filter(kOptions);
  filter.add(force(0.0, Vector3::UnitZ()));
  filter.add(rate(0.0, Vector3::UnitX()));
  filter.add(rate(2.0, Vector3::UnitX()));
  EXPECT_LT(angle_between(*filter.up_in_device(), Vector3::UnitZ()), 1e-12);
  filter.add(rate(2.01, Vector3::UnitX()));
  EXPECT_NEAR(angle_between(*filter.up_in_device(), Vector3::UnitZ()), 0.01, 1e-5);
}

TEST(GravityFilter, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(GravityFilter::Options{}.validate());
  for (const double tau_s : {0.0, -1.0, 61.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(GravityFilter::Options{.accelerometer_tau_s = tau_s}.validate());
  }
}

}  // namespace
}  // namespace waylode::pdr
