// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/decision_flow.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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
using testing::scan_of;
using testing::step_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

DecisionFlow::Options options(DecisionMode mode) {
  DecisionFlow::Options result;
  result.mode = mode;
  result.threshold_m = 2.0;
  result.pairs = 3;
  result.literal_gain_ratio = 0.5;
  // Heading and scale known: a mean over doubtful ones would shorten the way.
  result.filter.heading_offset_sigma_rad = result.filter.log_scale_sigma = 0.0;
  result.filter.heading_offset_walk_rad_per_sqrt_step = 0.0;
  result.filter.log_scale_walk_per_sqrt_step = 0.0;
  return result;
}

DecisionFlow walked_east(DecisionMode mode, int steps) {
  DecisionFlow flow(options(mode));
  flow.add(scan_of(0.0, {10.0, 5.0}, 2.0));
  for (int i = 0; i < steps; ++i) flow.add(step_of(0.5 * i, 0.5 * (i + 1), 0.8, 0.0, 0.1, 0.0));
  return flow;
}

TEST(DecisionFlow, StartsAtTheFirstFixAndWalks) {
  for (const auto mode :
       {DecisionMode::kEveryFix, DecisionMode::kOnlyWhenLarge, DecisionMode::kWuLiteral}) {
    DecisionFlow flow(options(mode));
    EXPECT_FALSE(flow.add(step_of(-1.0, -0.5, 0.8, 0.0)));
    EXPECT_FALSE(flow.started());
    ASSERT_TRUE(flow.add(scan_of(0.0, {10.0, 5.0}, 2.0)));
    ASSERT_TRUE(flow.started());
    EXPECT_TRUE(flow.add(step_of(0.0, 0.5, 0.8, 0.0)));
    EXPECT_LT((flow.at(at_s(0.5)).position_m - Vector2(10.8, 5.0)).norm(), 1e-6);
  }
}

TEST(DecisionFlow, KeepsThePdrPositionWhenTheDifferenceIsSmall) {
  for (const auto mode : {DecisionMode::kOnlyWhenLarge, DecisionMode::kWuLiteral}) {
    DecisionFlow flow = walked_east(mode, 5);
    const auto comparison = flow.add(scan_of(2.5, {14.0, 6.9}, 1.0));
    ASSERT_TRUE(comparison);
    EXPECT_NEAR(comparison->difference_m, 1.9, 1e-6);
    EXPECT_FALSE(comparison->corrected);
    EXPECT_LT((flow.at(at_s(2.5)).position_m - Vector2(14.0, 5.0)).norm(), 1e-6);
  }
}

TEST(DecisionFlow, CorrectsByTheFilterWhenTheDifferenceIsLarge) {
  DecisionFlow flow = walked_east(DecisionMode::kOnlyWhenLarge, 5);
  const auto comparison = flow.add(scan_of(2.5, {14.0, 8.0}, 1.0));
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->difference_m, 3.0, 1e-6);
  EXPECT_TRUE(comparison->corrected);
  EXPECT_GT(flow.at(at_s(2.5)).position_m.y(), 5.5);
  EXPECT_LT(flow.at(at_s(2.5)).position_m.y(), 8.0);
}

TEST(DecisionFlow, EqualsItsFilterWhenEveryFixCounts) {
  DecisionFlow flow = walked_east(DecisionMode::kEveryFix, 5);
  StepPositionFilter filter(options(DecisionMode::kEveryFix).filter);
  filter.add(scan_of(0.0, {10.0, 5.0}, 2.0));
  for (int i = 0; i < 5; ++i) filter.add(step_of(0.5 * i, 0.5 * (i + 1), 0.8, 0.0, 0.1, 0.0));
  const auto comparison = flow.add(scan_of(2.5, {14.5, 5.5}, 1.0));
  filter.add(scan_of(2.5, {14.5, 5.5}, 1.0));
  ASSERT_TRUE(comparison);
  EXPECT_TRUE(comparison->corrected);
  EXPECT_EQ(flow.at(at_s(3.0)), filter.at(at_s(3.0)));
}

