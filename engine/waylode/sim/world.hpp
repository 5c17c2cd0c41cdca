// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/sim/scenario.hpp"

namespace waylode::sim {

/// A scenario's building and physics without its walkers: what an instrument would show anywhere.
/// The same world as `simulate` walks through, so surveys made here fit recordings made there.
/// Deterministic: every answer depends on the scenario and the call's arguments only.
class World {
 public:
  /// kScenarioInvalid for what `validate` finds.
  static core::Result<World> make(const Scenario& scenario);

  enum class Facing : std::uint8_t {
    kFour,  ///< Scan after scan to +x, +y, -x, -y and again.
    kNone,  ///< Nobody stands in the way of the radio.
  };
  /// `count` Wi-Fi scans of a surveyor at one place, far enough apart in time to be independent,
  /// before any drift, by a reference phone. A scan lists what it heard and may be empty.
  std::vector<sample::FingerprintRow> survey_scans(core::FloorId floor,
                                                   const core::Vector2& position_m,
                                                   std::size_t count, Facing facing) const;

  /// Where and how somebody stands.
  struct Standing {
    core::FloorId floor;
    core::Vector2 position_m = core::Vector2::Zero();
    double heading_rad = 0.0;  ///< Counter-clockwise from +x.
  };
  /// `count` scans of somebody who stands still, one every `interval_s` (above 0) from t = 0 on,
  /// with fading remembered, the body and the drift since the survey. `who` names the random part.
  std::vector<sample::WifiScan> standing_scans(const Standing& standing, std::size_t count,
                                               double interval_s, std::string_view who) const;

  /// Of a Wi-Fi address or a beacon, as told by `transmitters`; nullopt for one that is not here.
  std::optional<double> mean_rssi_dbm(core::TransmitterId transmitter, core::FloorId floor,
                                      const core::Vector2& position_m) const;
  std::vector<core::TransmitterId> transmitters() const;

  /// Magnetic field at a height above the floor: x, y of the floor frame, up.
  core::Vector3 field_ut(core::FloorId floor, const core::Vector2& position_m,
                         double height_m) const;

 private:
  struct Parts;
  explicit World(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};

}  // namespace waylode::sim
