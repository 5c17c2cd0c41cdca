// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string_view>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/radio/hotspot_classifier.hpp"
#include "waylode/radio/hotspot_evidence.hpp"

namespace waylode::survey {

/// Finds transmitters that do not stay put (phone hotspots) while a survey is read: by address and
/// name, and by being heard loudly at places too far apart for one spot. [Wu2019] 1.1 filters
/// hotspots by address and brand; as those decide little, evidence does.
class MovingTransmitterFilter {
 public:
  struct Options {
    float loud_dbm = -62.0F;   ///< Heard this loudly, a transmitter is near.
    double farthest_m = 45.0;  ///< Two loud places farther apart (same floor) mean it moved.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// Which evidence counts. All of it needs a survey of many walks.
  enum class Evidence : std::uint8_t { kLoudPlaces, kAll };

  explicit MovingTransmitterFilter(const Options& options,
                                   Evidence evidence = Evidence::kLoudPlaces);

  void begin_walk() { evidence_.begin_visit(); }
  /// The surveyor listened here.
  void pass(core::FloorId floor, const core::Vector2& position_m) {
    evidence_.pass(floor, position_m);
  }
  void hear(core::TransmitterId transmitter, std::string_view ssid, float rssi_dbm,
            core::FloorId floor, const core::Vector2& position_m);
  /// Costly with all evidence: ask once.
  bool is_moving(core::TransmitterId transmitter) const;

 private:
  radio::HotspotClassifier classifier_;
  radio::HotspotEvidence evidence_;
  std::set<core::TransmitterId> hotspots_;  ///< By address and name.
};

/// Names that ask not to be mapped ("..._nomap").
bool asks_not_to_be_mapped(std::string_view ssid);

}  // namespace waylode::survey
