// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/sim/building.hpp"
#include "waylode/sim/detail/random_field.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

/// One address on the air: half of a dual-band access point, or a beacon.
struct Emitter {
  core::TransmitterId id;
  std::string name;  ///< "F1/A/2.4", "F1/a": everything random about it is drawn from this.
  core::FloorId floor;
  core::Vector2 position_m;
  double power_dbm = 0.0;  ///< Received at the reference distance.
  std::int32_t frequency_mhz = 0;
};

/// The quiet part of radio: what an antenna would receive at a place on average, survey and later.
class RadioWorld {
 public:
  RadioWorld(const Building& building, const RadioOptions& options, std::uint64_t seed);

  const std::vector<Emitter>& emitters() const { return emitters_; }
  double distance_m(std::size_t emitter, core::FloorId floor,
                    const core::Vector2& position_m) const;
  /// Log-distance loss [Rappaport2002], walls, slabs and shadowing. Far below any detection
  /// threshold it may leave out walls and shadowing.
  double mean_rssi_dbm(std::size_t emitter, core::FloorId floor,
                       const core::Vector2& position_m) const;
  /// The shadowing alone, dB.
  double shadowing_db(std::size_t emitter, core::FloorId floor,
                      const core::Vector2& position_m) const;
  /// Walls of the receiver's floor between the two, on the straight line.
  int walls_crossed(core::FloorId floor, const core::Vector2& from_m,
                    const core::Vector2& to_m) const;

 private:
  const Building& building_;
  RadioOptions options_;
  std::vector<Emitter> emitters_;
  std::vector<RandomField> shadowing_;  ///< Per emitter and floor, floor fastest.
};

}  // namespace waylode::sim::detail
