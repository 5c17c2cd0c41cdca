// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/stride_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace waylode::pdr {
namespace {

constexpr StrideModel::Options kOptions{.constant_m = 0.0,
                                        .swing_gain = 0.4,
                                        .cadence_gain_m_s = 0.0,
                                        .shortest_m = 0.25,
                                        .longest_m = 1.2};

Step step_of(double swing_mps2, double interval_s) {
  Step step;
  step.swing_mps2 = swing_mps2;
  step.interval_s = interval_s;
  return step;
}

TEST(StrideModel, GrowsWithTheFourthRootOfTheSwing) {
  const StrideModel model(kOptions);
  EXPECT_NEAR(model.length_m(step_of(1.0, 0.5)), 0.4, 1e-12);
  EXPECT_NEAR(model.length_m(step_of(16.0, 0.5)), 0.8, 1e-12);
  EXPECT_NEAR(model.length_m(step_of(5.0625, 0.5)), 0.6, 1e-12);
}

TEST(StrideModel, AddsCadenceAroundItsUsualValue) {
  StrideModel::Options options = kOptions;
  options.constant_m = 0.1;
  options.cadence_gain_m_s = 0.5;
  const StrideModel model(options);
  // 2.5 Hz is 0.6 Hz above 1.9 Hz, 1.25 Hz is 0.65 Hz below.
  EXPECT_NEAR(model.length_m(step_of(1.0, 0.4)), 0.1 + 0.4 + 0.3, 1e-12);
  EXPECT_NEAR(model.length_m(step_of(16.0, 0.8)), 0.1 + 0.8 - 0.325, 1e-12);
}

TEST(StrideModel, StaysWithinItsBounds) {
  const StrideModel model(kOptions);
  EXPECT_EQ(model.length_m(step_of(0.0, 0.5)), 0.25);
  EXPECT_EQ(model.length_m(step_of(-1.0, 0.5)), 0.25);
  EXPECT_EQ(model.length_m(step_of(256.0, 0.5)), 1.2);
}

using Model = StrideModel::Model;

StrideModel::Options of(Model model) {
  StrideModel::Options options;
  options.model = model;
  return options;
}

/// Swing 8 m/s2, lowest -3.5, mean 0.2, mean absolute 2.744 = 1.4^3, half a second.
Step measured_step() {
  Step step = step_of(8.0, 0.5);
  step.lowest_mps2 = -3.5;
  step.mean_mps2 = 0.2;
  step.mean_abs_mps2 = 2.744;
  return step;
}
const double kRootOfEight = 1.681792830507429;  // 8^(1/4) = 2^(3/4).

TEST(StrideModel, FollowsWeinberg) {
  StrideModel::Options options = of(Model::kWeinberg);
  options.swing_gain = StrideModel::kZhaoSwingGain;
  options.constant_m = 5.0;  // Of another model.
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 0.3426 * kRootOfEight, 1e-12);
}

TEST(StrideModel, FollowsScarlett) {
  StrideModel::Options options = of(Model::kScarlett);
  options.scarlett_gain_m = 1.4;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 1.4 * 3.7 / 8.0, 1e-12);
  Step still = measured_step();
  still.swing_mps2 = 0.0;
  EXPECT_EQ(StrideModel(options).length_m(still), options.shortest_m);
}

TEST(StrideModel, FollowsKimWithEitherRoot) {
  StrideModel::Options options = of(Model::kKim);
  options.kim_gain = 0.5;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 0.5 * 1.4, 1e-12);
  options.kim_root = 2;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 0.5 * std::sqrt(2.744), 1e-12);
}

TEST(StrideModel, FollowsTheImprovedModelInEachReading) {
  StrideModel::Options options = of(Model::kImproved);
  options.longest_m = 3.0;
  const double swing_m = 0.2243 * kRootOfEight;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 0.1124 * 2.744 * 0.5 + swing_m,
              1e-12);
  options.mean_acceleration = StrideModel::MeanAcceleration::kWithGravity;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()),
              0.1124 * (9.80665 + 0.2) * 0.5 + swing_m, 1e-12);
  options.mean_acceleration = StrideModel::MeanAcceleration::kSigned;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 0.1124 * 0.2 * 0.5 + swing_m, 1e-12);
}

TEST(StrideModel, LetsTheImprovedModelMeetWeinbergWhereThePaperWalked) {
  // [Zhao2019] at 1.42 steps/s: a sinusoid of swing 8 has mean |a| = 8 / pi.
  Step step = step_of(8.0, 1.0 / 1.42);
  step.mean_abs_mps2 = 8.0 / 3.14159265358979;
  StrideModel::Options weinberg = of(Model::kWeinberg);
  weinberg.swing_gain = StrideModel::kZhaoSwingGain;
  EXPECT_NEAR(StrideModel(weinberg).length_m(step), 0.576, 0.001);
  EXPECT_NEAR(StrideModel(of(Model::kImproved)).length_m(step), 0.579, 0.001);
}

struct ChenCase {
  double height_m;
  double cadence_hz;
  double length_m;
};

