// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/magnetometer_calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <bitset>
#include <cmath>

namespace waylode::pdr {
namespace {

using core::Vector3;
using Eigen::Matrix3d;

tl::unexpected<core::Error> refuse(const char* message) {
  return core::fail(core::ErrorCode::kInvalidArgument, message, "magnetometer_calibration");
}

/// Where the readings lie and how wide, so that the fit works on numbers near one.
struct Extent {
  Vector3 mean_ut = Vector3::Zero();
  double size_ut = 0.0;
  double spread_ratio = 0.0;
};

Extent extent_of(std::span<const Vector3> raw_ut) {
  Extent extent;
  const auto count = static_cast<double>(raw_ut.size());
  for (const Vector3& each : raw_ut) extent.mean_ut += each / count;
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3& each : raw_ut) {
    covariance += (each - extent.mean_ut) * (each - extent.mean_ut).transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  extent.size_ut = std::sqrt(covariance.trace());
  if (solver.eigenvalues()(2) > 0.0) {
    extent.spread_ratio = solver.eigenvalues()(0) / solver.eigenvalues()(2);
  }
  return extent;
}

/// x^T shape x + 2 linear^T x = 1.
struct Quadric {
  Matrix3d shape = Matrix3d::Zero();
  Vector3 linear = Vector3::Zero();
};

Quadric fit_quadric(std::span<const Vector3> raw_ut, const Extent& extent) {
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Vector9 right = Vector9::Zero();
  for (const Vector3& each : raw_ut) {
    const Vector3 p = (each - extent.mean_ut) / extent.size_ut;
    Vector9 row;
    row << p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), 2.0 * p.x() * p.y(), 2.0 * p.x() * p.z(),
        2.0 * p.y() * p.z(), 2.0 * p.x(), 2.0 * p.y(), 2.0 * p.z();
    normal += row * row.transpose();
    right += row;
  }
  const Vector9 solution = normal.ldlt().solve(right);
  Quadric quadric;
  quadric.shape << solution(0), solution(3), solution(4), solution(3), solution(1), solution(5),
      solution(4), solution(5), solution(2);
  quadric.linear = solution.tail<3>();
  return quadric;
}

/// nullopt-like: field_ut stays 0 where the quadric is no ellipsoid.
MagnetometerCalibration calibration_of(const Quadric& quadric, const Extent& extent) {
  MagnetometerCalibration calibration;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(quadric.shape);
  if (!(solver.eigenvalues()(0) > 0.0)) return calibration;
  const Vector3 centre = -quadric.shape.ldlt().solve(quadric.linear);
  const double radius2 = 1.0 + centre.dot(quadric.shape * centre);
  // |root (x - centre)| = 1 on the ellipsoid; of determinant one, it keeps the mean field.
  const Vector3 root = (solver.eigenvalues() / radius2).cwiseSqrt();
  const double mean_radius = 1.0 / std::cbrt(root.prod());
  const Matrix3d& axes = solver.eigenvectors();
  calibration.soft_iron = axes * (mean_radius * root).asDiagonal() * axes.transpose();
  calibration.hard_iron_ut = extent.mean_ut + extent.size_ut * centre;
  calibration.field_ut = extent.size_ut * mean_radius;
  return calibration;
}

std::size_t octants_seen(std::span<const Vector3> raw_ut,
                         const MagnetometerCalibration& calibration) {
  std::bitset<8> seen;
  for (const Vector3& each : raw_ut) {
    const Vector3 field_ut = calibration.apply(each);
    seen.set((field_ut.x() > 0.0 ? 1U : 0U) + (field_ut.y() > 0.0 ? 2U : 0U) +
             (field_ut.z() > 0.0 ? 4U : 0U));
  }
  return seen.count();
}

double residual_ut(std::span<const Vector3> raw_ut, const MagnetometerCalibration& calibration) {
  double sum_ut2 = 0.0;
  for (const Vector3& each : raw_ut) {
    sum_ut2 += std::pow(calibration.apply(each).norm() - calibration.field_ut, 2);
  }
  return std::sqrt(sum_ut2 / static_cast<double>(raw_ut.size()));
}

}  // namespace

core::Result<void> MagnetometerCalibration::Options::validate() const {
  constexpr std::size_t kUnknowns = 9;
  if (!(min_sample_count > kUnknowns && min_spread_ratio >= 0.0 && min_spread_ratio < 1.0 &&
        min_octants <= 8 && max_residual_ratio > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need min_sample_count > 9, min_spread_ratio in [0, 1), min_octants <= 8 and "
                      "max_residual_ratio > 0",
                      "magnetometer_calibration");
  }
  return {};
}

core::Result<MagnetometerCalibration> calibrate_magnetometer(
    std::span<const Vector3> raw_ut, const MagnetometerCalibration::Options& options) {
  if (const auto sound = options.validate(); !sound) return tl::unexpected(sound.error());
  for (const Vector3& each : raw_ut) {
    if (!each.allFinite()) return refuse("a reading of the field is not a number");
  }
  if (raw_ut.size() < options.min_sample_count) {
    return refuse("too few readings of the field; turn the phone about for longer");
  }
  const Extent extent = extent_of(raw_ut);
  if (!(extent.size_ut > 0.0) || extent.spread_ratio < options.min_spread_ratio) {
    return refuse("the phone was not turned every way; turn it about all three axes");
  }
  MagnetometerCalibration calibration = calibration_of(fit_quadric(raw_ut, extent), extent);
  if (!(calibration.field_ut > 0.0) || !std::isfinite(calibration.field_ut)) {
    return refuse("the readings of the field draw no ellipsoid; keep away from iron");
  }
  if (octants_seen(raw_ut, calibration) < options.min_octants) {
    return refuse("the phone was not turned every way; turn it about all three axes");
  }
  calibration.residual_ut = residual_ut(raw_ut, calibration);
  if (calibration.residual_ut > options.max_residual_ratio * calibration.field_ut) {
    return refuse("the field changed while the phone was turned; keep away from iron");
  }
  return calibration;
}

}  // namespace waylode::pdr
