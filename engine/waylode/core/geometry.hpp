// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace waylode::core {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix2 = Eigen::Matrix2d;
using Quaternion = Eigen::Quaterniond;

/// WGS-84. Height is not carried: floors have an elevation of their own.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;

  bool operator==(const GeoPoint&) const = default;
};

/// A planar map between two frames: destination = linear * source + translation.
/// Named like all frame changes, destination first: `site_from_floor`.
struct Affine2 {
  Matrix2 linear = Matrix2::Identity();
  Vector2 translation_m = Vector2::Zero();

  Vector2 operator*(const Vector2& point) const { return linear * point + translation_m; }
  /// Covariances map by the linear part alone.
  Matrix2 map_covariance(const Matrix2& covariance_m2) const {
    return linear * covariance_m2 * linear.transpose();
  }
  /// `linear` must be invertible.
  Affine2 inverse() const {
    const Matrix2 inverse_linear = linear.inverse();
    return {inverse_linear, -(inverse_linear * translation_m)};
  }
  bool operator==(const Affine2&) const = default;
};

/// Axis-aligned box in one frame, metres.
struct Bounds2 {
  Vector2 min_m = Vector2::Zero();
  Vector2 max_m = Vector2::Zero();

  Vector2 size_m() const { return max_m - min_m; }
  double diagonal_m() const { return size_m().norm(); }
  bool contains(const Vector2& point_m) const {
    return (point_m.array() >= min_m.array()).all() && (point_m.array() <= max_m.array()).all();
  }
  bool operator==(const Bounds2&) const = default;
};

}  // namespace waylode::core
