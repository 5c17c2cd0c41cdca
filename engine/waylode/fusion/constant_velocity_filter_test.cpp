// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/constant_velocity_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using testing::at_s;
using State = ConstantVelocityFilter::State;
using Covariance = ConstantVelocityFilter::Covariance;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ConstantVelocityFilter::Options options() {
  ConstantVelocityFilter::Options result;
  result.acceleration_variance_m2ps4 = 0.5;
  result.start_speed_sigma_mps = 1.5;
  return result;
}

PlanarEstimate place(double time_s, double x_m, double y_m, double variance_m2) {
  return {at_s(time_s), {x_m, y_m}, variance_m2 * Matrix2::Identity()};
}

TEST(ConstantVelocityFilter, MovesAndDoubtsByItsModel) {
  Covariance transition = Covariance::Identity();
  transition(0, 2) = transition(1, 3) = 0.4;
  EXPECT_EQ(constant_velocity_transition(0.4), transition);
  // 2 [dt^4 / 4, dt^3 / 2; dt^3 / 2, dt^2] per axis, dt = 0.4.
  const Covariance noise = white_acceleration_noise(2.0, 0.4);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(noise(axis, axis), 0.0128, 1e-15);
    EXPECT_NEAR(noise(axis, axis + 2), 0.064, 1e-15);
    EXPECT_NEAR(noise(axis + 2, axis), 0.064, 1e-15);
    EXPECT_NEAR(noise(axis + 2, axis + 2), 0.32, 1e-15);
  }
  EXPECT_EQ(noise(0, 1), 0.0);
  EXPECT_EQ(noise(0, 3), 0.0);
}

TEST(ConstantVelocityFilter, FollowsItsFirstPositionInClosedForm) {
  ConstantVelocityFilter filter(options());
  filter.start(place(1.0, 3.0, -2.0, 4.0));
  // After 2 s: variance 4 + 2^2 1.5^2 + 0.5 * 4 = 15; with the speed 2 * 2.25 + 0.5 * 4 = 6.5.
  const auto chi_square = filter.add(place(3.0, 8.0, -2.0, 5.0));
  ASSERT_TRUE(chi_square);
  EXPECT_NEAR(*chi_square, 25.0 / 20.0, 1e-12);
  EXPECT_NEAR(filter.mean()(0), 3.0 + 5.0 * 15.0 / 20.0, 1e-12);
  EXPECT_NEAR(filter.mean()(2), 5.0 * 6.5 / 20.0, 1e-12);
  EXPECT_NEAR(filter.mean()(1), -2.0, 1e-12);
  EXPECT_NEAR(filter.mean()(3), 0.0, 1e-12);
  EXPECT_NEAR(filter.covariance()(0, 0), 15.0 * 5.0 / 20.0, 1e-12);
  EXPECT_NEAR(filter.covariance()(2, 2), 2.25 + 2.0 - 6.5 * 6.5 / 20.0, 1e-12);
  EXPECT_EQ(filter.time(), at_s(3.0));
}

TEST(ConstantVelocityFilter, TakesPositionsAndVelocitiesTogether) {
  ConstantVelocityFilter filter(options());
  filter.start(place(0.0, 0.0, 0.0, 1.0));
  const State measured(2.0, 1.0, 0.9, -0.6);
  const Covariance noise = Eigen::Vector4d(1.0, 3.0, 0.75, 2.25).asDiagonal();
  const auto chi_square = filter.add(at_s(0.0), measured, noise);
  ASSERT_TRUE(chi_square);
  EXPECT_NEAR(*chi_square, 4.0 / 2.0 + 1.0 / 4.0 + 0.81 / 3.0 + 0.36 / 4.5, 1e-12);
  EXPECT_NEAR(filter.mean()(0), 1.0, 1e-12);
  EXPECT_NEAR(filter.mean()(1), 0.25, 1e-12);
  EXPECT_NEAR(filter.mean()(2), 0.9 * 2.25 / 3.0, 1e-12);
  EXPECT_NEAR(filter.mean()(3), -0.3, 1e-12);
}

/// Equals the textbook filter, both measurement models in turn, at irregular times.
RC_GTEST_PROP(ConstantVelocityFilter, EqualsTheTextbookFilter, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  ConstantVelocityFilter filter(options());
  filter.start(place(0.0, 1.0, 2.0, 6.0));
  State mean(1.0, 2.0, 0.0, 0.0);
  Covariance covariance = Eigen::Vector4d(6.0, 6.0, 2.25, 2.25).asDiagonal();
  double now_s = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double dt_s = rng.below(4) == 0 ? 0.0 : rng.uniform(0.0, 3.0);
    now_s += dt_s;
    const double exact_s = core::to_seconds(at_s(now_s) - filter.time());
    Covariance a = Covariance::Identity();
    a(0, 2) = a(1, 3) = exact_s;
    Covariance q = Covariance::Zero();
    for (int axis = 0; axis < 2; ++axis) {
      q(axis, axis) = 0.5 * std::pow(exact_s, 4) / 4.0;
      q(axis, axis + 2) = q(axis + 2, axis) = 0.5 * std::pow(exact_s, 3) / 2.0;
      q(axis + 2, axis + 2) = 0.5 * exact_s * exact_s;
    }
    mean = (a * mean).eval();
    covariance = (a * covariance * a.transpose() + q).eval();
    const State measured(rng.normal(0.0, 9.0), rng.normal(0.0, 9.0), rng.normal(), rng.normal());
    if (rng.below(2) == 0) {
      const Matrix2 r = Vector2(rng.uniform(0.1, 9.0), rng.uniform(0.1, 9.0)).asDiagonal();
      const Eigen::Matrix<double, 4, 2> gain =
          covariance.leftCols<2>() * (covariance.topLeftCorner<2, 2>() + r).inverse();
      mean += gain * (measured.head<2>() - mean.head<2>()).eval();
      covariance = (covariance - gain * covariance.topRows<2>()).eval();
      RC_ASSERT(filter.add(PlanarEstimate{at_s(now_s), measured.head<2>(), r}).has_value());
    } else {
      const Covariance r = Eigen::Vector4d(2.0, 3.0, 0.2, 0.4).asDiagonal();
      const Covariance gain = covariance * (covariance + r).inverse();
      mean += gain * (measured - mean);
      covariance = ((Covariance::Identity() - gain) * covariance).eval();
      RC_ASSERT(filter.add(at_s(now_s), measured, r).has_value());
    }
    RC_ASSERT((filter.mean() - mean).norm() < 1e-7);
    RC_ASSERT((filter.covariance() - covariance).norm() < 1e-7);
    RC_ASSERT(filter.covariance().llt().info() == Eigen::Success);
    RC_ASSERT(filter.covariance() == filter.covariance().transpose());
  }
}

