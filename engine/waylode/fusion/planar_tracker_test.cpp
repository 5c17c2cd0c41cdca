// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/planar_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using testing::at_s;
using testing::gaussian_options;
using testing::robust_options;
using testing::scan_of;
using testing::step_of;

/// Heading and scale known for sure, no radio bias: only the position is left to estimate.
PlanarTracker::Options position_only_options() {
  PlanarTracker::Options options = gaussian_options();
  options.heading_offset_sigma_rad = options.log_scale_sigma = 0.0;
  options.heading_offset_walk_rad_per_sqrt_step = options.log_scale_walk_per_sqrt_step = 0.0;
  options.radio_bias_sigma_m = 1e-9;
  return options;
}

/// A tracker in the middle of a walk: heading offset, scale and bias are no longer zero.
PlanarTracker wandering_tracker(PlanarTracker::Options options) {
  options.heading_offset_sigma_rad = 0.4;
  options.log_scale_sigma = 0.2;
  PlanarTracker tracker(options, /*keep_history=*/true);
  tracker.start(at_s(0.0), {3.0, -2.0}, 4.0);
  for (int i = 0; i < 12; ++i) {
    tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.8, 0.1 * i));
    const double along_m = 1.1 * (i + 1);
    tracker.add(scan_of(0.5 * (i + 1), {3.0 + 0.6 * along_m, -1.0 + 0.9 * along_m}, 1.5));
  }
  EXPECT_GT(std::abs(tracker.state().mean(2)), 0.1);
  EXPECT_GT(std::abs(tracker.state().mean(3)), 0.02);
  EXPECT_GT(tracker.state().mean.tail<2>().norm(), 0.1);
  return tracker;
}

TEST(PlanarTracker, EqualsTheTextbookLinearFilterWhenOnlyThePositionIsUnknown) {
  const PlanarTracker::Options options = position_only_options();
  PlanarTracker tracker(options, false);
  tracker.start(at_s(0.0), {5.0, 7.0}, 10.0);
  Vector2 mean_m(5.0, 7.0);
  Matrix2 covariance_m2 = 100.0 * Matrix2::Identity();
  core::Rng rng(11);
  double now_s = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double dt_s = rng.uniform(0.3, 1.2);
    const double heading_rad = rng.uniform(-3.0, 3.0);
    const auto step = step_of(now_s, now_s + dt_s, rng.uniform(0.4, 1.0), heading_rad, 0.07, 0.1);
    now_s = core::to_seconds(step.end - at_s(0.0));
    tracker.add(step);
    const Matrix2 turn = testing::rotation(heading_rad);
    const double dt_exact_s = core::to_seconds(step.end - step.begin);
    const Vector2 variances_m2(0.07 * 0.07, std::pow(0.1 * step.length_m, 2));
    mean_m += turn * Vector2(step.length_m, 0.0);
    covariance_m2 += turn * variances_m2.asDiagonal() * turn.transpose() +
                     0.2 * 0.2 * dt_exact_s * Matrix2::Identity();
    if (i % 4 == 3) {
      PlanarMeasurement scan{step.end, step.end, mean_m, Matrix2::Zero()};
      scan.position_m += Vector2(rng.normal(0.0, 5.0), rng.normal(0.0, 3.0));
      scan.covariance_m2 << 25.0, 4.0, 4.0, 9.0;
      tracker.add(scan);
      const Matrix2 gain = covariance_m2 * (covariance_m2 + scan.covariance_m2).inverse();
      mean_m += gain * (scan.position_m - mean_m);
      covariance_m2 = ((Matrix2::Identity() - gain) * covariance_m2).eval();
    }
    ASSERT_LT((tracker.state().position_m() - mean_m).norm(), 1e-9) << i;
    ASSERT_LT((tracker.state().position_covariance_m2() - covariance_m2).norm(), 1e-9) << i;
  }
}

