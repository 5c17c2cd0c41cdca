// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/stride_model.hpp"

#include <gtest/gtest.h>

#include <limits>

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

TEST(StrideModel, RefusesOptionsOutOfRange) {
  using Options = StrideModel::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.swing_gain = -0.1}.validate());
  EXPECT_FALSE(Options{.swing_gain = std::numeric_limits<double>::quiet_NaN()}.validate());
  EXPECT_FALSE(Options{.shortest_m = 0.0}.validate());
  EXPECT_FALSE((Options{.shortest_m = 0.7, .longest_m = 0.7}.validate()));
}

}  // namespace
}  // namespace waylode::pdr
