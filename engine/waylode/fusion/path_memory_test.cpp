// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/path_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Vector2;
using testing::at_s;
using testing::step_of;

constexpr double kNorth_rad = 1.5707963267948966;

/// Half a second 0.6 m east, half a second's pause, half a second 0.8 m north.
PathMemory corner() {
  PathMemory path;
  path.add(step_of(1.0, 1.5, 0.6, 0.0));
  path.add(step_of(2.0, 2.5, 0.8, kNorth_rad));
  return path;
}

TEST(PathMemory, LeadsBackAlongTheWay) {
  const PathMemory path = corner();
  EXPECT_LT((path.offset_m(at_s(2.5)) - Vector2(0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((path.offset_m(at_s(2.25)) - Vector2(0.0, -0.4)).norm(), 1e-12);
  EXPECT_LT((path.offset_m(at_s(1.7)) - Vector2(0.0, -0.8)).norm(), 1e-12);
  EXPECT_LT((path.offset_m(at_s(1.1)) - Vector2(-0.48, -0.8)).norm(), 1e-12);
  EXPECT_LT((path.offset_m(at_s(-9.0)) - Vector2(-0.6, -0.8)).norm(), 1e-12);
}

TEST(PathMemory, WalksOnByAtMostOneStep) {
  const PathMemory path = corner();
  EXPECT_LT((path.offset_m(at_s(2.6)) - Vector2(0.0, 0.16)).norm(), 1e-12);
  EXPECT_LT((path.offset_m(at_s(3.2)) - Vector2(0.0, 0.8)).norm(), 1e-12);
  EXPECT_EQ(path.offset_m(at_s(3.6)), Vector2(0.0, 0.0));
  EXPECT_EQ(path.offset_m(at_s(99.0)), Vector2(0.0, 0.0));
}

TEST(PathMemory, KnowsNothingBeforeTheFirstStep) {
  PathMemory path;
  EXPECT_EQ(path.offset_m(at_s(3.0)), Vector2(0.0, 0.0));
  EXPECT_TRUE(path.is_in_order(at_s(-1e6)));
  path.add(step_of(1.0, 1.5, 0.6, 0.0));
  EXPECT_FALSE(path.is_in_order(at_s(1.4)));
  EXPECT_TRUE(path.is_in_order(at_s(1.5)));
  path.clear();
  EXPECT_EQ(path.offset_m(at_s(1.0)), Vector2(0.0, 0.0));
}

TEST(PathMemory, ForgetsTheDistantPast) {
  PathMemory path;
  for (int i = 0; i < 200; ++i) path.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.0));
  EXPECT_NEAR(path.offset_m(at_s(80.0)).x(), -28.0, 1e-9);
  // Half a minute and the step it falls into.
  EXPECT_NEAR(path.offset_m(at_s(0.0)).x(), -42.0, 0.7 + 1e-9);
}

TEST(PathMemory, TakesStepsOfNoDuration) {
  PathMemory path;
  path.add(step_of(1.0, 1.0, 0.6, 0.0));
  path.add(step_of(1.0, 1.0, 0.6, 0.0));
  EXPECT_TRUE(path.offset_m(at_s(1.0)).allFinite());
  EXPECT_NEAR(path.offset_m(at_s(0.9)).x(), -1.2, 1e-12);
  EXPECT_EQ(path.offset_m(at_s(1.1)), Vector2(0.0, 0.0));
}

}  // namespace
}  // namespace waylode::fusion
