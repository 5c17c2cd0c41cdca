// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using core::kPi;
using core::Quaternion;
using core::Vector3;
using observation::MotionDelta;

constexpr double kCadence_hz = 1.8;

DeadReckoning::Options options() {
  DeadReckoning::Options options;
  options.gravity = {.accelerometer_tau_s = 2.0};
  options.heading = {.initial_sigma_rad = 0.3,
                     .gyro_noise_rad_per_sqrt_s = 0.01,
                     .initial_bias_sigma_radps = 0.01,
                     .bias_walk_radps_per_sqrt_s = 0.0003,
                     .compass_interval_s = 0.5,
                     .rotation_sigma_rad = 0.8,
                     .magnetometer_sigma_rad = 1.2};
  options.step = {.low_pass_hz = 3.0,
                  .min_peak_mps2 = 0.55,
                  .relative_peak_ratio = 0.4,
                  .shortest_interval_s = 0.28,
                  .longest_interval_s = 1.2};
  options.stride = {.constant_m = 0.65,
                    .swing_gain = 0.0,
                    .cadence_gain_m_s = 0.0,
                    .shortest_m = 0.25,
                    .longest_m = 1.2};
  options.step_heading_sigma_rad = 0.08;
  options.step_length_sigma_ratio = 0.1;
  return options;
}

/// A person who turns at a steady rate, walking or standing, with the phone held in some pose.
struct Person {
  double heading_rad = 0.0;
  double turn_rate_radps = 0.0;
  double bounce_mps2 = 2.5;
  Quaternion body_from_device = Quaternion::Identity();  ///< Body: x forward, y left, z up.
  bool compass = true;
};

std::vector<MotionDelta> reckon(const Person& person, double duration_s,
                                const DeadReckoning::Options& with = options()) {
  DeadReckoning reckoning(with);
  std::vector<MotionDelta> deltas;
  for (int i = 0; i < static_cast<int>(50.0 * duration_s); ++i) {
    const double time_s = 0.02 * i;
    const auto time = device_time_from_seconds(time_s);
    const Quaternion enu_from_body(
        Eigen::AngleAxisd(person.heading_rad + person.turn_rate_radps * time_s, Vector3::UnitZ()));
    const Quaternion enu_from_device = enu_from_body * person.body_from_device;
    const Quaternion device_from_enu = enu_from_device.conjugate();
    const double vertical_mps2 =
        kStandardGravity_mps2 + person.bounce_mps2 * std::sin(2.0 * kPi * kCadence_hz * time_s);
    if (person.compass) reckoning.add(sample::RotationSample{time, enu_from_device});
    reckoning.add(
        sample::GyroscopeSample{time, device_from_enu * Vector3(0.0, 0.0, person.turn_rate_radps)});
    const auto delta = reckoning.add(
        sample::AccelerometerSample{time, device_from_enu * Vector3(0.0, 0.0, vertical_mps2)});
    if (delta) deltas.push_back(*delta);
  }
  return deltas;
}

/// The top edge of the phone points forward; pitched up and rolled.
Quaternion held(double pitch_rad, double roll_rad) {
  return Quaternion(Eigen::AngleAxisd(-kPi / 2.0, Vector3::UnitZ()) *
                    Eigen::AngleAxisd(pitch_rad, Vector3::UnitX()) *
                    Eigen::AngleAxisd(roll_rad, Vector3::UnitY()));
}

TEST(DeadReckoning, WalksStraightOn) {
  const auto deltas = reckon({.heading_rad = -2.0, .body_from_device = held(0.5, 0.1)}, 60.0);
  ASSERT_NEAR(static_cast<double>(deltas.size()), 60.0 * kCadence_hz, 1.0);
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    EXPECT_NEAR(deltas[i].heading_rad, -2.0, 1e-6);
    EXPECT_NEAR(deltas[i].length_m, 0.65, 1e-12);
    EXPECT_NEAR(deltas[i].length_sigma_m, 0.065, 1e-12);
    EXPECT_NEAR(deltas[i].heading_sigma_rad, 0.08, 1e-12);
    if (i > 0) {
      EXPECT_EQ(deltas[i].begin, deltas[i - 1].end);
    }
  }
}