TEST(PlanarTracker, MovesByTheModelAndLinearisesIt) {
  PlanarTracker tracker = wandering_tracker(gaussian_options());
  tracker.add(step_of(6.0, 6.7, 0.9, 2.1));
  const PlanarTransition& last = tracker.history().back();
  const Vector2 pdr_m = testing::rotation(2.1) * Vector2(0.9, 0.0);
  const double kept = std::exp(-0.7 / 15.0);
  const auto model = [&](const PlanarVector& state) { return testing::moved(state, pdr_m, kept); };
  EXPECT_LT((last.predicted.mean - model(last.filtered.mean)).norm(), 1e-9);
  const auto numeric = testing::numeric_jacobian<6>(model, last.filtered.mean);
  EXPECT_LT((last.transition - numeric).norm(), 1e-8);
}

TEST(PlanarTracker, PutsStepNoiseAlongAndAcrossTheWayWalked) {
  PlanarTracker tracker = wandering_tracker(gaussian_options());
  tracker.add(step_of(6.0, 6.7, 0.9, 2.1, 0.1, 0.3));
  const PlanarTransition& last = tracker.history().back();
  const PlanarMatrix noise = last.predicted.covariance - last.transition *
                                                             last.filtered.covariance *
                                                             last.transition.transpose();
  const Vector2 way_m =
      testing::walked(testing::rotation(2.1) * Vector2(0.9, 0.0), last.filtered.mean);
  const double walk_m2 = 0.2 * 0.2 * 0.7;
  const Vector2 along = way_m.normalized();
  const Vector2 across(-along.y(), along.x());
  const Matrix2 position_m2 = noise.topLeftCorner<2, 2>();
  EXPECT_NEAR(along.dot(position_m2 * along), 0.1 * 0.1 + walk_m2, 1e-9);
  EXPECT_NEAR(across.dot(position_m2 * across), std::pow(0.3 * way_m.norm(), 2) + walk_m2, 1e-9);
  EXPECT_NEAR(along.dot(position_m2 * across), 0.0, 1e-9);
  EXPECT_NEAR(noise(2, 2), 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(noise(3, 3), 0.003 * 0.003, 1e-12);
  EXPECT_NEAR(noise(4, 4), 9.0 * (1.0 - std::exp(-1.4 / 15.0)), 1e-9);
}

/// The whole update against a filter whose measurement matrix comes from differences, for a scan
/// that is delivered `delay_s` after it was measured.
void expect_textbook_update(double delay_s) {
  PlanarTracker tracker = wandering_tracker(gaussian_options());
  PlanarMeasurement scan = scan_of(6.0, {9.0, 14.0}, 2.0, delay_s);
  scan.covariance_m2(0, 1) = scan.covariance_m2(1, 0) = 0.7;
  tracker.add(scan);
  const PlanarState& before = tracker.history().back().predicted;
  const Vector2 since_m = tracker.records().back().pdr_since_m;
  const auto model = [&](const PlanarVector& state) { return testing::scanned(state, since_m); };
  const auto numeric = testing::numeric_jacobian<2>(model, before.mean);
  const Matrix2 innovation_m2 =
      numeric * before.covariance * numeric.transpose() + scan.covariance_m2;
  const Eigen::Matrix<double, 6, 2> gain =
      before.covariance * numeric.transpose() * innovation_m2.inverse();
  const PlanarVector mean = before.mean + gain * (scan.position_m - model(before.mean));
  const PlanarMatrix covariance = before.covariance - gain * innovation_m2 * gain.transpose();
  EXPECT_LT((tracker.state().mean - mean).norm(), 1e-8);
  EXPECT_LT((tracker.state().covariance - covariance).norm(), 1e-8);
}

TEST(PlanarTracker, UpdatesAsTheTextbookWithANumericJacobian) { expect_textbook_update(0.0); }

TEST(PlanarTracker, UpdatesByADelayedScanAsTheTextbookWithANumericJacobian) {
  expect_textbook_update(2.3);
}

TEST(PlanarTracker, PlacesADelayedScanWhereItWasMeasuredAndWalksOnFromThere) {
  PlanarTracker tracker(position_only_options(), /*keep_history=*/true);
  tracker.start(at_s(0.0), {0.0, 0.0}, 1e5);
  tracker.add(step_of(0.0, 0.5, 1.0, 0.0));
  tracker.add(step_of(0.5, 1.0, 2.0, 0.0));
  tracker.add(step_of(1.5, 2.0, 4.0, 0.5 * std::acos(-1.0)));  // Half a second of standing first.
  // Measured halfway through the second step: one metre of it and the four northwards follow.
  tracker.add(scan_of(2.0, {100.0, 50.0}, 1.0, /*delay_s=*/1.25));
  const Vector2 since_m = tracker.records().back().pdr_since_m;
  EXPECT_NEAR(since_m.x(), 1.0, 1e-9);
  EXPECT_NEAR(since_m.y(), 4.0, 1e-9);
  EXPECT_NEAR(tracker.state().position_m().x(), 101.0, 1e-4);
  EXPECT_NEAR(tracker.state().position_m().y(), 54.0, 1e-4);
}

TEST(PlanarTracker, TakesAScanMeasuredWhileStandingFromTheEndOfTheStepBefore) {
  PlanarTracker tracker(position_only_options(), /*keep_history=*/true);
  tracker.start(at_s(0.0), {0.0, 0.0}, 1e5);
  tracker.add(step_of(0.0, 0.5, 1.0, 0.0));
  tracker.add(step_of(5.0, 5.5, 2.0, 0.0));
  tracker.add(scan_of(5.5, {0.0, 0.0}, 1.0, /*delay_s=*/3.0));
  EXPECT_NEAR(tracker.records().back().pdr_since_m.x(), 2.0, 1e-9);
}

TEST(PlanarTracker, WeighsByStudentsFormulaWhenThePositionIsKnown) {
  PlanarTracker::Options options = robust_options();
  options.radio_bias_sigma_m = 1e-6;
  options.radio_sigma_scale = 2.0;
  for (const double off_m : {0.0, 3.0, 6.0, 50.0}) {
    PlanarTracker tracker(options, false);
    tracker.start(at_s(0.0), {1.0, 1.0}, 1e-6);
    const double weight = tracker.add(scan_of(0.0, {1.0 + off_m, 1.0}, 3.0));
    // Sigma 3 m twice over: 6 m.
    EXPECT_NEAR(weight, 6.0 / (4.0 + off_m * off_m / 36.0), 1e-6) << off_m;
  }
}

TEST(PlanarTracker, FindsTheVariationalWeight) {
  // All isotropic, so one axis tells: prior variance p (position and bias), noise r, residual d.
  const PlanarTracker::Options options = robust_options();
  const double p_m2 = 4.0 + 9.0;
  const double r_m2 = 25.0;
  for (const double off_m : {1.0, 8.0, 20.0}) {
    PlanarTracker tracker(options, false);
    tracker.start(at_s(0.0), {0.0, 0.0}, 2.0);
    const double weight = tracker.add(scan_of(0.0, {0.0, off_m}, 5.0));
    double expected = 1.0;
    for (int i = 0; i < 200; ++i) {
      const double left = (r_m2 / expected) / (p_m2 + r_m2 / expected);
      const double square = (left * left * off_m * off_m + 2.0 * left * p_m2) / r_m2;
      expected = 6.0 / (4.0 + square);
    }
    EXPECT_NEAR(weight, expected, 0.01) << off_m;
  }
}

TEST(PlanarTracker, DoubtsAScanTheMoreTheFartherItIsOff) {
  double last_weight = std::numeric_limits<double>::infinity();
  for (double off_m = 0.0; off_m < 100.0; off_m += 5.0) {
    PlanarTracker tracker(robust_options(), false);
    tracker.start(at_s(0.0), {0.0, 0.0}, 3.0);
    const double weight = tracker.add(scan_of(0.0, {off_m, 0.0}, 4.0));
    EXPECT_LT(weight, last_weight) << off_m;
    EXPECT_GT(weight, 0.0);
    last_weight = weight;
  }
  EXPECT_LT(last_weight, 0.05);
}

TEST(PlanarTracker, MovesLessForAFarOutlierThanAGaussianFilterWould) {
  const auto moved_m = [](const PlanarTracker::Options& options) {
    PlanarTracker tracker(options, false);
    tracker.start(at_s(0.0), {0.0, 0.0}, 3.0);
    tracker.add(scan_of(0.0, {70.0, 0.0}, 4.0));
    return tracker.state().position_m().x();
  };
  // Gaussian in closed form: 9 / (9 + 9 + 16) of the way.
  EXPECT_NEAR(moved_m(gaussian_options()), 70.0 * 9.0 / 34.0, 1e-6);
  EXPECT_LT(moved_m(robust_options()), 0.15 * moved_m(gaussian_options()));
  EXPECT_GT(moved_m(robust_options()), 0.0);
}

TEST(PlanarTracker, UsesAGivenWeightAsItIs) {
  PlanarTracker tracker(robust_options(), false);
  tracker.start(at_s(0.0), {0.0, 0.0}, 3.0);
  EXPECT_EQ(tracker.add(scan_of(0.0, {70.0, 0.0}, 4.0), 0.5), 0.5);
  EXPECT_NEAR(tracker.state().position_m().x(), 70.0 * 9.0 / (9.0 + 9.0 + 16.0 / 0.5), 1e-9);
}

TEST(PlanarTracker, LetsTheRadioBiasDecayExponentially) {
  PlanarTracker tracker = wandering_tracker(gaussian_options());
  const PlanarState before = tracker.state();
  tracker.add(step_of(6.0, 6.0 + 15.0, 0.0, 0.0));
  const double kept = std::exp(-1.0);
  EXPECT_LT((tracker.state().mean.tail<2>() - kept * before.mean.tail<2>()).norm(), 1e-9);
  EXPECT_NEAR(tracker.state().covariance(4, 4),
              kept * kept * before.covariance(4, 4) + (1.0 - kept * kept) * 9.0, 1e-9);
  EXPECT_LT((tracker.state().position_m() - before.position_m()).norm(), 1e-12);
}

TEST(PlanarTracker, StartsAtTheFirstScanAndIgnoresStepsBefore) {
  PlanarTracker tracker(gaussian_options(), false);
  tracker.add(step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_FALSE(tracker.started());
  tracker.add(scan_of(3.0, {12.0, -4.0}, 5.0));
  ASSERT_TRUE(tracker.started());
  EXPECT_LT((tracker.state().position_m() - Vector2(12.0, -4.0)).norm(), 1e-9);
  // Prior 20 m around the scan, the scan's noise 5 m and its bias 3 m.
  EXPECT_NEAR(tracker.state().covariance(0, 0), 400.0 - 400.0 * 400.0 / (400.0 + 25.0 + 9.0), 1e-9);
}

TEST(PlanarTracker, LearnsTheHeadingOffsetAndTheScale) {
  PlanarTracker::Options options = gaussian_options();
  options.heading_offset_sigma_rad = 0.3;
  options.log_scale_sigma = 0.1;
  options.radio_bias_sigma_m = 0.01;
  PlanarTracker tracker(options, false);
  tracker.start(at_s(0.0), {0.0, 0.0}, 1.0);
  Vector2 place_m(0.0, 0.0);
  for (int i = 0; i < 120; ++i) {
    const double heading_rad = 0.5 * std::acos(-1.0) * (i / 20);
    tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, heading_rad, 0.01, 0.01));
    place_m += 1.1 * 0.7 * Vector2(std::cos(heading_rad + 0.3), std::sin(heading_rad + 0.3));
    if (i % 4 == 3) tracker.add(scan_of(0.5 * (i + 1), place_m, 0.5));
  }
  EXPECT_NEAR(tracker.state().mean(2), 0.3, 0.01);
  EXPECT_NEAR(tracker.state().mean(3), std::log(1.1), 0.01);
  EXPECT_LT((tracker.state().position_m() - place_m).norm(), 0.1);
}

