// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/step_position_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using testing::at_s;
using testing::scan_of;
using testing::step_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Every option is set here, so that no test hangs on a default; nothing is doubted or lost.
StepPositionFilter::Options plain_options() {
  StepPositionFilter::Options options;
  options.spread = {1.0, 2.0, 0.0};
  options.heading_offset_sigma_rad = 0.1;
  options.log_scale_sigma = 0.05;
  options.heading_offset_walk_rad_per_sqrt_step = 0.01;
  options.log_scale_walk_per_sqrt_step = 0.003;
  options.position_walk_m_per_sqrt_s = 0.2;
  options.radio_bias_sigma_m = 3.0;
  options.radio_bias_tau_s = 15.0;
  options.radio_sigma_scale = 1.0;
  options.radio_floor_sigma_m = 0.0;
  options.gate = kInfinity;
  options.lost_failures = 0;
  options.lost_window = 6;
  options.lost_gate = 13.8;
  options.lost_heading_sigma_rad = 0.8;
  return options;
}

/// Only the place is unknown.
StepPositionFilter::Options position_only_options() {
  StepPositionFilter::Options options = plain_options();
  options.heading_offset_sigma_rad = options.log_scale_sigma = options.radio_bias_sigma_m = 0.0;
  options.heading_offset_walk_rad_per_sqrt_step = options.log_scale_walk_per_sqrt_step = 0.0;
  return options;
}

PlanarEstimate place_of(double time_s, const Vector2& position_m, double sigma_m) {
  return {at_s(time_s), position_m, sigma_m * sigma_m * Matrix2::Identity()};
}

TEST(StepPositionFilter, AddsStepsAndPositionsInClosedForm) {
  StepPositionFilter filter(position_only_options());
  filter.start(place_of(0.0, {5.0, 7.0}, 2.0));
  ASSERT_TRUE(filter.add(step_of(0.0, 0.5, 0.8, 0.0, 0.3, 0.25)));
  // Along 0.3^2, across (0.8 * 0.25)^2, walk 0.2^2 * 0.5 per axis.
  const PlanarEstimate walked = filter.at(at_s(0.5));
  EXPECT_NEAR(walked.position_m.x(), 5.8, 1e-6);
  EXPECT_NEAR(walked.covariance_m2(0, 0), 4.0 + 0.09 + 0.02, 1e-6);
  EXPECT_NEAR(walked.covariance_m2(1, 1), 4.0 + 0.04 + 0.02, 1e-6);
  const auto update = filter.add(scan_of(0.5, {7.0, 6.0}, 3.0));
  ASSERT_TRUE(update);
  EXPECT_NEAR(update->normalized_innovation_squared, 1.44 / 13.11 + 1.0 / 13.06, 1e-5);
  EXPECT_NEAR(filter.at(at_s(0.5)).position_m.x(), 5.8 + 1.2 * 4.11 / 13.11, 1e-5);
  EXPECT_NEAR(filter.at(at_s(0.5)).position_m.y(), 7.0 - 4.06 / 13.06, 1e-5);
  EXPECT_NEAR(filter.at(at_s(0.5)).covariance_m2(0, 0), 4.11 * 9.0 / 13.11, 1e-5);
}

TEST(StepPositionFilter, ScalesTheRadiosSigmaAndAddsAFloor) {
  StepPositionFilter::Options options = position_only_options();
  options.radio_sigma_scale = 2.0;
  options.radio_floor_sigma_m = 3.0;
  StepPositionFilter filter(options);
  filter.start(place_of(0.0, {0.0, 0.0}, 4.0));
  ASSERT_TRUE(filter.add(scan_of(0.0, {10.0, 0.0}, 1.5)));
  // Variance 16 against 4 * 2.25 + 9 = 18.
  EXPECT_NEAR(filter.at(at_s(0.0)).position_m.x(), 10.0 * 16.0 / 34.0, 1e-5);
  ASSERT_TRUE(filter.add_unbiased(scan_of(0.0, {10.0, 0.0}, 1.5)));
  // An unbiased one at its own sigma.
  const double before_m = 160.0 / 34.0;
  const double variance_m2 = 16.0 * 18.0 / 34.0;
  EXPECT_NEAR(filter.at(at_s(0.0)).position_m.x(),
              before_m + (10.0 - before_m) * variance_m2 / (variance_m2 + 2.25), 1e-5);
}