TEST(DeadReckoning, TurnsWithThePhone) {
  constexpr double kTurn_radps = 0.25;
  const auto deltas =
      reckon({.turn_rate_radps = kTurn_radps, .body_from_device = held(0.3, 0.0)}, 40.0);
  ASSERT_GT(deltas.size(), 60U);
  for (std::size_t i = 2; i < deltas.size(); ++i) {
    const double turned_rad = core::wrap_angle(deltas[i].heading_rad - deltas[i - 1].heading_rad);
    EXPECT_NEAR(turned_rad, kTurn_radps / kCadence_hz, 0.02 * kTurn_radps);
  }
}

TEST(DeadReckoning, DoesNotDependOnHowThePhoneIsHeld) {
  const auto flat = reckon({.turn_rate_radps = 0.1, .body_from_device = held(0.0, 0.0)}, 20.0);
  const auto tilted = reckon({.turn_rate_radps = 0.1, .body_from_device = held(0.8, -0.6)}, 20.0);
  ASSERT_EQ(flat.size(), tilted.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    EXPECT_EQ(flat[i].end, tilted[i].end);
    EXPECT_NEAR(core::wrap_angle(flat[i].heading_rad - tilted[i].heading_rad), 0.0, 1e-6);
  }
}

TEST(DeadReckoning, StartsOffWhereItFacesAfterStandingAnotherWay) {
  // 30 s facing east, a left turn within a second, then a walk north.
  DeadReckoning reckoning(options());
  std::vector<MotionDelta> deltas;
  for (int i = 0; i < 50 * 40; ++i) {
    const double time_s = 0.02 * i;
    const auto time = device_time_from_seconds(time_s);
    const bool turning = time_s >= 30.0 && time_s < 31.0;
    const double bounce_mps2 =
        time_s < 31.0 ? 0.0 : 2.5 * std::sin(2.0 * kPi * kCadence_hz * (time_s - 31.0));
    if (i == 0) reckoning.add(sample::RotationSample{time, held(0.0, 0.0)});
    reckoning.add(sample::GyroscopeSample{time, {0.0, 0.0, turning ? kPi / 2.0 : 0.0}});
    const auto delta = reckoning.add(
        sample::AccelerometerSample{time, {0.0, 0.0, kStandardGravity_mps2 + bounce_mps2}});
    if (delta) deltas.push_back(*delta);
  }
  ASSERT_GT(deltas.size(), 10U);
  constexpr double kTenDegrees_rad = kPi / 18.0;
  EXPECT_NEAR(deltas[0].heading_rad, kPi / 2.0, kTenDegrees_rad);
  EXPECT_NEAR(deltas[1].heading_rad, kPi / 2.0, kTenDegrees_rad);
}

TEST(DeadReckoning, TellsNoStepWhenTurningInPlace) {
  for (const Quaternion& pose : {held(0.0, 0.0), held(0.7, 0.4), held(1.5, 0.0)}) {
    EXPECT_TRUE(reckon({.turn_rate_radps = 2.0, .bounce_mps2 = 0.1, .body_from_device = pose}, 30.0)
                    .empty());
  }
}

TEST(DeadReckoning, TellsNothingWithoutAHeading) {
  EXPECT_TRUE(reckon({.compass = false}, 10.0).empty());
}

class DeadReckoningByDetector : public testing::TestWithParam<DeadReckoning::Detector> {};

TEST_P(DeadReckoningByDetector, WalksAndTurns) {
  DeadReckoning::Options with = options();
  with.detector = GetParam();
  constexpr double kTurn_radps = 0.25;
  const Person person{
      .heading_rad = 2.5, .turn_rate_radps = kTurn_radps, .body_from_device = held(0.3, 0.1)};
  const auto deltas = reckon(person, 40.0, with);
  EXPECT_NEAR(static_cast<double>(deltas.size()), 40.0 * kCadence_hz, 2.0);
  for (std::size_t i = 1; i < deltas.size(); ++i) {
    // Its heading is that of a step ago at the earliest and of when it was told at the latest.
    const double lag_rad =
        core::wrap_angle(2.5 + kTurn_radps * core::to_seconds(deltas[i].end.time_since_epoch()) -
                         deltas[i].heading_rad);
    EXPECT_GT(lag_rad, -0.5 * kTurn_radps);
    EXPECT_LT(lag_rad, 0.7 * kTurn_radps);
    EXPECT_LT(deltas[i - 1].end, deltas[i].end);
  }
}