TEST(PlanarTracker, GrowsDoubtWhenLostAndRecoversFromAStartFarOff) {
  PlanarTracker tracker(robust_options(), /*keep_history=*/true);
  tracker.start(at_s(0.0), {80.0, 0.0}, 2.0);
  double widest_m2 = 0.0;
  int scans = 0;
  while (tracker.state().position_m().norm() > 5.0 && scans < 15) {
    ++scans;
    tracker.add(scan_of(3.0 * scans, {0.0, 0.0}, 3.0));
    widest_m2 = std::max(widest_m2, tracker.state().covariance(0, 0));
  }
  // Doubted scans pull the mean weight, 0.8 of it kept each time, below a quarter after seven; a
  // few more then carry the place over.
  EXPECT_GT(scans, 7);
  EXPECT_LE(scans, 12);
  EXPECT_GT(widest_m2, 15.0 * 15.0);
}

TEST(PlanarTracker, AnswersInMidStepWithAtMostOneStepMore) {
  PlanarTracker tracker(position_only_options(), false);
  tracker.start(at_s(0.0), {0.0, 0.0}, 1.0);
  tracker.add(step_of(0.0, 0.5, 0.8, 0.0));
  EXPECT_NEAR(tracker.at(at_s(0.5)).position_m().x(), 0.8, 1e-12);
  EXPECT_NEAR(tracker.at(at_s(0.75)).position_m().x(), 1.2, 1e-9);
  EXPECT_NEAR(tracker.at(at_s(1.0)).position_m().x(), 1.6, 1e-9);
  EXPECT_NEAR(tracker.at(at_s(1.4)).position_m().x(), 1.6, 1e-9);
  // Two steps' time without a step: stood still after the last one.
  EXPECT_NEAR(tracker.at(at_s(1.6)).position_m().x(), 0.8, 1e-12);
  EXPECT_NEAR(tracker.at(at_s(60.0)).position_m().x(), 0.8, 1e-12);
}

