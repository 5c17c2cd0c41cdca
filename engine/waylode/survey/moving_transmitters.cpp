// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/moving_transmitters.hpp"

#include <algorithm>
#include <array>

namespace waylode::survey {

core::Result<void> MovingTransmitterFilter::Options::validate() const {
  if (!(loud_dbm < 0.0F && farthest_m > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "loud_dbm must be negative and farthest_m positive", "moving_transmitters");
  }
  return {};
}

void MovingTransmitterFilter::hear(core::TransmitterId transmitter, std::string_view ssid,
                                   float rssi_dbm, core::FloorId floor,
                                   const core::Vector2& position_m) {
  Evidence& evidence = evidence_[transmitter];
  evidence.named_hotspot = evidence.named_hotspot || is_hotspot_name(ssid);
  if (rssi_dbm < options_.loud_dbm) return;
  const auto [box, first] = evidence.loud.try_emplace(floor, core::Bounds2{position_m, position_m});
  if (first) return;
  box->second.min_m = box->second.min_m.cwiseMin(position_m);
  box->second.max_m = box->second.max_m.cwiseMax(position_m);
}

bool MovingTransmitterFilter::is_moving(core::TransmitterId transmitter) const {
  const auto found = evidence_.find(transmitter);
  if (found == evidence_.end()) return false;
  if (found->second.named_hotspot) return true;
  return std::ranges::any_of(found->second.loud, [&](const auto& entry) {
    return entry.second.diagonal_m() > options_.farthest_m;
  });
}

bool is_hotspot_name(std::string_view ssid) {
  static constexpr std::array<std::string_view, 8> kPrefixes = {
      "AndroidAP", "iPhone", "DIRECT-", "Galaxy S", "Galaxy Note", "Redmi ", "OPPO ", "vivo "};
  return std::ranges::any_of(kPrefixes,
                             [&](std::string_view prefix) { return ssid.starts_with(prefix); }) ||
         ssid.ends_with("iPhone");
}

bool asks_not_to_be_mapped(std::string_view ssid) { return ssid.ends_with("_nomap"); }

}  // namespace waylode::survey
