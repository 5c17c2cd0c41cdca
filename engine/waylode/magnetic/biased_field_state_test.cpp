// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/biased_field_state.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace waylode::magnetic {
namespace {

using core::Vector2;

constexpr double kUncapped = 1e6;

double log_normal(double residual, double variance) {
  return -0.5 * (residual * residual / variance + std::log(2.0 * std::numbers::pi * variance));
}

TEST(BiasedFieldState, WeighsByTheNormalDensityWithoutABias) {
  BiasedFieldState state;
  const double told = state.update({27.0, -38.0}, {Vector2(24.0, -40.0), Vector2(4.0, 9.0)},
                                   {.power = 1.0, .cap_sigmas = kUncapped});
  EXPECT_NEAR(told, log_normal(3.0, 4.0) + log_normal(2.0, 9.0), 1e-12);
  EXPECT_EQ(state.mean_ut, Vector2(0.0, 0.0));
  EXPECT_EQ(state.variance_ut2, Vector2(0.0, 0.0));
}

TEST(BiasedFieldState, IntegratesTheBiasOutAndLearnsIt) {
  BiasedFieldState state{Vector2(1.0, -2.0), Vector2(12.0, 3.0)};
  const double told = state.update({29.0, -41.0}, {Vector2(24.0, -40.0), Vector2(4.0, 9.0)},
                                   {.power = 1.0, .cap_sigmas = kUncapped});
  EXPECT_NEAR(told, log_normal(4.0, 16.0) + log_normal(1.0, 12.0), 1e-12);
  // Gains 12/16 and 3/12 of residuals 4 and 1.
  EXPECT_NEAR(state.mean_ut.x(), 4.0, 1e-12);
  EXPECT_NEAR(state.mean_ut.y(), -1.75, 1e-12);
  EXPECT_NEAR(state.variance_ut2.x(), 3.0, 1e-12);
  EXPECT_NEAR(state.variance_ut2.y(), 2.25, 1e-12);
}

TEST(BiasedFieldState, MeetsTheIntegralOverTheBias) {
  BiasedFieldState state{Vector2(1.0, 0.0), Vector2(5.0, 0.0)};
  const double power = 0.3;
  const double told = state.update({26.0, -40.0}, {Vector2(22.0, -40.0), Vector2(2.5, 1.0)},
                                   {.power = power, .cap_sigmas = kUncapped});
  double integral = 0.0;
  const double step = 1e-3;
  for (double bias = -30.0; bias < 32.0; bias += step) {
    integral +=
        step * std::exp(log_normal(bias - 1.0, 5.0) + power * log_normal(26.0 - 22.0 - bias, 2.5));
  }
  EXPECT_NEAR(told, std::log(integral) + power * log_normal(0.0, 1.0), 1e-6);
}

RC_GTEST_PROP(BiasedFieldState, IsTheLeastSquaresOfAllReadings, ()) {
  BiasedFieldState state{Vector2(0.7, -1.1), Vector2(9.0, 4.0)};
  Vector2 information = state.variance_ut2.cwiseInverse();
  Vector2 weighed = information.cwiseProduct(state.mean_ut);
  const int count = *rc::gen::inRange(1, 20);
  for (int i = 0; i < count; ++i) {
    const auto number = [](int low, int high) { return 0.1 * *rc::gen::inRange(low, high); };
    const double power = number(1, 11);
    const Vector2 residual(number(-80, 80), number(-80, 80));
    const FieldExpectation expected{Vector2(31.0, -37.0), Vector2(number(5, 200), number(5, 200))};
    state.update({31.0 + residual.x(), -37.0 + residual.y()}, expected,
                 {.power = power, .cap_sigmas = kUncapped});
    information += power * expected.variance_ut2.cwiseInverse();
    weighed += power * residual.cwiseQuotient(expected.variance_ut2);
  }
  RC_ASSERT((state.variance_ut2 - information.cwiseInverse()).norm() < 1e-9);
  RC_ASSERT((state.mean_ut - weighed.cwiseQuotient(information)).norm() < 1e-9);
}

RC_GTEST_PROP(BiasedFieldState, ToldInAnyOrderSaysTheSame, ()) {
  struct Told {
    LevelField field;
    FieldExpectation expected;
  };
  std::vector<Told> all;
  const int count = *rc::gen::inRange(2, 12);
  for (int i = 0; i < count; ++i) {
    const double v = 0.1 * *rc::gen::inRange(20, 300);
    all.push_back({{30.0 + *rc::gen::inRange(-9, 9), -40.0 + *rc::gen::inRange(-9, 9)},
                   {Vector2(29.0, -38.0), Vector2(v, 2.0 * v)}});
  }
  const ReadingWeight weight{.power = 0.4, .cap_sigmas = kUncapped};
  BiasedFieldState forth{Vector2::Zero(), Vector2(12.0, 7.0)};
  BiasedFieldState back = forth;
  double sum_forth = 0.0;
  double sum_back = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Told& last = all[all.size() - 1 - i];
    sum_forth += forth.update(all[i].field, all[i].expected, weight);
    sum_back += back.update(last.field, last.expected, weight);
  }
  RC_ASSERT(std::abs(sum_forth - sum_back) < 1e-9);
  RC_ASSERT((forth.mean_ut - back.mean_ut).norm() < 1e-9);
}

TEST(BiasedFieldState, CapsAWildReadingAndLearnsNothingFromIt) {
  const ReadingWeight weight{.power = 0.25, .cap_sigmas = 3.0};
  const FieldExpectation expected{Vector2(24.0, -40.0), Vector2(5.0, 9.0)};
  BiasedFieldState wild{Vector2(1.0, 0.0), Vector2(4.0, 0.0)};
  BiasedFieldState wilder = wild;
  // Own sigma 3: capped 9 off, that is from 34.
  const double told = wild.update({34.5, -40.0}, expected, weight);
  EXPECT_EQ(told, wilder.update({4000.0, -40.0}, expected, weight));
  EXPECT_EQ(wild.mean_ut, Vector2(1.0, 0.0));
  EXPECT_EQ(wild.variance_ut2, Vector2(4.0, 0.0));
  // Tempered variance 20, with the bias 24; at the cap 9^2.
  EXPECT_NEAR(
      told,
      -0.5 * (81.0 / 24.0 + std::log(24.0 / 20.0) + 0.25 * std::log(2.0 * std::numbers::pi * 5.0)) +
          0.25 * log_normal(0.0, 9.0),
      1e-12);
  BiasedFieldState inside{Vector2(1.0, 0.0), Vector2(4.0, 0.0)};
  EXPECT_GT(inside.update({33.9, -40.0}, expected, weight), told);
  EXPECT_GT(inside.mean_ut.x(), 1.0);
}

TEST(BiasedFieldState, PassesOverAFieldThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BiasedFieldState state{Vector2(1.0, -2.0), Vector2(12.0, 3.0)};
    EXPECT_EQ(state.update({bad, -40.0}, {}, {}), 0.0);
    EXPECT_EQ(state.update({20.0, -bad}, {}, {}), 0.0);
    EXPECT_EQ(state.mean_ut, Vector2(1.0, -2.0));
    EXPECT_EQ(state.variance_ut2, Vector2(12.0, 3.0));
  }
}

}  // namespace
}  // namespace waylode::magnetic
