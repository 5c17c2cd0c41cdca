// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/frame_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace waylode::site {
namespace {

using core::Vector2;

TEST(FrameFit, RecoversAnAffineMapFromFourPoints) {
  core::Affine2 truth;
  truth.linear << 1.1, -0.3, 0.2, 0.9;
  truth.translation_m = Vector2(17.0, -5.0);
  const std::vector<Vector2> from{{0, 0}, {40, 3}, {35, 28}, {-4, 21}};
  std::vector<Vector2> to;
  for (const Vector2& point : from) to.push_back(truth * point);
  const auto fitted = fit_affine(from, to);
  ASSERT_TRUE(fitted);
  EXPECT_LT((fitted->linear - truth.linear).norm(), 1e-12);
  EXPECT_LT((fitted->translation_m - truth.translation_m).norm(), 1e-11);
}

TEST(FrameFit, SpreadsAnErrorOverAllPoints) {
  // One corner of a square is off by (4, 0): the best plane through (0, 0, 4, 0) at the corners of
  // a 10 m square misses each corner by 1.
  const std::vector<Vector2> from{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const std::vector<Vector2> to{{0, 0}, {10, 0}, {14, 10}, {0, 10}};
  const auto fitted = fit_affine(from, to);
  ASSERT_TRUE(fitted);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((*fitted * from[i] - to[i]).norm(), 1.0, 1e-12);
  }
}

TEST(FrameFit, RefusesPointsOnOneLine) {
  const std::vector<Vector2> from{{0, 0}, {1, 2}, {3, 6}, {4, 8}};
  EXPECT_FALSE(fit_affine(from, from));
  const std::vector<Vector2> same{{5, 5}, {5, 5}, {5, 5}};
  EXPECT_FALSE(fit_affine(same, same));
}

TEST(FrameFit, RefusesTooFewOrUnevenPoints) {
  const std::vector<Vector2> two{{0, 0}, {1, 2}};
  const std::vector<Vector2> three{{0, 0}, {1, 2}, {5, 1}};
  EXPECT_FALSE(fit_affine(two, two));
  EXPECT_FALSE(fit_affine(three, two));
}

TEST(FrameFit, FindsTheSimilarityOfTwoPoints) {
  // A quarter turn counter-clockwise, twice the size, then shifted by (3, 1).
  const auto fitted = fit_similarity({{0, 0}, {5, 0}}, {{3, 1}, {3, 11}});
  ASSERT_TRUE(fitted);
  EXPECT_LT((*fitted * Vector2(1, 2) - Vector2(3 - 4, 1 + 2)).norm(), 1e-12);
  EXPECT_FALSE(fit_similarity({{2, 2}, {2, 2}}, {{3, 1}, {3, 11}}));
  EXPECT_FALSE(fit_similarity({{0, 0}, {5, 0}}, {{3, 1}, {3, 1}}));
}

}  // namespace
}  // namespace waylode::site