TEST(ConstantVelocityFilter, StatesItsErrorHonestlyOnWalksOfItsModel) {
  constexpr int kRuns = 400;
  constexpr int kFixes = 25;
  const Matrix2 noise_m2 = Vector2(2.25, 4.0).asDiagonal();
  double nees = 0.0;
  double nis = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    core::Rng rng(7000 + static_cast<std::uint64_t>(run));
    State truth(rng.normal(0.0, 3.0), rng.normal(0.0, 3.0), rng.normal(0.0, 1.5),
                rng.normal(0.0, 1.5));
    ConstantVelocityFilter filter(options());
    filter.start(place(0.0, 0.0, 0.0, 9.0));
    double now_s = 0.0;
    for (int fix = 0; fix < kFixes; ++fix) {
      const double dt_s = fix % 3 == 0 ? 1.5 : 0.5;
      now_s += dt_s;
      const Vector2 pushed_mps2(rng.normal(0.0, std::sqrt(0.5)), rng.normal(0.0, std::sqrt(0.5)));
      truth.head<2>() += dt_s * truth.tail<2>() + 0.5 * dt_s * dt_s * pushed_mps2;
      truth.tail<2>() += dt_s * pushed_mps2;
      const Vector2 fix_m = truth.head<2>() + Vector2(rng.normal(0.0, 1.5), rng.normal(0.0, 2.0));
      nis += *filter.add(PlanarEstimate{at_s(now_s), fix_m, noise_m2});
    }
    const State error = filter.mean() - truth;
    nees += error.dot(filter.covariance().ldlt().solve(error));
  }
  // 99.9 %: four degrees of freedom over 400 runs, two over 10000 innovations.
  EXPECT_NEAR(nees / kRuns, 4.0, 3.29 * std::sqrt(8.0 / kRuns));
  EXPECT_NEAR(nis / (kRuns * kFixes), 2.0, 3.29 * std::sqrt(4.0 / (kRuns * kFixes)));
}

TEST(ConstantVelocityFilter, AnswersForLaterWithoutMoving) {
  ConstantVelocityFilter filter(options());
  filter.start(place(0.0, 3.0, 4.0, 1.0));
  const PlanarEstimate later = filter.at(at_s(2.0));
  EXPECT_NEAR(later.covariance_m2(0, 0), 1.0 + 9.0 + 2.0, 1e-12);
  EXPECT_EQ(later.time, at_s(2.0));
  EXPECT_EQ(filter.time(), at_s(0.0));
}

TEST(ConstantVelocityFilter, PassesOverWhatItCannotUse) {
  ConstantVelocityFilter filter(options());
  EXPECT_FALSE(filter.add(place(0.0, 0.0, 0.0, 1.0)));
  EXPECT_FALSE(filter.add(at_s(0.0), State::Zero(), Covariance::Identity()));
  filter.start(place(5.0, 1.0, 2.0, 3.0));
  const State mean = filter.mean();
  EXPECT_FALSE(filter.add(place(4.9, 1.0, 2.0, 3.0)));
  EXPECT_FALSE(filter.add(place(6.0, kNan, 2.0, 3.0)));
  EXPECT_FALSE(filter.add(place(6.0, 1.0, 2.0, 0.0)));
  EXPECT_FALSE(filter.add(place(6.0, 1.0, 2.0, kNan)));
  EXPECT_FALSE(filter.add(at_s(4.0), State::Zero(), Covariance::Identity()));
  EXPECT_FALSE(filter.add(at_s(6.0), State(0.0, 0.0, kNan, 0.0), Covariance::Identity()));
  EXPECT_FALSE(filter.add(at_s(6.0), State::Zero(), Covariance(-Covariance::Identity())));
  EXPECT_EQ(filter.mean(), mean);
  EXPECT_EQ(filter.time(), at_s(5.0));
  EXPECT_TRUE(filter.add(place(5.0, 1.0, 2.0, 3.0)));  // A second one at the same time is fine.
}

TEST(ConstantVelocityFilter, RejectsOptionsThatMakeNoSense) {
  EXPECT_TRUE(ConstantVelocityFilter::Options{}.validate());
  for (const double bad : {0.0, -1.0, kNan}) {
    auto wrong = options();
    wrong.acceleration_variance_m2ps4 = bad;
    EXPECT_FALSE(wrong.validate());
    wrong = options();
    wrong.start_speed_sigma_mps = bad;
    EXPECT_FALSE(wrong.validate());
  }
}

}  // namespace
}  // namespace waylode::fusion
