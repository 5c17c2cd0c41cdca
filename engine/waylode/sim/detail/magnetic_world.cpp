// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/magnetic_world.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/sim/detail/seeds.hpp"

namespace waylode::sim::detail {

using core::Vector2;
using core::Vector3;

namespace {

Vector3 earth_field_ut(const MagneticOptions& options) {
  const double dip_rad = core::radians_from_degrees(options.inclination_deg);
  const double north_rad = core::kPi / 2.0 + core::radians_from_degrees(options.north_offset_deg);
  const double level_ut = options.intensity_ut * std::cos(dip_rad);
  return {level_ut * std::cos(north_rad), level_ut * std::sin(north_rad),
          -options.intensity_ut * std::sin(dip_rad)};
}

Vector3 draw_direction(core::Rng& rng) {
  const double x = rng.normal();
  const double y = rng.normal();
  const double z = rng.normal();
  return Vector3(x, y, z).normalized();
}

}  // namespace

MagneticWorld::MagneticWorld(const Building& building, const MagneticOptions& options,
                             std::uint64_t seed)
    : earth_ut_(earth_field_ut(options)), anomaly_sigma_ut_(options.anomaly_sigma_ut) {
  for (const site::FloorDraft& draft : building.floors) {
    const site::Floor& floor = draft.floor;
    core::Rng rng(derive_seed(seed, "dipoles/" + floor.name));
    FloorField field;
    const Vector2 size_m = floor.bounds.size_m();
    const auto count =
        static_cast<int>(std::lround(options.dipoles_per_100m2 * size_m.prod() / 100.0));
    for (int i = 0; i < count; ++i) {
      const double x_m = rng.uniform(floor.bounds.min_m.x(), floor.bounds.max_m.x());
      const double y_m = rng.uniform(floor.bounds.min_m.y(), floor.bounds.max_m.y());
      const double z_m = rng.below(2) == 0 ? rng.uniform(-0.4, 0.0) : rng.uniform(2.5, 3.0);
      field.dipoles.push_back(
          {{x_m, y_m, z_m}, options.dipole_field_ut * rng.uniform(0.3, 1.5) * draw_direction(rng)});
    }
    for (const char* axis : {"x", "y", "z"}) {
      field.axes.emplace_back(derive_seed(seed, "anomaly/" + floor.name + "/" + axis),
                              Correlation::kSquaredExponential, options.anomaly_range_m);
    }
    floors_.push_back(std::move(field));
  }
}

Vector3 MagneticWorld::at(core::FloorId floor, const Vector2& position_m, double height_m) const {
  const FloorField& field = floors_[floor.index];
  Vector3 sum_ut = earth_ut_;
  if (anomaly_sigma_ut_ > 0.0) {
    for (int axis = 0; axis < 3; ++axis) {
      sum_ut[axis] += anomaly_sigma_ut_ * field.axes[static_cast<std::size_t>(axis)].at(position_m);
    }
  }
  const Vector3 here_m(position_m.x(), position_m.y(), height_m);
  for (const Dipole& dipole : field.dipoles) {
    const Vector3 offset_m = here_m - dipole.position_m;
    constexpr double kFar_m = 8.0;
    if (offset_m.squaredNorm() > kFar_m * kFar_m) continue;
    // Inside the steel the formula has no meaning.
    constexpr double kInside_m = 0.5;
    const double r_m = std::max(offset_m.norm(), kInside_m);
    const Vector3 direction = offset_m / r_m;
    sum_ut += (3.0 * direction * direction.dot(dipole.moment_ut_m3) - dipole.moment_ut_m3) /
              (r_m * r_m * r_m);
  }
  return sum_ut;
}

}  // namespace waylode::sim::detail
