// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/geometry.hpp"

#include <gtest/gtest.h>

namespace waylode::core {
namespace {

/// Turned by 90 degrees, doubled and moved.
Affine2 example() {
  Affine2 map;
  map.linear << 0.0, -2.0, 2.0, 0.0;
  map.translation_m = Vector2(10.0, -5.0);
  return map;
}

TEST(Affine2, MapsPointsByTurningThenMoving) {
  EXPECT_EQ(example() * Vector2(3.0, 1.0), Vector2(8.0, 1.0));
  EXPECT_EQ(Affine2{} * Vector2(3.0, 1.0), Vector2(3.0, 1.0));
}

TEST(Affine2, MapsBackByItsInverse) {
  const Vector2 point(3.5, -1.25);
  EXPECT_TRUE((example().inverse() * (example() * point)).isApprox(point, 1e-12));
}

TEST(Affine2, MapsCovariancesWithoutTheTranslation) {
  Matrix2 covariance_m2;
  covariance_m2 << 4.0, 1.0, 1.0, 3.0;
  Matrix2 expected_m2;
  expected_m2 << 12.0, -4.0, -4.0, 16.0;
  EXPECT_TRUE(example().map_covariance(covariance_m2).isApprox(expected_m2, 1e-12));
}

TEST(Bounds2, ContainsItsBorder) {
  const Bounds2 bounds{Vector2(-1.0, 2.0), Vector2(2.0, 6.0)};
  EXPECT_TRUE(bounds.contains(Vector2(-1.0, 6.0)));
  EXPECT_FALSE(bounds.contains(Vector2(-1.1, 4.0)));
  EXPECT_FALSE(bounds.contains(Vector2(0.0, 6.1)));
  EXPECT_EQ(bounds.size_m(), Vector2(3.0, 4.0));
  EXPECT_DOUBLE_EQ(bounds.diagonal_m(), 5.0);
}

}  // namespace
}  // namespace waylode::core