TEST(StepPositionFilter, LearnsTheHeadingOffsetAndTheScale) {
  StepPositionFilter::Options options = plain_options();
  options.heading_offset_sigma_rad = 0.3;
  options.log_scale_sigma = 0.1;
  options.radio_bias_sigma_m = 0.01;
  StepPositionFilter filter(options);
  filter.start(place_of(0.0, {0.0, 0.0}, 1.0));
  Vector2 truth_m(0.0, 0.0);
  for (int i = 0; i < 120; ++i) {
    const double heading_rad = 0.5 * std::acos(-1.0) * (i / 20);
    filter.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, heading_rad, 0.01, 0.01));
    truth_m += 1.1 * 0.7 * Vector2(std::cos(heading_rad + 0.3), std::sin(heading_rad + 0.3));
    if (i % 4 == 3) filter.add(scan_of(0.5 * (i + 1), truth_m, 0.5));
  }
  EXPECT_NEAR(filter.heading_offset_rad(), 0.3, 0.02);
  EXPECT_NEAR(filter.step_scale(), 1.1, 0.02);
  EXPECT_LT(filter.heading_offset_sigma_rad(), 0.1);
  EXPECT_LT(filter.log_scale_sigma(), 0.06);
  EXPECT_LT((filter.at(at_s(60.0)).position_m - truth_m).norm(), 0.15);
}

TEST(StepPositionFilter, PlacesADelayedScanWhereItWasMeasuredAndWalksOnFromThere) {
  StepPositionFilter filter(position_only_options());
  filter.start(place_of(0.0, {0.0, 0.0}, 1e3));
  filter.add(step_of(0.0, 0.5, 1.0, 0.0));
  filter.add(step_of(0.5, 1.0, 2.0, 0.0));
  filter.add(step_of(1.5, 2.0, 4.0, 0.5 * std::acos(-1.0)));
  // Measured halfway through the second step: one metre of it and the four northwards follow.
  filter.add(scan_of(2.0, {100.0, 50.0}, 1.0, /*delay_s=*/1.25));
  EXPECT_NEAR(filter.at(at_s(2.0)).position_m.x(), 101.0, 1e-3);
  EXPECT_NEAR(filter.at(at_s(2.0)).position_m.y(), 54.0, 1e-3);
}

TEST(StepPositionFilter, TakesAScanInMidStepForOneOfAWalkerInMidStep) {
  StepPositionFilter filter(position_only_options());
  filter.start(place_of(0.0, {0.0, 0.0}, 1e3));
  filter.add(step_of(0.0, 0.5, 1.0, 0.0));
  filter.add(scan_of(0.7, {20.0, 3.0}, 0.1));
  // 0.2 s of a half-second step: the scan stands 0.4 m beyond the end of the last one.
  EXPECT_NEAR(filter.at(at_s(0.7)).position_m.x(), 20.0, 1e-3);
  EXPECT_NEAR(filter.at(at_s(1.0)).position_m.x(), 20.6, 1e-3);
  filter.add(step_of(0.5, 1.0, 1.0, 0.0));
  EXPECT_NEAR(filter.at(at_s(1.0)).position_m.x(), 20.6, 1e-3);
}

TEST(StepPositionFilter, TakesAStepThatIsToldAfterALaterScan) {
  StepPositionFilter filter(position_only_options());
  filter.start(place_of(0.0, {0.0, 0.0}, 1.0));
  ASSERT_TRUE(filter.add(scan_of(1.2, {0.0, 0.0}, 1.0)));
  EXPECT_TRUE(filter.add(step_of(0.5, 1.0, 0.7, 0.0)));
  EXPECT_EQ(filter.time(), at_s(1.2));
  EXPECT_NEAR(filter.filter().mean()(0), 0.7, 1e-6);
}

