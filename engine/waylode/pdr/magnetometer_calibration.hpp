// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"

namespace waylode::pdr {

/// What a phone's own iron does to its magnetometer: shifts the sphere of readings that turning it
/// about would draw (hard iron) and stretches it (soft iron).
struct MagnetometerCalibration {
  struct Options {
    std::size_t min_sample_count = 50;
    /// Smallest over largest variance of the readings along any axis; a phone turned in one plane
    /// has nearly 0, one turned every way nearly 1. In [0, 1).
    double min_spread_ratio = 0.1;
    std::size_t min_octants = 6;      ///< Of the eight, how many the field must have pointed to.
    double max_residual_ratio = 0.1;  ///< Of the field; more, and the place was disturbed.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  core::Vector3 hard_iron_ut = core::Vector3::Zero();
  Eigen::Matrix3d soft_iron = Eigen::Matrix3d::Identity();  ///< Symmetric, determinant one.
  double field_ut = 0.0;     ///< Strength of the field after calibration; 0 where not known.
  double residual_ut = 0.0;  ///< Root mean square of |calibrated| - field_ut.

  core::Vector3 apply(const core::Vector3& raw_ut) const {
    return soft_iron * (raw_ut - hard_iron_ut);
  }
  bool operator==(const MagnetometerCalibration&) const = default;
};

/// Least-squares ellipsoid through raw readings of a phone turned every way in one place. Fails
/// where they do not cover the sphere, draw no ellipsoid, scatter too far from it or hold a value
/// that is not a number. Rotation about an axis fixed in the phone cannot be told from such data
/// and is left alone.
core::Result<MagnetometerCalibration> calibrate_magnetometer(
    std::span<const core::Vector3> raw_ut, const MagnetometerCalibration::Options& options = {});

}  // namespace waylode::pdr
