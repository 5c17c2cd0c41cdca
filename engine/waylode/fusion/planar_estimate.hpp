// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/geometry.hpp"
#include "waylode/core/time.hpp"

namespace waylode::fusion {

/// A place in one plane and how well it is known.
struct PlanarEstimate {
  core::DeviceTime time;
  core::Vector2 position_m = core::Vector2::Zero();
  core::Matrix2 covariance_m2 = core::Matrix2::Identity();

  bool operator==(const PlanarEstimate&) const = default;
};

}  // namespace waylode::fusion
