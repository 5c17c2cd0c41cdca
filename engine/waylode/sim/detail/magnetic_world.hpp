// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/sim/building.hpp"
#include "waylode/sim/detail/random_field.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

/// The magnetic field in the building: the Earth's, smooth anomalies and steel as dipoles, fixed
/// by the seed. Axes of the site frame: x, y, up.
class MagneticWorld {
 public:
  MagneticWorld(const Building& building, const MagneticOptions& options, std::uint64_t seed);

  core::Vector3 earth_ut() const { return earth_ut_; }
  core::Vector3 at(core::FloorId floor, const core::Vector2& position_m, double height_m) const;

 private:
  struct Dipole {
    core::Vector3 position_m;  ///< Floor frame; height above the floor.
    core::Vector3 moment_ut_m3;
  };
  struct FloorField {
    std::vector<Dipole> dipoles;
    std::vector<RandomField> axes;  ///< Three.
  };

  core::Vector3 earth_ut_;
  double anomaly_sigma_ut_;
  std::vector<FloorField> floors_;
};

}  // namespace waylode::sim::detail
