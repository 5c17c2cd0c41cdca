// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/heading_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using core::kPi;
using core::Quaternion;
using core::Vector3;

constexpr HeadingFilter::Options kOptions{.initial_sigma_rad = 0.3,
                                          .gyro_noise_rad_per_sqrt_s = 0.01,
                                          .initial_bias_sigma_radps = 0.01,
                                          .bias_walk_radps_per_sqrt_s = 0.0,
                                          .compass_interval_s = 0.5,
                                          .rotation_sigma_rad = 0.8,
                                          .magnetometer_sigma_rad = 1.2};

/// A phone whose top edge points to `heading_rad` when flat, pitched up by `pitch_rad` and then
/// rolled about its long axis.
Quaternion attitude(double heading_rad, double pitch_rad = 0.0, double roll_rad = 0.0) {
  return Quaternion(Eigen::AngleAxisd(heading_rad - kPi / 2.0, Vector3::UnitZ()) *
                    Eigen::AngleAxisd(pitch_rad, Vector3::UnitX()) *
                    Eigen::AngleAxisd(roll_rad, Vector3::UnitY()));
}

sample::RotationSample compass(double time_s, const Quaternion& enu_from_device) {
  return {device_time_from_seconds(time_s), enu_from_device};
}

/// A turn about the vertical as a phone in that attitude senses it.
void turn(HeadingFilter& filter, double time_s, const Quaternion& enu_from_device,
          double rate_radps) {
  const Vector3 up_in_device = enu_from_device.conjugate() * Vector3::UnitZ();
  filter.add(sample::GyroscopeSample{device_time_from_seconds(time_s), rate_radps * up_in_device},
             up_in_device);
}

/// The Earth's field, 20 uT north and 40 uT down, and up, in the device frame.
void feel_field(HeadingFilter& filter, double time_s, const Quaternion& enu_from_device) {
  const Quaternion device_from_enu = enu_from_device.conjugate();
  sample::MagnetometerSample sample;
  sample.time = device_time_from_seconds(time_s);
  sample.field_ut = device_from_enu * Vector3(0.0, 20.0, -40.0);
  filter.add(sample, device_from_enu * Vector3::UnitZ());
}

double away_rad(double a_rad, double b_rad) { return std::abs(core::wrap_angle(a_rad - b_rad)); }

TEST(HeadingFilter, KnowsNothingUntilACompassSpeaks) {
  HeadingFilter filter(kOptions);
  turn(filter, 0.0, attitude(0.0), 1.0);
  turn(filter, 0.1, attitude(0.0), 1.0);
  EXPECT_FALSE(filter.heading_rad());
  filter.add(compass(0.2, attitude(-2.1)));
  ASSERT_TRUE(filter.heading_rad());
  EXPECT_NEAR(*filter.heading_rad(), -2.1, 1e-12);
  EXPECT_NEAR(filter.sigma_rad(), 0.3, 1e-12);
}

TEST(HeadingFilter, IntegratesATurnInAnyPose) {
  for (const auto& [pitch_rad, roll_rad] :
       {std::pair(0.0, 0.0), std::pair(0.7, -0.4), std::pair(1.4, 0.2), std::pair(-0.5, 2.6)}) {
    HeadingFilter filter(kOptions);
    const Quaternion pose = attitude(0.4, pitch_rad, roll_rad);
    filter.add(compass(0.0, pose));
    const double start_rad = *filter.heading_rad();
    for (int i = 0; i <= 200; ++i) turn(filter, 0.01 * i, pose, -0.6);
    EXPECT_LT(away_rad(*filter.heading_rad(), start_rad - 1.2), 1e-9) << pitch_rad;
  }
}

TEST(HeadingFilter, WrapsAtHalfATurn) {
  HeadingFilter filter(kOptions);
  filter.add(compass(0.0, attitude(kPi - 0.05)));
  for (int i = 0; i <= 10; ++i) turn(filter, 0.01 * i, attitude(0.0), 1.0);
  EXPECT_NEAR(*filter.heading_rad(), -kPi + 0.05, 1e-9);
}

TEST(HeadingFilter, CorrectsTheShortWayRound) {
  HeadingFilter filter(kOptions);
  filter.add(compass(0.0, attitude(kPi - 0.05)));
  filter.add(compass(1.0, attitude(-kPi + 0.05)));
  // Kalman gain 0.3^2 / (0.3^2 + 0.8^2) of 0.1 rad.
  EXPECT_LT(away_rad(*filter.heading_rad(), kPi - 0.05 + 0.1 * 0.09 / 0.73), 1e-12);
  EXPECT_NEAR(filter.sigma_rad(), std::sqrt(0.09 * 0.64 / 0.73), 1e-12);
}

TEST(HeadingFilter, AsksTheCompassNoMoreOftenThanItsInterval) {
  HeadingFilter filter(kOptions);
  filter.add(compass(0.0, attitude(0.0)));
  filter.add(compass(0.4, attitude(1.0)));
  EXPECT_NEAR(*filter.heading_rad(), 0.0, 1e-12);
  filter.add(compass(0.5, attitude(1.0)));
  EXPECT_NEAR(*filter.heading_rad(), 0.09 / 0.73, 1e-12);
}