TEST(StrideModel, FollowsTheTableOfHeightAndCadence) {
  // From the specification's table, three digits.
  for (const ChenCase& each :
       {ChenCase{1.50, 1.2, 0.492}, ChenCase{1.60, 2.2, 0.729}, ChenCase{1.70, 1.8, 0.684},
        ChenCase{1.80, 2.6, 0.908}, ChenCase{1.90, 1.4, 0.660}}) {
    StrideModel::Options options = of(Model::kChen);
    options.height_m = each.height_m;
    const StrideModel model(options);
    EXPECT_NEAR(model.length_m(step_of(8.0, 1.0 / each.cadence_hz)), each.length_m, 0.0006);
  }
}

TEST(StrideModel, BoundsCadenceAndLengthOfChen) {
  StrideModel::Options options = of(Model::kChen);
  options.height_m = 1.9;
  EXPECT_NEAR(StrideModel(options).length_m(step_of(8.0, 1.0 / 3.5)),
              StrideModel(options).length_m(step_of(8.0, 1.0 / 2.6)), 1e-12);
  EXPECT_NEAR(StrideModel(options).length_m(step_of(8.0, 1.5)),
              StrideModel(options).length_m(step_of(8.0, 1.0 / 1.2)), 1e-12);
  options.person_ratio = 1.3;
  EXPECT_EQ(StrideModel(options).length_m(step_of(8.0, 0.4)), 1.1);
  options.person_ratio = 0.5;
  EXPECT_EQ(StrideModel(options).length_m(step_of(8.0, 0.8)), 0.4);
}

TEST(StrideModel, SmoothsTheCadenceOfChenWithTheStepBefore) {
  const StrideModel model(of(Model::kChen));
  // 0.8 * 0.5 + 0.2 * 0.6 = 0.52 s.
  EXPECT_NEAR(model.length_m(step_of(8.0, 0.5), 0.6), model.length_m(step_of(8.0, 0.52)), 1e-12);
}

TEST(StrideModel, TakesAShareOfTheHeight) {
  StrideModel::Options options = of(Model::kProportional);
  options.height_m = 1.62;
  options.person_ratio = 1.1;
  EXPECT_NEAR(StrideModel(options).length_m(measured_step()), 1.1 * 0.413 * 1.62, 1e-12);
}

TEST(StrideModel, ReadsTheCoarseTableByStepsInTwoSeconds) {
  StrideModel::Options options = of(Model::kTable);
  options.height_m = 1.6;
  options.longest_m = 3.0;
  const StrideModel model(options);
  for (const auto& [steps, ratio] :
       {std::pair{1.9, 0.2}, std::pair{2.0, 0.25}, std::pair{3.9, 1.0 / 3.0}, std::pair{4.0, 0.5},
        std::pair{5.5, 1.0 / 1.2}, std::pair{6.5, 1.0}, std::pair{8.5, 1.2}}) {
    EXPECT_NEAR(model.length_m(step_of(8.0, 2.0 / steps)), 1.6 * ratio, 1e-12) << steps;
  }
}

TEST(StrideModel, TakesGainsBack) {
  StrideModel model(of(Model::kImproved));
  model.set_gains({.mean_gain = 0.2, .swing_gain = 0.1, .scale_ratio = 1.1});
  EXPECT_NEAR(model.length_m(measured_step()), 1.1 * (0.2 * 2.744 * 0.5 + 0.1 * kRootOfEight),
              1e-12);
}

TEST(StrideModel, TellsTheFeaturesItsGainsMultiply) {
  const observation::StrideFeatures features = stride_features(measured_step());
  EXPECT_NEAR(features.swing_root, kRootOfEight, 1e-12);
  EXPECT_NEAR(features.mean_abs_time_mps, 2.744 * 0.5, 1e-12);
}

TEST(StrideModel, TellsTheShortestOfStepsThatMakeNoSense) {
  for (const Model model : {Model::kThreeTerm, Model::kWeinberg, Model::kScarlett, Model::kKim,
                            Model::kImproved, Model::kChen, Model::kTable}) {
    Step step;
    step.swing_mps2 = step.mean_abs_mps2 = step.mean_mps2 = step.interval_s =
        std::numeric_limits<double>::quiet_NaN();
    const double length_m = StrideModel(of(model)).length_m(step);
    EXPECT_TRUE(length_m >= 0.25 && length_m <= 1.2);
    const double of_nothing_m = StrideModel(of(model)).length_m(Step{});
    EXPECT_TRUE(of_nothing_m >= 0.25 && of_nothing_m <= 1.2);
  }
}

TEST(StrideModel, RefusesOptionsOutOfRange) {
  using Options = StrideModel::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.swing_gain = -0.1}.validate());
  EXPECT_FALSE(Options{.swing_gain = std::numeric_limits<double>::quiet_NaN()}.validate());
  EXPECT_FALSE(Options{.shortest_m = 0.0}.validate());
  EXPECT_FALSE((Options{.shortest_m = 0.7, .longest_m = 0.7}.validate()));
  EXPECT_FALSE(Options{.scarlett_gain_m = 0.0}.validate());
  EXPECT_FALSE(Options{.kim_gain = -1.0}.validate());
  EXPECT_FALSE(Options{.kim_root = 4}.validate());
  EXPECT_FALSE(Options{.gains = {.scale_ratio = 0.0}}.validate());
  EXPECT_FALSE(Options{.height_m = 170.0}.validate());
  EXPECT_FALSE(Options{.person_ratio = 0.0}.validate());
}

}  // namespace
}  // namespace waylode::pdr