TEST(StepPositionFilter, StartsAtTheFirstPositionAndIgnoresStepsBefore) {
  StepPositionFilter filter(plain_options());
  EXPECT_FALSE(filter.add(step_of(0.0, 0.5, 0.7, 0.0)));
  EXPECT_FALSE(filter.started());
  ASSERT_TRUE(filter.add(scan_of(3.0, {12.0, -4.0}, 5.0)));
  ASSERT_TRUE(filter.started());
  EXPECT_EQ(filter.at(at_s(3.0)).position_m, Vector2(12.0, -4.0));
  EXPECT_NEAR(filter.at(at_s(3.0)).covariance_m2(0, 0), 25.0, 1e-9);
}

TEST(StepPositionFilter, BelievesAPositionLessTheFartherItIsOff) {
  StepPositionFilter::Options options = position_only_options();
  options.gate = 4.0;
  // Innovation variance 4 + 4; beyond 4 sqrt(2) m the noise grows by the chi-square's quotient.
  for (const double off_m : {3.0, 8.0, 80.0}) {
    StepPositionFilter filter(options);
    filter.start(place_of(0.0, {0.0, 0.0}, 2.0));
    const auto update = filter.add(scan_of(0.0, {off_m, 0.0}, 2.0));
    ASSERT_TRUE(update);
    const double inflation = std::max(1.0, off_m * off_m / 8.0 / 4.0);
    EXPECT_NEAR(update->noise_inflation, inflation, 1e-4 * inflation);
    EXPECT_NEAR(filter.at(at_s(0.0)).position_m.x(), off_m / (1.0 + inflation), 1e-4);
  }
}

TEST(StepPositionFilter, RecoversFromAStartInTheWrongDirection) {
  StepPositionFilter::Options options = plain_options();
  options.radio_bias_sigma_m = 0.5;
  options.gate = 4.0;
  options.lost_failures = 3;
  options.lost_window = 4;
  options.lost_gate = 9.0;
  options.lost_heading_sigma_rad = 1.0;
  StepPositionFilter filter(options);
  filter.start(place_of(0.0, {0.0, 0.0}, 1.0));
  // Walks east, the phone says north.
  for (int i = 1; i <= 80; ++i) {
    filter.add(step_of(0.5 * (i - 1), 0.5 * i, 0.7, 0.5 * std::acos(-1.0), 0.02, 0.02));
    if (i % 4 == 0) filter.add(scan_of(0.5 * i, {0.7 * i, 0.0}, 1.0));
  }
  EXPECT_GE(filter.losses(), 1);
  EXPECT_LE(filter.losses(), 3);
  EXPECT_LT((filter.at(at_s(40.0)).position_m - Vector2(56.0, 0.0)).norm(), 1.5);
  EXPECT_NEAR(filter.heading_offset_rad(), -0.5 * std::acos(-1.0), 0.2);
}

TEST(StepPositionFilter, MovesToAPlaceAndKeepsWhatItKnowsOfTheWalker) {
  StepPositionFilter filter(plain_options());
  filter.start(place_of(0.0, {0.0, 0.0}, 1.0));
  for (int i = 0; i < 20; ++i) {
    filter.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.1));
    filter.add(scan_of(0.5 * (i + 1), {0.8 * (i + 1), 0.0}, 1.0));
  }
  const double offset_rad = filter.heading_offset_rad();
  const double scale = filter.step_scale();
  filter.move_to(place_of(10.0, {50.0, 60.0}, 2.0));
  EXPECT_EQ(filter.at(at_s(10.0)).position_m, Vector2(50.0, 60.0));
  EXPECT_NEAR(filter.at(at_s(10.0)).covariance_m2(1, 1), 4.0, 1e-12);
  EXPECT_EQ(filter.heading_offset_rad(), offset_rad);
  EXPECT_EQ(filter.step_scale(), scale);
  filter.start(place_of(10.0, {1.0, 2.0}, 2.0));
  EXPECT_EQ(filter.heading_offset_rad(), 0.0);
}

