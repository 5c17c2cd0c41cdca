// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/covariance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/core/assert.hpp"

namespace waylode::core {

bool is_valid_covariance(const Matrix2& covariance_m2) {
  if (!covariance_m2.allFinite()) return false;
  const double asymmetry = std::abs(covariance_m2(0, 1) - covariance_m2(1, 0));
  const double scale = covariance_m2.cwiseAbs().maxCoeff();
  return asymmetry <= 1e-9 * scale && covariance_m2(0, 0) > 0.0 &&
         covariance_m2.determinant() > 0.0;
}

double squared_mahalanobis(const Vector2& error_m, const Matrix2& covariance_m2) {
  return error_m.dot(covariance_m2.ldlt().solve(error_m));
}

double chi_square_2_quantile(double probability) {
  WAYLODE_ASSERT(probability >= 0.0 && probability < 1.0);
  return -2.0 * std::log1p(-probability);
}

double confidence_region_area_m2(const Matrix2& covariance_m2, double probability) {
  return kPi * chi_square_2_quantile(probability) * std::sqrt(covariance_m2.determinant());
}

Ellipse confidence_ellipse(const Matrix2& covariance_m2, double probability) {
  const Eigen::SelfAdjointEigenSolver<Matrix2> solver(covariance_m2);
  const double quantile = chi_square_2_quantile(probability);
  const Vector2 major = solver.eigenvectors().col(1);
  double axis_rad = std::atan2(major.y(), major.x());
  if (axis_rad > kPi / 2.0) axis_rad -= kPi;
  if (axis_rad <= -kPi / 2.0) axis_rad += kPi;
  return {std::sqrt(quantile * std::max(0.0, solver.eigenvalues()(1))),
          std::sqrt(quantile * std::max(0.0, solver.eigenvalues()(0))), axis_rad};
}

}  // namespace waylode::core