TEST(HeadingFilter, GrowsUnsureAsTheModelSays) {
  HeadingFilter filter(kOptions);
  filter.add(compass(0.0, attitude(0.0)));
  for (int i = 0; i <= 1000; ++i) turn(filter, 0.02 * i, attitude(0.0), 0.0);
  // 20 s: start + (bias * time)^2 + noise * time.
  const double variance = 0.3 * 0.3 + std::pow(0.01 * 20.0, 2) + 0.01 * 0.01 * 20.0;
  EXPECT_NEAR(filter.sigma_rad(), std::sqrt(variance), 1e-9);
}

TEST(HeadingFilter, LearnsTheGyroscopesBias) {
  HeadingFilter::Options options = kOptions;
  options.bias_walk_radps_per_sqrt_s = 1e-4;
  options.rotation_sigma_rad = 0.1;
  HeadingFilter filter(options);
  const Quaternion pose = attitude(0.9, 0.5, 0.3);
  constexpr double kBias_radps = 0.02;
  double time_s = 0.0;
  for (int i = 0; i < 15'000; ++i, time_s += 0.02) {  // Five minutes of standing.
    turn(filter, time_s, pose, kBias_radps);
    filter.add(compass(time_s, pose));
  }
  const double before_rad = *filter.heading_rad();
  EXPECT_LT(away_rad(before_rad, 0.9), 0.01);
  for (int i = 0; i < 1'000; ++i, time_s += 0.02) turn(filter, time_s, pose, kBias_radps);
  // Unlearnt, the bias would turn it by 0.4 rad in these 20 s.
  EXPECT_LT(away_rad(*filter.heading_rad(), before_rad), 0.04);
}

TEST(HeadingFilter, DoesNotBridgeAGapOfTheGyroscope) {
  HeadingFilter filter(kOptions);
  filter.add(compass(0.0, attitude(0.3)));
  turn(filter, 0.0, attitude(0.3), 1.0);
  turn(filter, 1.0, attitude(0.3), 1.0);
  EXPECT_NEAR(*filter.heading_rad(), 0.3, 1e-12);
  turn(filter, 1.1, attitude(0.3), 1.0);
  EXPECT_NEAR(*filter.heading_rad(), 0.4, 1e-9);
}

TEST(HeadingFilter, LevelsTheMagneticFieldInAnyPose) {
  for (const double heading_rad : {-2.8, -1.0, 0.2, 1.9}) {
    for (const double pitch_rad : {-0.9, 0.0, 0.6, 1.5}) {
      HeadingFilter filter(kOptions);
      feel_field(filter, 0.0, attitude(heading_rad, pitch_rad));
      ASSERT_TRUE(filter.heading_rad());
      EXPECT_LT(away_rad(*filter.heading_rad(), heading_rad), 1e-9) << pitch_rad;
    }
    HeadingFilter rolled(kOptions);
    feel_field(rolled, 0.0, attitude(heading_rad, 0.4, -0.8));
    EXPECT_LT(away_rad(*rolled.heading_rad(), heading_rad), 1e-9);
  }
}

TEST(HeadingFilter, PassesOverAFieldWithoutHorizontalPart) {
  HeadingFilter filter(kOptions);
  filter.add(sample::MagnetometerSample{device_time_from_seconds(0.0), Vector3(0.0, 4.0, -60.0), 3},
             Vector3::UnitZ());
  EXPECT_FALSE(filter.heading_rad());
}

TEST(HeadingFilter, PrefersTheRotationVectorToTheField) {
  HeadingFilter filter(kOptions);
  filter.add(compass(0.0, attitude(1.0)));
  feel_field(filter, 1.0, attitude(2.0));
  EXPECT_NEAR(*filter.heading_rad(), 1.0, 1e-12);
}

TEST(HeadingOfAttitude, FollowsTheBackOfAnUprightPhone) {
  EXPECT_LT(away_rad(heading_of_attitude(attitude(0.7, kPi / 2.0)), 0.7), 1e-9);
  EXPECT_LT(away_rad(heading_of_attitude(attitude(0.7, 1.0)), 0.7), 1e-9);
}

RC_GTEST_PROP(HeadingFilter, StaysFiniteAndUnsure, ()) {
  HeadingFilter filter(kOptions);
  double time_s = 0.0;
  const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(0, 3), rc::gen::inRange(-400, 400)));
  for (const auto& [kind, value] : steps) {
    time_s += 0.01 * std::abs(value % 70);
    const Quaternion pose = attitude(0.02 * value, 0.01 * value, 0.005 * value);
    if (kind == 0) turn(filter, time_s, pose, 0.02 * value);
    if (kind == 1) filter.add(compass(time_s, pose));
    if (kind == 2) feel_field(filter, time_s, pose);
    if (!filter.heading_rad()) continue;
    RC_ASSERT(std::abs(*filter.heading_rad()) <= kPi);
    RC_ASSERT(filter.sigma_rad() > 0.0 && std::isfinite(filter.sigma_rad()));
  }
}

TEST(HeadingFilter, RefusesOptionsOutOfRange) {
  using Options = HeadingFilter::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.initial_sigma_rad = value}.validate());
    EXPECT_FALSE(Options{.gyro_noise_rad_per_sqrt_s = value}.validate());
    EXPECT_FALSE(Options{.initial_bias_sigma_radps = value}.validate());
    EXPECT_FALSE(Options{.bias_walk_radps_per_sqrt_s = value}.validate());
    EXPECT_FALSE(Options{.compass_interval_s = value}.validate());
    EXPECT_FALSE(Options{.rotation_sigma_rad = value}.validate());
    EXPECT_FALSE(Options{.magnetometer_sigma_rad = value}.validate());
  }
}

}  // namespace
}  // namespace waylode::pdr
