// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/stride_calibrator.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/rng.hpp"

namespace waylode::pdr {
namespace {

using core::Matrix2;
using core::Vector2;
using observation::StrideFeatures;

constexpr StrideCalibrator::Options kGains{.prior = {.mean_gain = 0.11, .swing_gain = 0.22},
                                           .mean_gain_sigma = 0.03,
                                           .swing_gain_sigma = 0.05};
constexpr StrideCalibrator::Options kScale{.unknown = StrideCalibrator::Unknown::kScale,
                                           .prior = {.mean_gain = 0.11, .swing_gain = 0.22},
                                           .scale_sigma_ratio = 0.08};

TEST(StrideCalibrator, StartsFromThePrior) {
  const StrideCalibrator calibrator(kGains);
  EXPECT_EQ(calibrator.gains().mean_gain, 0.11);
  EXPECT_EQ(calibrator.gains().swing_gain, 0.22);
  EXPECT_EQ(calibrator.gains().scale_ratio, 1.0);
}

RC_GTEST_PROP(StrideCalibrator, AgreesWithTheRidgeSolutionOfAllSegmentsAtOnce, ()) {
  core::Rng rng(*rc::gen::inRange<std::uint64_t>(0, 100'000));
  const auto segments = *rc::gen::inRange(1, 12);
  StrideCalibrator calibrator(kGains);
  // (X^T R^-1 X + P^-1) g = X^T R^-1 y + P^-1 prior.
  const Matrix2 prior_information = Vector2(1.0 / (0.03 * 0.03), 1.0 / (0.05 * 0.05)).asDiagonal();
  Matrix2 information = prior_information;
  Vector2 right = prior_information * Vector2(0.11, 0.22);
  for (int k = 0; k < segments; ++k) {
    Vector2 sum = Vector2::Zero();
    const int steps = 5 + k;
    for (int i = 0; i < steps; ++i) {
      const StrideFeatures features{.swing_root = rng.uniform(1.3, 1.9),
                                    .mean_abs_time_mps = rng.uniform(0.8, 1.8)};
      calibrator.add(features);
      sum += Vector2(features.mean_abs_time_mps, features.swing_root);
    }
    const double distance_m = rng.uniform(2.0, 12.0);
    const double sigma_m = rng.uniform(0.2, 2.0);
    RC_ASSERT(calibrator.observe(distance_m, sigma_m).has_value());
    information += sum * sum.transpose() / (sigma_m * sigma_m);
    right += sum * distance_m / (sigma_m * sigma_m);
  }
  const Matrix2 covariance = information.inverse();
  const Vector2 gains = covariance * right;
  RC_ASSERT(std::abs(calibrator.gains().mean_gain - gains(0)) < 1e-9);
  RC_ASSERT(std::abs(calibrator.gains().swing_gain - gains(1)) < 1e-9);
  RC_ASSERT((calibrator.covariance() - covariance).norm() < 1e-9);
}

TEST(StrideCalibrator, LearnsAPersonsGains) {
  core::Rng rng(17);
  StrideCalibrator calibrator(kGains);
  for (int k = 0; k < 400; ++k) {
    double truth_m = 0.0;
    // Slow walks and fast ones, or the two gains could not be told apart.
    const double pace = rng.uniform(0.5, 1.5);
    for (int i = 0; i < 15; ++i) {
      const StrideFeatures features{.swing_root = 1.2 + 0.4 * pace,
                                    .mean_abs_time_mps = 1.5 * pace * pace};
      calibrator.add(features);
      truth_m += 0.14 * features.mean_abs_time_mps + 0.25 * features.swing_root;
    }
    ASSERT_TRUE(calibrator.observe(truth_m + 0.3 * rng.normal(), 0.3));
  }
  EXPECT_NEAR(calibrator.gains().mean_gain, 0.14, 4.0 * std::sqrt(calibrator.covariance()(0, 0)));
  EXPECT_NEAR(calibrator.gains().swing_gain, 0.25, 4.0 * std::sqrt(calibrator.covariance()(1, 1)));
  EXPECT_LT(std::sqrt(calibrator.covariance()(0, 0)), 0.01);
}

TEST(StrideCalibrator, LearnsOneScaleByTheWeightOfItsDoubt) {
  StrideCalibrator calibrator(kScale);
  for (int i = 0; i < 20; ++i) calibrator.add({.swing_root = 1.5, .mean_abs_time_mps = 1.2});
  const double predicted_m = 20.0 * (0.11 * 1.2 + 0.22 * 1.5);
  ASSERT_TRUE(calibrator.observe(1.1 * predicted_m, 0.5));
  // Precision-weighted mean of 1 (sigma 0.08) and 1.1 (sigma 0.5 / predicted).
  const double prior_weight = 1.0 / (0.08 * 0.08);
  const double weight = std::pow(predicted_m / 0.5, 2);
  const double expected = (prior_weight + 1.1 * weight) / (prior_weight + weight);
  EXPECT_NEAR(calibrator.gains().scale_ratio, expected, 1e-12);
  EXPECT_NEAR(calibrator.covariance()(0, 0), 1.0 / (prior_weight + weight), 1e-12);
  EXPECT_EQ(calibrator.gains().mean_gain, 0.11);
  EXPECT_EQ(calibrator.gains().swing_gain, 0.22);
}

TEST(StrideCalibrator, ScalesTheLengthsOfAnyModel) {
  StrideCalibrator calibrator(kScale);
  for (int k = 0; k < 200; ++k) {
    for (int i = 0; i < 10; ++i) calibrator.add_length(0.7);
    ASSERT_TRUE(calibrator.observe(6.3, 0.2));
  }
  EXPECT_NEAR(calibrator.gains().scale_ratio, 0.9, 0.001);
}

TEST(StrideCalibrator, ForgetsASegmentThatIsDropped) {
  StrideCalibrator calibrator(kScale);
  calibrator.add_length(100.0);
  calibrator.drop_segment();
  for (int i = 0; i < 10; ++i) calibrator.add_length(1.0);
  ASSERT_TRUE(calibrator.observe(10.0, 0.1));
  EXPECT_NEAR(calibrator.gains().scale_ratio, 1.0, 1e-12);
}

TEST(StrideCalibrator, RefusesSegmentsThatMakeNoSense) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  StrideCalibrator calibrator(kGains);
  EXPECT_FALSE(calibrator.observe(5.0, 1.0));  // No step.
  for (const auto& [distance_m, sigma_m] :
       {std::pair{kNan, 1.0}, std::pair{-1.0, 1.0}, std::pair{5.0, 0.0}, std::pair{5.0, kNan},
        std::pair{std::numeric_limits<double>::infinity(), 1.0}}) {
    calibrator.add({.swing_root = 1.5, .mean_abs_time_mps = 1.2});
    EXPECT_FALSE(calibrator.observe(distance_m, sigma_m));
  }
  calibrator.add({.swing_root = kNan, .mean_abs_time_mps = 1.2});
  calibrator.add({});
  EXPECT_FALSE(calibrator.observe(5.0, 1.0));  // Steps without features.
  EXPECT_EQ(calibrator.gains(), kGains.prior);
}

TEST(StrideCalibrator, LearnsFromStandingStillThatNothingWasWalked) {
  StrideCalibrator calibrator(kScale);
  calibrator.add_length(2.0);
  EXPECT_TRUE(calibrator.observe(0.0, 5.0));
  EXPECT_LT(calibrator.gains().scale_ratio, 1.0);
  EXPECT_GT(calibrator.gains().scale_ratio, 0.99);
}

TEST(StrideCalibrator, RefusesOptionsOutOfRange) {
  using Options = StrideCalibrator::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.mean_gain_sigma = value}.validate());
    EXPECT_FALSE(Options{.swing_gain_sigma = value}.validate());
    EXPECT_FALSE(Options{.scale_sigma_ratio = value}.validate());
    EXPECT_FALSE(Options{.prior = {.scale_ratio = value}}.validate());
  }
}

}  // namespace
}  // namespace waylode::pdr