/// Walks of the planar tracker's model, which is the same: every sixth step a scan.
TEST(StepPositionFilter, StatesItsErrorHonestlyOnWalksOfItsModel) {
  constexpr int kRuns = 200;
  constexpr int kScans = 25;
  double nees = 0.0;
  double nis = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    testing::ModelWalk walk(testing::gaussian_options(), 9000 + static_cast<std::uint64_t>(run));
    StepPositionFilter filter(plain_options());
    filter.start(place_of(0.0, {0.0, 0.0}, 20.0));
    for (int scan = 0; scan < kScans; ++scan) {
      for (int i = 0; i < 6; ++i) filter.add(walk.step());
      // At the end of the last step: an instant later the walker would count as in mid-step.
      nis += filter.add(walk.scan())->normalized_innovation_squared;
    }
    const StepPositionFilter::Filter::State error = filter.filter().mean() - walk.truth();
    nees += error.dot(filter.filter().covariance().ldlt().solve(error));
  }
  // 99.9 %: six degrees of freedom over 200 runs, two over 5000 innovations.
  EXPECT_NEAR(nees / kRuns, 6.0, 3.29 * std::sqrt(12.0 / kRuns));
  EXPECT_NEAR(nis / (kRuns * kScans), 2.0, 3.29 * std::sqrt(4.0 / (kRuns * kScans)));
}

TEST(StepPositionFilter, TellsHowFarAPositionIsFromWhatItExpects) {
  StepPositionFilter filter(position_only_options());
  filter.start(place_of(0.0, {0.0, 0.0}, 2.0));
  const auto surprise = filter.surprise(scan_of(0.0, {3.0, 1.0}, 3.0));
  EXPECT_NEAR(surprise.chi_square, 10.0 / 13.0, 1e-6);
  EXPECT_NEAR(surprise.log_determinant, 2.0 * std::log(13.0), 1e-6);
}

TEST(StepPositionFilter, PassesOverWhatItCannotUse) {
  StepPositionFilter filter(plain_options());
  filter.start(place_of(5.0, {1.0, 2.0}, 3.0));
  ASSERT_TRUE(filter.add(step_of(5.0, 5.5, 0.7, 0.0)));
  ASSERT_TRUE(filter.add(scan_of(6.0, {1.0, 2.0}, 3.0)));
  const auto mean = filter.filter().mean();
  for (const double bad : {kNan, kInfinity, -0.1}) {
    auto step = step_of(6.0, 6.5, 0.7, 0.0);
    step.length_m = bad;
    EXPECT_FALSE(filter.add(step)) << bad;
    step = step_of(6.0, 6.5, 0.7, 0.0);
    step.length_sigma_m = bad;
    EXPECT_FALSE(filter.add(step)) << bad;
    step = step_of(6.0, 6.5, 0.7, 0.0);
    step.heading_sigma_rad = bad;
    EXPECT_FALSE(filter.add(step)) << bad;
  }
  EXPECT_FALSE(filter.add(step_of(6.0, 6.5, 0.7, kNan)));
  EXPECT_FALSE(filter.add(step_of(6.5, 6.0, 0.7, 0.0)));  // Ends before it begins.
  EXPECT_FALSE(filter.add(step_of(5.0, 5.4, 0.7, 0.0)));  // Ends before the last one did.
  EXPECT_FALSE(filter.add(scan_of(6.5, {kNan, 0.0}, 3.0)));
  EXPECT_FALSE(filter.add(scan_of(6.5, {0.0, 0.0}, kNan)));
  EXPECT_FALSE(filter.add(scan_of(6.5, {0.0, 0.0}, 0.0)));
  EXPECT_FALSE(filter.add(scan_of(5.9, {0.0, 0.0}, 3.0)));        // Before the last one.
  EXPECT_FALSE(filter.add(scan_of(6.5, {0.0, 0.0}, 3.0, -1.0)));  // Measured after delivery.
  EXPECT_EQ(filter.filter().mean(), mean);
  EXPECT_EQ(filter.time(), at_s(6.0));
  EXPECT_TRUE(filter.add(scan_of(6.0, {1.0, 2.0}, 3.0)));  // A second one at the same time is fine.
}

