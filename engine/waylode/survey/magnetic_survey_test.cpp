// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/magnetic_survey.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/pdr/gravity_filter.hpp"

namespace waylode::survey {
namespace {

using core::device_time_from_seconds;
using core::FloorId;
using core::Vector2;
using core::Vector3;

MagneticSurvey::Options options() {
  MagneticSurvey::Options options;
  options.spacing_m = 0.3;
  options.align_walks = true;
  options.cells = {.cell_m = 0.5};
  options.gravity = {.accelerometer_tau_s = 2.0};
  return options;
}

constexpr double kSpeed_mps = 1.0;
constexpr double kDuration_s = 30.0;

/// 30 m along y = `y_m` without steps: straight and even, so places can be told by hand.
LabelledPath east(double y_m, std::uint16_t floor = 0) {
  const std::vector<PlacedWaypoint> marks = {
      {device_time_from_seconds(0.0), FloorId{floor}, Vector2(0.0, y_m)},
      {device_time_from_seconds(kDuration_s), FloorId{floor},
       Vector2(kSpeed_mps * kDuration_s, y_m)}};
  return LabelledPath({}, marks, {});
}

/// 25 Hz, the phone lying flat: H = 20 + x / 5, Z = -40, plus a part of the phone's own.
std::vector<sample::Sample> samples_with(double own_horizontal_ut, double own_vertical_ut) {
  std::vector<sample::Sample> samples;
  for (int i = 0; i <= static_cast<int>(25.0 * kDuration_s); ++i) {
    const double time_s = 0.04 * i;
    const auto time = device_time_from_seconds(time_s);
    samples.push_back(
        sample::AccelerometerSample{time, Vector3(0.0, 0.0, pdr::kStandardGravity_mps2)});
    const double horizontal_ut = 20.0 + 0.2 * kSpeed_mps * time_s + own_horizontal_ut;
    samples.push_back(sample::MagnetometerSample{
        time, Vector3(0.6 * horizontal_ut, 0.8 * horizontal_ut, -40.0 + own_vertical_ut), 3});
  }
  return samples;
}

TEST(MagneticSurvey, MapsTheLevelledFieldWhereItWasWalked) {
  MagneticSurvey survey(options());
  survey.add(samples_with(0.0, 0.0), east(2.2, 1));
  const site::MagneticMapStorage map = survey.build();
  // A reading every 0.3 m into cells of 0.5 m.
  EXPECT_NEAR(static_cast<double>(map.points.size()), 60.0, 2.0);
  for (const site::MagneticPoint& point : map.points) {
    EXPECT_EQ(point.floor, 1U);
    EXPECT_NEAR(point.y_m, 2.2, 1e-5);
    EXPECT_NEAR(point.horizontal_ut, 20.0 + 0.2 * static_cast<double>(point.x_m), 1e-3);
    EXPECT_NEAR(point.vertical_ut, -40.0, 1e-3);
    EXPECT_LE(point.count, 2U);
  }
}

TEST(MagneticSurvey, LevelsWhateverTheHandDoes) {
  MagneticSurvey upright(options());
  std::vector<sample::Sample> samples = samples_with(0.0, 0.0);
  for (sample::Sample& each : samples) {
    // The device stands on its lower edge: its y is up, its -z ahead.
    const auto stand = [](const Vector3& lying) {
      return Vector3(lying.x(), lying.z(), -lying.y());
    };
    if (auto* force = std::get_if<sample::AccelerometerSample>(&each)) {
      force->specific_force_mps2 = stand(force->specific_force_mps2);
    } else if (auto* field = std::get_if<sample::MagnetometerSample>(&each)) {
      field->field_ut = stand(field->field_ut);
    }
  }
  upright.add(samples, east(2.2));
  MagneticSurvey lying(options());
  lying.add(samples_with(0.0, 0.0), east(2.2));
  const auto of_upright = upright.build();
  const auto of_lying = lying.build();
  ASSERT_EQ(of_upright.points.size(), of_lying.points.size());
  for (std::size_t i = 0; i < of_lying.points.size(); ++i) {
    EXPECT_NEAR(of_upright.points[i].horizontal_ut, of_lying.points[i].horizontal_ut, 1e-4);
    EXPECT_NEAR(of_upright.points[i].vertical_ut, of_lying.points[i].vertical_ut, 1e-4);
  }
}

TEST(MagneticSurvey, TakesThePhonesOwnFieldAwayWhereWalksMeet) {
  const auto scatter_ut = [](bool align) {
    MagneticSurvey::Options own = options();
    own.align_walks = align;
    MagneticSurvey survey(own);
    survey.add(samples_with(6.0, -3.0), east(2.2));
    survey.add(samples_with(-6.0, 3.0), east(2.2));
    double worst = 0.0;
    for (const site::MagneticPoint& point : survey.build().points) {
      worst = std::max(worst, static_cast<double>(point.sigma_ut));
      EXPECT_NEAR(point.horizontal_ut, 20.0 + 0.2 * static_cast<double>(point.x_m), 0.5);
    }
    return worst;
  };
  // Half the difference, root mean square of both parts: sqrt((36 + 9) / 2).
  EXPECT_NEAR(scatter_ut(false), std::sqrt(22.5), 0.2);
  EXPECT_LT(scatter_ut(true), 1.0);
}

TEST(MagneticSurvey, LeavesWalksThatMeetNobodyAsTheyAre) {
  MagneticSurvey survey(options());
  survey.add(samples_with(6.0, 0.0), east(2.2));
  survey.add(samples_with(0.0, 0.0), east(22.2));
  survey.add(samples_with(6.0, 0.0), east(2.2, 1));
  for (const site::MagneticPoint& point : survey.build().points) {
    const double own_ut = point.y_m < 10.0F ? 6.0 : 0.0;
    EXPECT_NEAR(point.horizontal_ut, 20.0 + own_ut + 0.2 * static_cast<double>(point.x_m), 1e-3);
  }
}

TEST(MagneticSurvey, NeedsFieldGravityAndLabels) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MagneticSurvey survey(options());
  survey.add({}, east(2.2));
  std::vector<sample::Sample> no_gravity = samples_with(0.0, 0.0);
  std::erase_if(no_gravity, [](const sample::Sample& each) {
    return std::holds_alternative<sample::AccelerometerSample>(each);
  });
  survey.add(no_gravity, east(2.2));
  survey.add(samples_with(nan, 0.0), east(2.2));
  survey.add(samples_with(0.0, 0.0), LabelledPath({}, {}, {}));
  EXPECT_TRUE(survey.build().points.empty());
  EXPECT_TRUE(MagneticSurvey(options()).build().points.empty());
}

TEST(MagneticSurvey, MakesNoMapWhenNotAsked) {
  MagneticSurvey::Options off = options();
  off.build = false;
  MagneticSurvey survey(off);
  survey.add(samples_with(0.0, 0.0), east(2.2));
  EXPECT_TRUE(survey.build().points.empty());
}

TEST(MagneticSurvey, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(MagneticSurvey::Options{}.validate());
  const auto refused = [](auto&& spoil) {
    MagneticSurvey::Options options;
    spoil(options);
    return !options.validate();
  };
  EXPECT_TRUE(refused([](auto& o) { o.spacing_m = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.spacing_m = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& o) { o.cells.cell_m = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.gravity.accelerometer_tau_s = 0.0; }));
}

}  // namespace
}  // namespace waylode::survey