INSTANTIATE_TEST_SUITE_P(All, DeadReckoningByDetector,
                         testing::Values(DeadReckoning::Detector::kThreshold,
                                         DeadReckoning::Detector::kAdaptivePeaks,
                                         DeadReckoning::Detector::kGaussianPeaks,
                                         DeadReckoning::Detector::kExtrema));

TEST(DeadReckoning, FillsTheFeaturesOfAStride) {
  for (const MotionDelta& delta : reckon({.bounce_mps2 = 3.0}, 20.0)) {
    // Of the smoothed wave: the two stages pass 1 / (1 + (1.8 / 3)^2) of 3 m/s2.
    const double amplitude_mps2 = 3.0 / 1.36;
    if (delta.end < device_time_from_seconds(3.0)) continue;
    EXPECT_NEAR(delta.stride.swing_root, std::pow(2.0 * amplitude_mps2, 0.25), 0.02);
    EXPECT_NEAR(delta.stride.mean_abs_time_mps, 2.0 / kPi * amplitude_mps2 / kCadence_hz, 0.05);
  }
}

TEST(DeadReckoning, TakesCorrectedGainsBack) {
  DeadReckoning::Options with = options();
  with.stride.model = StrideModel::Model::kImproved;
  DeadReckoning reckoning(with);
  reckoning.set_stride_gains({.mean_gain = 0.13, .swing_gain = 0.3, .scale_ratio = 0.9});
  std::size_t steps = 0;
  reckoning.add(sample::RotationSample{device_time_from_seconds(0.0), held(0.0, 0.0)});
  for (int i = 0; i < 1000; ++i) {
    const double time_s = 0.02 * i;
    const double up_mps2 = kStandardGravity_mps2 + 3.0 * std::sin(2.0 * kPi * 1.8 * time_s);
    const auto delta = reckoning.add(
        sample::AccelerometerSample{device_time_from_seconds(time_s), {0.0, 0.0, up_mps2}});
    if (!delta) continue;
    ++steps;
    EXPECT_NEAR(delta->length_m,
                0.9 * (0.13 * delta->stride.mean_abs_time_mps + 0.3 * delta->stride.swing_root),
                1e-12);
  }
  EXPECT_GT(steps, 30U);
}

/// Walks straight on for 20 s, then 6 s of weak steps while looking aside and back, then on.
std::vector<MotionDelta> photographer(DeadReckoning::Validity validity) {
  DeadReckoning::Options with = options();
  with.validity = validity;
  DeadReckoning reckoning(with);
  std::vector<MotionDelta> deltas;
  for (int i = 0; i < 50 * 40; ++i) {
    const double time_s = 0.02 * i;
    const auto time = device_time_from_seconds(time_s);
    const bool aside = time_s >= 20.0 && time_s < 26.0;
    const double turn_radps = aside ? 1.6 * std::sin(2.0 * kPi * (time_s - 20.0) / 3.0) : 0.0;
    const double bounce_mps2 = aside ? 1.6 : 4.0;
    if (i == 0) reckoning.add(sample::RotationSample{time, held(0.0, 0.0)});
    reckoning.add(sample::GyroscopeSample{time, {0.0, 0.0, turn_radps}});
    const double up_mps2 =
        kStandardGravity_mps2 + bounce_mps2 * std::sin(2.0 * kPi * kCadence_hz * time_s);
    if (const auto delta = reckoning.add(sample::AccelerometerSample{time, {0.0, 0.0, up_mps2}})) {
      deltas.push_back(*delta);
    }
  }
  return deltas;
}

TEST(DeadReckoning, GivesStepsInPlaceNoLength) {
  for (const MotionDelta& delta : photographer(DeadReckoning::Validity::kOff)) {
    EXPECT_GT(delta.length_m, 0.0);
  }
  for (const auto validity :
       {DeadReckoning::Validity::kLiteral, DeadReckoning::Validity::kThreeWay}) {
    std::size_t in_place = 0;
    core::DeviceTime end = device_time_from_seconds(0.0);
    for (const MotionDelta& delta : photographer(validity)) {
      EXPECT_LT(end, delta.end);
      end = delta.end;
      if (delta.length_m > 0.0) continue;
      ++in_place;
      EXPECT_GT(delta.end, device_time_from_seconds(19.0));
      EXPECT_LT(delta.end, device_time_from_seconds(27.0));
      EXPECT_EQ(delta.stride, observation::StrideFeatures{});
      EXPECT_GT(delta.length_sigma_m, 0.0);
    }
    EXPECT_GE(in_place, 5U);
  }
}