TEST(StepPositionFilter, DoubtsMoreTheLongerNothingIsHeard) {
  StepPositionFilter filter(position_only_options());
  filter.start(place_of(0.0, {0.0, 0.0}, 1.0));
  EXPECT_NEAR(filter.at(at_s(3600.0)).covariance_m2(0, 0), 1.0 + 0.04 * 3600.0, 1e-6);
  EXPECT_EQ(filter.at(at_s(3600.0)).time, at_s(3600.0));
  EXPECT_TRUE(filter.add(scan_of(3600.0, {30.0, 0.0}, 1.0)));
  EXPECT_NEAR(filter.at(at_s(3600.0)).position_m.x(), 30.0 * 145.0 / 146.0, 1e-4);
}

RC_GTEST_PROP(StepPositionFilter, KeepsItsCovarianceValid, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  StepPositionFilter::Options options = plain_options();
  options.gate = 4.0;
  options.lost_failures = 3;
  options.radio_bias_sigma_m = rng.below(2) == 0 ? 0.0 : 2.0;
  options.log_scale_sigma = rng.below(2) == 0 ? 0.0 : 0.1;
  StepPositionFilter filter(options);
  double now_s = 3.0;
  for (int i = 0; i < 120; ++i) {
    const double begin_s = now_s;
    now_s += rng.below(20) == 0 ? rng.uniform(2.0, 900.0) : rng.uniform(0.0, 0.8);
    if (rng.below(3) != 0) {
      filter.add(step_of(begin_s, now_s, rng.below(8) == 0 ? 0.0 : rng.uniform(0.1, 1.2),
                         rng.uniform(-3.1, 3.1), rng.uniform(0.0, 0.2), rng.uniform(0.0, 0.3)));
    } else {
      const double off_m = rng.below(10) == 0 ? 500.0 : 4.0;
      filter.add(scan_of(now_s, {rng.normal(0.0, off_m), rng.normal(0.0, off_m)},
                         std::pow(10.0, rng.uniform(-3.0, 2.0)), rng.uniform(0.0, 40.0)));
    }
    if (!filter.started()) continue;
    const PlanarEstimate estimate = filter.at(at_s(now_s + rng.uniform(0.0, 5.0)));
    RC_ASSERT(estimate.position_m.allFinite());
    RC_ASSERT(core::is_valid_covariance(estimate.covariance_m2));
    RC_ASSERT(filter.filter().covariance().llt().info() == Eigen::Success);
  }
}

TEST(StepPositionFilter, RejectsOptionsThatMakeNoSense) {
  using Options = StepPositionFilter::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_TRUE(plain_options().validate());
  const std::vector<double Options::*> not_negative = {
      &Options::heading_offset_sigma_rad,
      &Options::log_scale_sigma,
      &Options::heading_offset_walk_rad_per_sqrt_step,
      &Options::log_scale_walk_per_sqrt_step,
      &Options::position_walk_m_per_sqrt_s,
      &Options::radio_bias_sigma_m,
      &Options::radio_bias_tau_s,
      &Options::radio_sigma_scale,
      &Options::radio_floor_sigma_m,
      &Options::gate,
      &Options::lost_gate,
      &Options::lost_heading_sigma_rad};
  for (std::size_t i = 0; i < not_negative.size(); ++i) {
    for (const double bad : {-1.0, kNan}) {
      Options options = plain_options();
      options.*not_negative[i] = bad;
      ASSERT_FALSE(options.validate()) << i;
    }
  }
  Options options = plain_options();
  options.lost_failures = 7;
  EXPECT_FALSE(options.validate());
  options.lost_failures = -1;
  EXPECT_FALSE(options.validate());
  options = plain_options();
  options.spread.alpha = 0.0;
  EXPECT_FALSE(options.validate());
}

}  // namespace
}  // namespace waylode::fusion
