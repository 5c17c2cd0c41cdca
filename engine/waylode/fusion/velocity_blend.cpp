// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/velocity_blend.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/core/assert.hpp"

namespace waylode::fusion {
namespace {

bool are_shares(const VelocityBlend::Shares& shares) {
  constexpr double kRounding = 1e-9;
  return shares.last >= 0.0 && shares.fused >= 0.0 && shares.sensed >= 0.0 &&
         std::abs(shares.last + shares.fused + shares.sensed - 1.0) <= kRounding;
}

bool is_sound(const PolarVelocity& velocity) {
  return std::isfinite(velocity.speed_mps) && velocity.speed_mps >= 0.0 &&
         std::isfinite(velocity.heading_rad);
}

}  // namespace

core::Vector2 PolarVelocity::vector_mps() const {
  return speed_mps * core::Vector2(std::cos(heading_rad), std::sin(heading_rad));
}

core::Result<void> VelocityBlend::Options::validate() const {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const bool sound = are_shares(speed) && are_shares(heading) && is_positive(turn_rad) &&
                     is_positive(fastest_mps) && std::isfinite(slowest_mps) && slowest_mps >= 0.0;
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "shares must not be negative and must sum to one, turn_rad and fastest_mps "
                      "must be positive, slowest_mps not negative",
                      "velocity_blend");
  }
  return {};
}

bool VelocityBlend::is_turn(const PolarVelocity& last, const PolarVelocity& sensed) const {
  return std::abs(core::wrap_angle(sensed.heading_rad - last.heading_rad)) > options_.turn_rad;
}

// [Zhou2016] eqs. (14) and (15).
PolarVelocity VelocityBlend::blend(const PolarVelocity& last, const PolarVelocity& fused,
                                   const PolarVelocity& sensed) const {
  WAYLODE_ASSERT(is_sound(last) && is_sound(fused) && is_sound(sensed));
  const double sensed_heading_rad = core::wrap_angle(sensed.heading_rad);
  if (is_turn(last, sensed)) return {sensed.speed_mps, sensed_heading_rad};
  const Shares& q = options_.speed;
  const Shares& p = options_.heading;
  const double fused_heading_rad =
      fused.speed_mps < options_.slowest_mps ? sensed.heading_rad : fused.heading_rad;
  const auto heading =
      core::circular_mean(std::array{last.heading_rad, fused_heading_rad, sensed.heading_rad},
                          std::array{p.last, p.fused, p.sensed});
  return {q.last * last.speed_mps + q.fused * std::min(fused.speed_mps, options_.fastest_mps) +
              q.sensed * sensed.speed_mps,
          heading ? heading->mean_rad : sensed_heading_rad};
}

core::Vector2 moved_m(const core::Vector2& position_m, const PolarVelocity& velocity,
                      core::Duration by) {
  return position_m + core::to_seconds(by) * velocity.vector_mps();
}

}  // namespace waylode::fusion