TEST(PlanarTracker, GrowsDoubtWhileNothingIsHeard) {
  PlanarTracker tracker(position_only_options(), false);
  tracker.start(at_s(0.0), {0.0, 0.0}, 1.0);
  EXPECT_NEAR(tracker.at(at_s(25.0)).covariance(0, 0), 1.0 + 0.2 * 0.2 * 25.0, 1e-9);
  EXPECT_EQ(tracker.at(at_s(25.0)).time, at_s(25.0));
}

TEST(PlanarTracker, RejectsOptionsThatMakeNoSense) {
  EXPECT_TRUE(PlanarTracker::Options{}.validate());
  EXPECT_TRUE(robust_options().validate());
  const std::vector<double PlanarTracker::Options::*> positive = {
      &PlanarTracker::Options::start_sigma_m,
      &PlanarTracker::Options::heading_offset_sigma_rad,
      &PlanarTracker::Options::log_scale_sigma,
      &PlanarTracker::Options::position_walk_m_per_sqrt_s,
      &PlanarTracker::Options::radio_bias_sigma_m,
      &PlanarTracker::Options::radio_bias_tau_s,
      &PlanarTracker::Options::radio_sigma_scale,
      &PlanarTracker::Options::radio_degrees_of_freedom};
  for (std::size_t i = 0; i < positive.size(); ++i) {
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
      PlanarTracker::Options options = robust_options();
      options.*positive[i] = bad;
      const auto valid = options.validate();
      ASSERT_FALSE(valid) << i;
      EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
    }
  }
  PlanarTracker::Options options = robust_options();
  options.lost_weight_ratio = 1.0;
  EXPECT_FALSE(options.validate());
}

}  // namespace
}  // namespace waylode::fusion
