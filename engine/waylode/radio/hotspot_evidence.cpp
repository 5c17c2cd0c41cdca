// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/hotspot_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::radio {

core::Result<void> HotspotEvidence::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "hotspot_evidence");
  };
  if (!(loud_dbm < 0.0F && farthest_m > 0.0)) {
    return refuse("loud_dbm must be negative and farthest_m positive");
  }
  if (!(min_visit_ratio >= 0.0 && min_visit_ratio <= 1.0 && min_visits >= 1)) {
    return refuse("min_visit_ratio must be in [0, 1] and min_visits at least 1");
  }
  if (!(visit_radius_m > 0.0)) return refuse("visit_radius_m must be positive");
  if (!(max_residual_db > 0.0 && min_readings >= 5)) {
    return refuse("max_residual_db must be positive and min_readings at least 5");
  }
  return locator.validate();
}

void HotspotEvidence::pass(core::FloorId floor, const core::Vector2& position_m) {
  if (!position_m.allFinite()) return;
  constexpr double kThinning = 0.2;  // Of the radius: what lies closer to the last place adds none.
  std::vector<core::Vector2>& places_m = passed_[floor][visit_];
  if (!places_m.empty() &&
      (places_m.back() - position_m).norm() < kThinning * options_.visit_radius_m) {
    return;
  }
  places_m.push_back(position_m);
}

void HotspotEvidence::hear(core::TransmitterId transmitter, float rssi_dbm, core::FloorId floor,
                           const core::Vector2& position_m) {
  if (!std::isfinite(rssi_dbm) || !position_m.allFinite()) return;
  pass(floor, position_m);
  Heard& heard = heard_[transmitter];
  heard.visits.insert(visit_);
  OnFloor& here = heard.floors[floor];
  keep(here, {position_m, static_cast<double>(rssi_dbm)});
  if (rssi_dbm > heard.loudest_dbm) {
    heard.loudest_dbm = rssi_dbm;
    heard.loudest_floor = floor;
    heard.loudest_m = position_m;
  }
  if (rssi_dbm < options_.loud_dbm) return;
  if (!here.loud) here.loud = core::Bounds2{position_m, position_m};
  here.loud->min_m = here.loud->min_m.cwiseMin(position_m);
  here.loud->max_m = here.loud->max_m.cwiseMax(position_m);
}

void HotspotEvidence::keep(OnFloor& floor, const PlacedReading& reading) const {
  if (std::isinf(options_.max_residual_db)) return;
  constexpr std::size_t kMost = 512;
  if (floor.heard++ % floor.stride != 0) return;
  floor.readings.push_back(reading);
  if (floor.readings.size() < kMost) return;
  for (std::size_t i = 0; 2 * i < floor.readings.size(); ++i) {
    floor.readings[i] = floor.readings[2 * i];
  }
  floor.readings.resize((floor.readings.size() + 1) / 2);
  floor.stride *= 2;
}

std::optional<double> HotspotEvidence::visit_ratio(const Heard& heard) const {
  if (options_.min_visit_ratio <= 0.0 || heard.loudest_dbm < options_.loud_dbm) return std::nullopt;
  const auto floor = passed_.find(heard.loudest_floor);
  if (floor == passed_.end()) return std::nullopt;
  std::size_t near = 0;
  std::size_t hearing = 0;
  for (const auto& [visit, places_m] : floor->second) {
    const bool came_near = std::ranges::any_of(places_m, [&](const core::Vector2& place_m) {
      return (place_m - heard.loudest_m).norm() <= options_.visit_radius_m;
    });
    if (!came_near) continue;
    ++near;
    if (heard.visits.contains(visit)) ++hearing;
  }
  if (near < options_.min_visits) return std::nullopt;
  return static_cast<double>(hearing) / static_cast<double>(near);
}

std::optional<double> HotspotEvidence::residual_db(const Heard& heard) const {
  std::optional<double> largest_db;
  const TransmitterLocator locator(options_.locator);
  for (const auto& [floor, on_floor] : heard.floors) {
    if (on_floor.readings.size() < options_.min_readings) continue;
    const auto fit = locator.fit(on_floor.readings);
    if (fit) largest_db = std::max(largest_db.value_or(0.0), fit->sigma_db);
  }
  return largest_db;
}

// [Wu2019] 1.1
HotspotEvidence::Finding HotspotEvidence::finding(core::TransmitterId transmitter) const {
  Finding finding;
  const auto found = heard_.find(transmitter);
  if (found == heard_.end()) return finding;
  for (const auto& [floor, on_floor] : found->second.floors) {
    if (!on_floor.loud) continue;
    finding.loud_extent_m = std::max(finding.loud_extent_m, on_floor.loud->diagonal_m());
  }
  finding.visit_ratio = visit_ratio(found->second);
  finding.residual_db = residual_db(found->second);
  finding.is_loud_apart = finding.loud_extent_m > options_.farthest_m;
  finding.is_rarely_seen = finding.visit_ratio && *finding.visit_ratio < options_.min_visit_ratio;
  finding.fits_no_place = finding.residual_db && *finding.residual_db > options_.max_residual_db;
  return finding;
}

}  // namespace waylode::radio
