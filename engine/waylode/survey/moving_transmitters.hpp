// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string_view>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"

namespace waylode::survey {

/// Finds transmitters that do not stay put (phone hotspots): by what their name says, and by being
/// heard loudly at places too far apart for one spot. [Wu2019] 1.1 filters hotspots by address and
/// brand; an address alone decides nothing, so evidence does.
class MovingTransmitterFilter {
 public:
  struct Options {
    float loud_dbm = -62.0F;   ///< Heard this loudly, a transmitter is near.
    double farthest_m = 45.0;  ///< Two loud places farther apart (same floor) mean it moved.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit MovingTransmitterFilter(const Options& options) : options_(options) {}

  void hear(core::TransmitterId transmitter, std::string_view ssid, float rssi_dbm,
            core::FloorId floor, const core::Vector2& position_m);
  bool is_moving(core::TransmitterId transmitter) const;

 private:
  struct Evidence {
    bool named_hotspot = false;
    std::map<core::FloorId, core::Bounds2> loud;  ///< Box of the loud places, per floor.
  };

  Options options_;
  std::map<core::TransmitterId, Evidence> evidence_;
};

/// Names that phones give their hotspots ("AndroidAP", "iPhone von ...", "DIRECT-..."), and names
/// that ask not to be mapped ("..._nomap").
bool is_hotspot_name(std::string_view ssid);
bool asks_not_to_be_mapped(std::string_view ssid);

}  // namespace waylode::survey