TEST(DecisionFlow, ShiftsByHalfTheMeanDifferenceOfTheLastPairsInTheLiteralForm) {
  DecisionFlow flow = walked_east(DecisionMode::kWuLiteral, 5);
  // Walked to (14, 5). Three pairs are kept; the first falls out.
  flow.add(scan_of(2.5, {14.0, 5.3}, 1.0));
  flow.add(scan_of(2.5, {15.0, 5.0}, 1.0));
  flow.add(scan_of(2.5, {14.0, 6.5}, 1.0));
  EXPECT_LT((flow.at(at_s(2.5)).position_m - Vector2(14.0, 5.0)).norm(), 1e-9);
  const Matrix2 walked_m2 = flow.at(at_s(2.5)).covariance_m2;
  const auto comparison = flow.add(scan_of(2.5, {14.0, 9.5}, 3.0));
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->difference_m, 4.5, 1e-9);
  EXPECT_TRUE(comparison->corrected);
  // Differences (1, 0), (0, 1.5), (0, 4.5): mean (1/3, 2), half of it.
  EXPECT_LT((flow.at(at_s(2.5)).position_m - Vector2(14.0 + 1.0 / 6.0, 6.0)).norm(), 1e-9);
  EXPECT_LT(
      (flow.at(at_s(2.5)).covariance_m2 - (0.25 * walked_m2 + 0.25 * 9.0 * Matrix2::Identity()))
          .norm(),
      1e-9);
  // The kept differences were shifted, too: (5/6, -1), (-1/6, 0.5), (-1/6, 3.5); the next pair is
  // (-1/6, 2.5), and the oldest goes: mean (-1/6, 6.5 / 3).
  ASSERT_TRUE(flow.add(scan_of(2.5, {14.0, 8.5}, 3.0))->corrected);
  EXPECT_LT((flow.at(at_s(2.5)).position_m - Vector2(14.0 + 1.0 / 12.0, 6.0 + 6.5 / 6.0)).norm(),
            1e-9);
}

TEST(DecisionFlow, ComparesADelayedFixWithWhereTheWalkerWas) {
  for (const auto mode : {DecisionMode::kOnlyWhenLarge, DecisionMode::kWuLiteral}) {
    DecisionFlow flow = walked_east(mode, 10);
    const auto comparison = flow.add(scan_of(5.0, {14.0, 5.0}, 1.0, /*delay_s=*/2.5));
    ASSERT_TRUE(comparison);
    EXPECT_NEAR(comparison->difference_m, 0.0, 1e-6);
  }
}

TEST(DecisionFlow, PassesOverWhatItCannotUse) {
  for (const auto mode : {DecisionMode::kEveryFix, DecisionMode::kWuLiteral}) {
    DecisionFlow flow = walked_east(mode, 5);
    ASSERT_TRUE(flow.add(scan_of(3.0, {14.0, 5.0}, 1.0)));
    const PlanarEstimate before = flow.at(at_s(4.0));
    EXPECT_FALSE(flow.add(scan_of(4.0, {kNan, 5.0}, 1.0)));
    EXPECT_FALSE(flow.add(scan_of(4.0, {40.0, 5.0}, 0.0)));
    EXPECT_FALSE(flow.add(scan_of(2.9, {40.0, 5.0}, 1.0)));
    EXPECT_FALSE(flow.add(step_of(3.0, 3.5, kNan, 0.0)));
    EXPECT_FALSE(flow.add(step_of(1.0, 1.5, 0.7, 0.0)));
    EXPECT_EQ(flow.at(at_s(4.0)), before);
  }
}

RC_GTEST_PROP(DecisionFlow, KeepsItsCovarianceValid, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  DecisionFlow flow(options(static_cast<DecisionMode>(rng.below(3))));
  double now_s = 0.0;
  for (int i = 0; i < 80; ++i) {
    const double begin_s = now_s;
    now_s += rng.uniform(0.0, 1.0);
    if (rng.below(2) == 0) {
      flow.add(step_of(begin_s, now_s, rng.uniform(0.0, 1.2), rng.uniform(-3.1, 3.1), 0.0, 0.0));
    } else {
      flow.add(scan_of(now_s, {rng.normal(0.0, 9.0), rng.normal(0.0, 9.0)}, rng.uniform(0.01, 9.0),
                       rng.uniform(0.0, 4.0)));
    }
    if (!flow.started()) continue;
    RC_ASSERT(flow.at(at_s(now_s)).position_m.allFinite());
    RC_ASSERT(core::is_valid_covariance(flow.at(at_s(now_s)).covariance_m2));
  }
}

TEST(DecisionFlow, RejectsOptionsThatMakeNoSense) {
  EXPECT_TRUE(DecisionFlow::Options{}.validate());
  auto wrong = options(DecisionMode::kWuLiteral);
  wrong.threshold_m = -1.0;
  EXPECT_FALSE(wrong.validate());
  wrong.threshold_m = kNan;
  EXPECT_FALSE(wrong.validate());
  for (const int bad : {0, -1, 1001}) {
    wrong = options(DecisionMode::kWuLiteral);
    wrong.pairs = bad;
    EXPECT_FALSE(wrong.validate());
  }
  for (const double bad : {-0.1, 1.1, kNan}) {
    wrong = options(DecisionMode::kWuLiteral);
    wrong.literal_gain_ratio = bad;
    EXPECT_FALSE(wrong.validate());
  }
  wrong = options(DecisionMode::kEveryFix);
  wrong.filter.radio_sigma_scale = 0.0;
  EXPECT_FALSE(wrong.validate());
}

}  // namespace
}  // namespace waylode::fusion
