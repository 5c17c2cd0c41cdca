// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"

namespace waylode::core {

/// Symmetric, finite and positive definite.
bool is_valid_covariance(const Matrix2& covariance_m2);

/// (error)^T covariance^-1 (error): chi-square distributed with two degrees of freedom when the
/// covariance is honest.
double squared_mahalanobis(const Vector2& error_m, const Matrix2& covariance_m2);

/// Chi-square quantile for two degrees of freedom, closed form: -2 ln(1 - probability).
/// `probability` in [0, 1).
double chi_square_2_quantile(double probability);

/// Area of the region that holds `probability` of a Gaussian.
double confidence_region_area_m2(const Matrix2& covariance_m2, double probability);

/// The same region as an ellipse.
struct Ellipse {
  double semi_major_m = 0.0;
  double semi_minor_m = 0.0;
  double major_axis_rad = 0.0;  ///< Counter-clockwise from +x, in (-pi/2, pi/2].
};
Ellipse confidence_ellipse(const Matrix2& covariance_m2, double probability);

}  // namespace waylode::core
