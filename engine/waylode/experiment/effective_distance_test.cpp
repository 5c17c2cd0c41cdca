// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/effective_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace waylode::experiment {
namespace {

using core::device_time_from_seconds;

constexpr double kStandardGravity_mps2 = 9.80665;
constexpr double kCadence_hz = 1.8;

/// A level phone, its long axis north, at 100 Hz: a bounce per step, and `forward_mps2(time_s)`.
template <typename Forward>
std::vector<sample::Sample> level_phone(double seconds, double bounce_mps2,
                                        const Forward& forward_mps2) {
  std::vector<sample::Sample> samples;
  for (int i = 0; i < static_cast<int>(100.0 * seconds); ++i) {
    const double time_s = 0.01 * i;
    const core::DeviceTime time = device_time_from_seconds(time_s);
    const double bounce = bounce_mps2 * std::sin(2.0 * std::numbers::pi * kCadence_hz * time_s);
    samples.emplace_back(sample::AccelerometerSample{
        time, {0.0, forward_mps2(time_s), kStandardGravity_mps2 + bounce}});
    samples.emplace_back(sample::GyroscopeSample{time, core::Vector3::Zero()});
    samples.emplace_back(sample::MagnetometerSample{time, {0.0, 20.0, -44.0}, 3});
  }
  return samples;
}

std::vector<sample::Sample> bouncing(double seconds) {
  return level_phone(seconds, 3.0, [](double) { return 0.0; });
}

observation::MotionDelta step_of(double length_m) {
  observation::MotionDelta step;
  step.length_m = length_m;
  return step;
}

TEST(WalkedM, SumsTheSteps) {
  EXPECT_EQ(walked_m({}), 0.0);
  EXPECT_DOUBLE_EQ(walked_m(std::vector{step_of(0.7), step_of(0.0), step_of(0.55)}), 1.25);
}

TEST(CalibratePerson, MakesTheDetectedStepsAsLongAsTheWalk) {
  const auto walk = bouncing(20.0);  // 36 bounces.
  for (const double length_m : {18.0, 31.5}) {
    const auto setting = calibrate_person(walk, 36, length_m, 1.62);
    ASSERT_TRUE(setting) << setting.error().message;
    EXPECT_TRUE(setting->options.validate());
    EXPECT_EQ(setting->options.stride.height_m, 1.62);
    const auto steps = walked_steps(walk, setting->options);
    EXPECT_NEAR(static_cast<double>(steps.size()), 36.0, 2.0);
    EXPECT_NEAR(walked_m(steps), length_m, 1e-6 * length_m);
  }
}

TEST(CalibratePerson, CarriesOverToAnotherWalkOfTheSamePerson) {
  const auto setting = calibrate_person(bouncing(20.0), 36, 25.2, 1.75);
  ASSERT_TRUE(setting);
  // Twice the time at the same cadence: twice as far but for the steps lost at start and stop.
  EXPECT_NEAR(walked_m(walked_steps(bouncing(40.0), setting->options)), 50.4, 0.05 * 50.4);
}

TEST(CalibratePerson, RefusesAWalkWithoutSteps) {
  const auto still = level_phone(20.0, 0.0, [](double) { return 0.0; });
  EXPECT_FALSE(calibrate_person(still, 36, 25.0, 1.7));
  EXPECT_FALSE(calibrate_person({}, 36, 25.0, 1.7));
  EXPECT_FALSE(calibrate_person(bouncing(20.0), 0, 25.0, 1.7));
}

TEST(WalkedSteps, AreNoneOfAPhoneAtRest) {
  const auto setting = calibrate_person(bouncing(20.0), 36, 25.2, 1.75);
  ASSERT_TRUE(setting);
  const auto still = level_phone(20.0, 0.0, [](double) { return 0.0; });
  EXPECT_TRUE(walked_steps(still, setting->options).empty());
  EXPECT_TRUE(walked_steps({}, setting->options).empty());
}

TEST(IntegratedM, IsNothingWithoutMotion) {
  EXPECT_EQ(integrated_m({}), 0.0);
  EXPECT_NEAR(integrated_m(bouncing(10.0)), 0.0, 1e-9);
}

TEST(IntegratedM, IntegratesForwardAccelerationTwice) {
  // One swing of a second, which levelling is too slow to follow: a sin(wt) gives the speed
  // (a/w)(1 - cos wt), whose mean is a/w.
  constexpr double kOmega_radps = 2.0 * std::numbers::pi;
  const auto walk =
      level_phone(1.0, 0.0, [](double time_s) { return 1.5 * std::sin(kOmega_radps * time_s); });
  EXPECT_NEAR(integrated_m(walk), 1.5 / kOmega_radps, 0.1 * 1.5 / kOmega_radps);
}

TEST(IntegratedM, TakesAConstantForErrorOfTheSensor) {
  // Standing still with a sensor that is 0.2 m/s2 off: without its mean nothing is left but what
  // levelling does meanwhile.
  const auto biased = level_phone(60.0, 0.0, [](double) { return 0.2; });
  EXPECT_LT(integrated_m(biased), 1.0);  // 360 m with it.
}

}  // namespace
}  // namespace waylode::experiment
