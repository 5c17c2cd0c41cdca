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

double dipole_count(const MagneticOptions& options, const Vector2& size_m) {
  const double by_area = options.dipoles_per_100m2 * size_m.prod() / 100.0;
  return std::round(options.dipoles_per_floor.value_or(by_area));
}

/// Height above the floor of one dipole.
double draw_dipole_height_m(const MagneticOptions& options, core::Rng& rng) {
  const bool is_below = rng.below(2) == 0;
  if (!options.dipole_nearest_m) return is_below ? rng.uniform(-0.4, 0.0) : rng.uniform(2.5, 3.0);
  const double nearest_m = *options.dipole_nearest_m;
  const double away_m = rng.uniform(nearest_m, options.dipole_farthest_m.value_or(nearest_m));
  return is_below ? kHandHeight_m - away_m : kHandHeight_m + away_m;
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
    const auto count = static_cast<int>(dipole_count(options, size_m));
    const Vector2 margin_m = Vector2::Constant(options.dipole_margin_m);
    const Vector2 low_m = floor.bounds.min_m - margin_m;
    const Vector2 high_m = floor.bounds.max_m + margin_m;
    for (int i = 0; i < count; ++i) {
      const double x_m = rng.uniform(low_m.x(), high_m.x());
      const double y_m = rng.uniform(low_m.y(), high_m.y());
      const double z_m = draw_dipole_height_m(options, rng);
      const Vector3 direction = draw_direction(rng);
      const double strength =
          rng.uniform(options.dipole_weakest_ratio, options.dipole_strongest_ratio);
      field.dipoles.push_back({{x_m, y_m, z_m}, options.dipole_field_ut * strength * direction});
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