TEST(DeadReckoning, TellsTheHeadingOfAStepThatHadToWait) {
  // A quarter turn at 20 s: steps before it head east, though told after it began.
  DeadReckoning::Options with = options();
  with.validity = DeadReckoning::Validity::kThreeWay;
  DeadReckoning reckoning(with);
  std::size_t before = 0;
  for (int i = 0; i < 50 * 30; ++i) {
    const double time_s = 0.02 * i;
    const auto time = device_time_from_seconds(time_s);
    const bool turning = time_s >= 20.0 && time_s < 20.5;
    if (i == 0) reckoning.add(sample::RotationSample{time, held(0.0, 0.0)});
    reckoning.add(sample::GyroscopeSample{time, {0.0, 0.0, turning ? kPi : 0.0}});
    const double up_mps2 = kStandardGravity_mps2 + 3.0 * std::sin(2.0 * kPi * kCadence_hz * time_s);
    const auto delta = reckoning.add(sample::AccelerometerSample{time, {0.0, 0.0, up_mps2}});
    if (!delta) continue;
    if (delta->end < device_time_from_seconds(20.0)) {
      ++before;
      EXPECT_NEAR(delta->heading_rad, 0.0, 1e-9);
    }
    if (delta->begin > device_time_from_seconds(20.52)) {
      EXPECT_NEAR(delta->heading_rad, kPi / 2.0, 1e-6);
    }
  }
  EXPECT_GT(before, 30U);
}

TEST(DeadReckoning, HeadsByTheRawCompassWhereAsked) {
  DeadReckoning::Options with = options();
  with.heading_source = DeadReckoning::HeadingSource::kCompass;
  with.compass.declination_rad = 0.1;
  DeadReckoning reckoning(with);
  const auto time = device_time_from_seconds(0.0);
  EXPECT_FALSE(reckoning.up_in_device());
  reckoning.add(sample::AccelerometerSample{time, {0.0, 0.0, 9.8}});
  EXPECT_NEAR(reckoning.up_in_device()->z(), 1.0, 1e-12);
  reckoning.add(sample::RotationSample{time, held(0.0, 0.0)});
  EXPECT_FALSE(reckoning.heading_rad());
  // The field points 30 uT to the left: the long axis points to magnetic east.
  MagnetometerCalibration calibration;
  calibration.hard_iron_ut = {5.0, 6.0, 7.0};
  reckoning.set_magnetometer_calibration(calibration);
  reckoning.add(sample::MagnetometerSample{time, {-25.0, 6.0, -33.0}, 3});
  EXPECT_NEAR(*reckoning.heading_rad(), -0.1, 1e-12);
}

TEST(DeadReckoning, PassesOverOtherSamples) {
  DeadReckoning reckoning(options());
  EXPECT_FALSE(reckoning.add(sample::BarometerSample{device_time_from_seconds(1.0), 1000.0}));
  EXPECT_FALSE(reckoning.add(sample::WifiScan{device_time_from_seconds(2.0), {}}));
}

TEST(DeadReckoning, RefusesTheOptionsOfAnyPart) {
  EXPECT_TRUE(DeadReckoning::Options{}.validate());
  const auto refused = [](auto&& spoil) {
    DeadReckoning::Options options;
    spoil(options);
    return !options.validate();
  };
  EXPECT_TRUE(refused([](auto& o) { o.gravity.accelerometer_tau_s = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.heading.initial_sigma_rad = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.step.low_pass_hz = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.stride.shortest_m = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.adaptive_peaks.low_pass_hz = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.gaussian_peaks.window_s = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.extrema.decimator.interval_s = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.step_validity.half_window_s = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.compass.compass_sigma_rad = -1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.step_heading_sigma_rad = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.step_length_sigma_ratio = 0.0; }));
}

}  // namespace
}  // namespace waylode::pdr
