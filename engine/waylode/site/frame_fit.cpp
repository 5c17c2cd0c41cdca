// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/frame_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>

namespace waylode::site {
namespace {

using core::Affine2;
using core::Matrix2;
using core::Vector2;

/// Points whose spread across their line is below this share of the spread along it are collinear.
constexpr double kMinSpreadRatio = 1e-4;

Vector2 mean_of(std::span<const Vector2> points) {
  Vector2 sum = Vector2::Zero();
  for (const Vector2& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<Affine2> fit_affine(std::span<const Vector2> from, std::span<const Vector2> to) {
  if (from.size() < 3 || from.size() != to.size()) return std::nullopt;
  const Vector2 from_mean = mean_of(from);
  const Vector2 to_mean = mean_of(to);
  Matrix2 scatter = Matrix2::Zero();
  Matrix2 cross = Matrix2::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector2 from_offset = from[i] - from_mean;
    scatter += from_offset * from_offset.transpose();
    cross += (to[i] - to_mean) * from_offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix2> spread(scatter);
  const double smallest = spread.eigenvalues()(0);
  const double largest = spread.eigenvalues()(1);
  if (!(smallest > kMinSpreadRatio * kMinSpreadRatio * largest) ||
      !(smallest > std::numeric_limits<double>::min())) {
    return std::nullopt;
  }
  // linear * scatter = cross, with scatter symmetric.
  const Matrix2 linear = scatter.ldlt().solve(cross.transpose()).transpose();
  return Affine2{linear, to_mean - linear * from_mean};
}

std::optional<Affine2> fit_similarity(const Vector2 (&from)[2], const Vector2 (&to)[2]) {
  const Vector2 from_step = from[1] - from[0];
  const Vector2 to_step = to[1] - to[0];
  const double length2_m2 = from_step.squaredNorm();
  if (!(length2_m2 > 0.0) || !(to_step.squaredNorm() > 0.0)) return std::nullopt;
  // The quotient of the two steps as complex numbers.
  const double re = from_step.dot(to_step) / length2_m2;
  const double im = (from_step.x() * to_step.y() - from_step.y() * to_step.x()) / length2_m2;
  Matrix2 linear;
  linear << re, -im, im, re;
  return Affine2{linear, to[0] - linear * from[0]};
}

}  // namespace waylode::site
