// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/interval_weighting.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using testing::at_s;

core::Duration s(double seconds) { return core::from_seconds(seconds); }

IntervalWeighting::Options options(WeightingMode mode) {
  IntervalWeighting::Options result;
  result.mode = mode;
  result.first_interval_s = 4.0;
  result.second_interval_s = 30.0;
  result.magnetic_share_ratio = 0.7;
  result.magnetic_share_late_ratio = 0.4;
  return result;
}

PlanarEstimate place(double x_m, double y_m, double xx_m2, double yy_m2, double xy_m2 = 0.0) {
  PlanarEstimate result{at_s(7.0), {x_m, y_m}, Matrix2::Zero()};
  result.covariance_m2 << xx_m2, xy_m2, xy_m2, yy_m2;
  return result;
}

const PlanarEstimate kMagnetic = place(2.0, 10.0, 1.0, 4.0, 0.5);
const PlanarEstimate kWifi = place(12.0, 0.0, 9.0, 16.0, -2.0);

TEST(IntervalWeighting, TakesWifiAloneAtFirst) {
  for (const auto mode : {WeightingMode::kIntervalsMoreWifi, WeightingMode::kIntervalsMagnetic}) {
    const IntervalWeighting weighting(options(mode));
    for (const double since_s : {0.0, 3.999}) {
      const PlanarEstimate point = weighting.combine(s(since_s), kMagnetic, kWifi);
      EXPECT_EQ(point.position_m, kWifi.position_m);
      EXPECT_EQ(point.covariance_m2, kWifi.covariance_m2);
      EXPECT_EQ(point.time, kWifi.time);
    }
  }
}

TEST(IntervalWeighting, WeighsInTheMiddle) {
  for (const auto mode : {WeightingMode::kIntervalsMoreWifi, WeightingMode::kIntervalsMagnetic}) {
    for (const double since_s : {4.0, 29.999}) {
      const PlanarEstimate point =
          IntervalWeighting(options(mode)).combine(s(since_s), kMagnetic, kWifi);
      EXPECT_LT((point.position_m - Vector2(5.0, 7.0)).norm(), 1e-12);
      EXPECT_NEAR(point.covariance_m2(0, 0), 0.49 * 1.0 + 0.09 * 9.0, 1e-12);
      EXPECT_NEAR(point.covariance_m2(0, 1), 0.49 * 0.5 - 0.09 * 2.0, 1e-12);
    }
  }
}

TEST(IntervalWeighting, GivesWifiMoreWeightLate) {
  const PlanarEstimate point = IntervalWeighting(options(WeightingMode::kIntervalsMoreWifi))
                                   .combine(s(30.0), kMagnetic, kWifi);
  EXPECT_LT((point.position_m - Vector2(8.0, 4.0)).norm(), 1e-12);
}

TEST(IntervalWeighting, OrTakesTheMagneticPositionAloneLate) {
  const PlanarEstimate point = IntervalWeighting(options(WeightingMode::kIntervalsMagnetic))
                                   .combine(s(30.0), kMagnetic, kWifi);
  EXPECT_EQ(point.position_m, kMagnetic.position_m);
  EXPECT_EQ(point.covariance_m2, kMagnetic.covariance_m2);
}

TEST(IntervalWeighting, WeighsByInverseVariancesWhateverTheTime) {
  const IntervalWeighting weighting(options(WeightingMode::kInverseVariance));
  const PlanarEstimate magnetic = place(2.0, 10.0, 1.0, 4.0);
  const PlanarEstimate wifi = place(12.0, 0.0, 9.0, 12.0);
  for (const double since_s : {0.0, 10.0, 100.0}) {
    const PlanarEstimate point = weighting.combine(s(since_s), magnetic, wifi);
    // Along x 1 against 9: nine tenths magnetic. Along y 4 against 12: three quarters.
    EXPECT_LT((point.position_m - Vector2(3.0, 7.5)).norm(), 1e-12);
    EXPECT_NEAR(point.covariance_m2(0, 0), 0.9, 1e-12);
    EXPECT_NEAR(point.covariance_m2(1, 1), 3.0, 1e-12);
  }
}

RC_GTEST_PROP(IntervalWeighting, AddsTheInformationOfIndependentEstimates, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const auto random_place = [&] {
    const Matrix2 turn = testing::rotation(rng.uniform(-3.0, 3.0));
    const Vector2 variances_m2(std::pow(10.0, rng.uniform(-3.0, 3.0)),
                               std::pow(10.0, rng.uniform(-3.0, 3.0)));
    PlanarEstimate result{at_s(0.0), {rng.normal(0.0, 20.0), rng.normal(0.0, 20.0)}, {}};
    const Matrix2 covariance_m2 = turn * variances_m2.asDiagonal() * turn.transpose();
    result.covariance_m2 = 0.5 * (covariance_m2 + covariance_m2.transpose());
    return result;
  };
  const PlanarEstimate one = random_place();
  const PlanarEstimate other = random_place();
  const PlanarEstimate mean = inverse_variance_mean(one, other);
  RC_ASSERT(core::is_valid_covariance(mean.covariance_m2));
  const Matrix2 information = one.covariance_m2.inverse() + other.covariance_m2.inverse();
  RC_ASSERT((mean.covariance_m2 * information - Matrix2::Identity()).norm() < 1e-6);
  const Vector2 expected_m =
      information.ldlt().solve(one.covariance_m2.inverse() * one.position_m +
                               other.covariance_m2.inverse() * other.position_m);
  RC_ASSERT((mean.position_m - expected_m).norm() < 1e-6);
}

TEST(IntervalWeighting, RejectsOptionsThatMakeNoSense) {
  EXPECT_TRUE(IntervalWeighting::Options{}.validate());
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    auto wrong = options(WeightingMode::kIntervalsMoreWifi);
    wrong.magnetic_share_ratio = bad;
    EXPECT_FALSE(wrong.validate());
    wrong = options(WeightingMode::kIntervalsMoreWifi);
    wrong.magnetic_share_late_ratio = bad;
    EXPECT_FALSE(wrong.validate());
  }
  auto wrong = options(WeightingMode::kInverseVariance);
  wrong.second_interval_s = 3.0;
  EXPECT_FALSE(wrong.validate());
  wrong.second_interval_s = std::nan("");
  EXPECT_FALSE(wrong.validate());
  wrong = options(WeightingMode::kInverseVariance);
  wrong.first_interval_s = -1.0;
  EXPECT_FALSE(wrong.validate());
}

}  // namespace
}  // namespace waylode::fusion
