// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/covariance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::core {
namespace {

Matrix2 symmetric(double xx_m2, double xy_m2, double yy_m2) {
  Matrix2 matrix;
  matrix << xx_m2, xy_m2, xy_m2, yy_m2;
  return matrix;
}

TEST(Covariance, IsValidWhenSymmetricAndPositiveDefinite) {
  EXPECT_TRUE(is_valid_covariance(symmetric(4.0, 1.0, 3.0)));
  EXPECT_TRUE(is_valid_covariance(symmetric(1e-6, 0.0, 1e6)));
}

TEST(Covariance, IsInvalidWhenSingularIndefiniteAsymmetricOrNotFinite) {
  EXPECT_FALSE(is_valid_covariance(Matrix2::Zero()));
  EXPECT_FALSE(is_valid_covariance(symmetric(1.0, 1.0, 1.0)));
  EXPECT_FALSE(is_valid_covariance(symmetric(1.0, 2.0, 1.0)));
  EXPECT_FALSE(is_valid_covariance(symmetric(-1.0, 0.0, -1.0)));
  EXPECT_FALSE(is_valid_covariance(symmetric(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0)));
  Matrix2 asymmetric = symmetric(4.0, 1.0, 3.0);
  asymmetric(0, 1) = 1.001;
  EXPECT_FALSE(is_valid_covariance(asymmetric));
}

TEST(Covariance, MeasuresErrorsInStandardDeviations) {
  EXPECT_NEAR(squared_mahalanobis(Vector2(3.0, 0.0), symmetric(9.0, 0.0, 1.0)), 1.0, 1e-12);
  // The inverse of [4 1; 1 3] is [3 -1; -1 4] / 11.
  EXPECT_NEAR(squared_mahalanobis(Vector2(2.0, -1.0), symmetric(4.0, 1.0, 3.0)), 20.0 / 11.0,
              1e-12);
}

TEST(Covariance, HasTheTabledChiSquareQuantiles) {
  EXPECT_EQ(chi_square_2_quantile(0.0), 0.0);
  EXPECT_NEAR(chi_square_2_quantile(0.95), 5.991, 5e-4);
  EXPECT_NEAR(chi_square_2_quantile(0.99), 9.210, 5e-4);
  EXPECT_NEAR(chi_square_2_quantile(0.50), 1.386, 5e-4);
}

TEST(Covariance, HasAsManySamplesInsideARegionAsItsProbability) {
  // P(squared norm <= quantile) by the radial integral of the unit Gaussian, midpoint rule.
  const double radius = std::sqrt(chi_square_2_quantile(0.68));
  constexpr int kSlices = 10'000;
  const double width = radius / kSlices;
  double inside = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double r = (i + 0.5) * width;
    inside += r * std::exp(-0.5 * r * r) * width;
  }
  EXPECT_NEAR(inside, 0.68, 1e-6);
}

TEST(ConfidenceRegion, IsACircleForEqualVariances) {
  // 4 m2 each: radius = 2 sqrt(quantile).
  EXPECT_NEAR(confidence_region_area_m2(symmetric(4.0, 0.0, 4.0), 0.95), kPi * 4.0 * 5.99146, 1e-3);
}

TEST(ConfidenceRegion, IsAnEllipseAlongTheLargestVariance) {
  const double turn_rad = radians_from_degrees(30.0);
  const Eigen::Rotation2Dd map_from_axes(turn_rad);
  const Matrix2 covariance_m2 = map_from_axes.toRotationMatrix() * symmetric(9.0, 0.0, 4.0) *
                                map_from_axes.toRotationMatrix().transpose();
  const Ellipse ellipse = confidence_ellipse(covariance_m2, 0.95);
  const double quantile = -2.0 * std::log(0.05);
  EXPECT_NEAR(ellipse.semi_major_m, 3.0 * std::sqrt(quantile), 1e-9);
  EXPECT_NEAR(ellipse.semi_minor_m, 2.0 * std::sqrt(quantile), 1e-9);
  EXPECT_NEAR(ellipse.major_axis_rad, turn_rad, 1e-9);
  EXPECT_NEAR(kPi * ellipse.semi_major_m * ellipse.semi_minor_m,
              confidence_region_area_m2(covariance_m2, 0.95), 1e-9);
}

TEST(ConfidenceRegion, PointsUpRatherThanDown) {
  const Ellipse ellipse = confidence_ellipse(symmetric(1.0, 0.0, 16.0), 0.5);
  EXPECT_NEAR(ellipse.major_axis_rad, kPi / 2.0, 1e-12);
  const Ellipse falling = confidence_ellipse(symmetric(5.0, -3.0, 5.0), 0.5);
  EXPECT_NEAR(falling.major_axis_rad, -kPi / 4.0, 1e-12);
}

}  // namespace
}  // namespace waylode::core
