// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/radio_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "waylode/sim/detail/seeds.hpp"

namespace waylode::sim::detail {

namespace {

using core::Vector2;

constexpr double kPhoneHeight_m = 1.1;

/// An address as bought from the registry: neither group nor locally administered.
std::uint64_t address_of(const Emitter& emitter, std::uint64_t seed) {
  constexpr std::uint64_t kFlagBits = 0x0300'0000'0000ULL;
  return derive_seed(seed, "address/" + emitter.name) & 0xFFFF'FFFF'FFFFULL & ~kFlagBits;
}

void add_wifi(const Emitter& base, const RadioOptions& options, std::uint64_t seed,
              std::vector<Emitter>& emitters) {
  constexpr std::array kChannels24_mhz = {2412, 2437, 2462};
  constexpr std::array kChannels5_mhz = {5180, 5220, 5260, 5300, 5500, 5580, 5660};
  const std::uint64_t draw = derive_seed(seed, "channel/" + base.name);
  Emitter low = base;
  low.name += "/2.4";
  low.power_dbm = options.wifi_power_dbm;
  low.frequency_mhz = kChannels24_mhz[draw % kChannels24_mhz.size()];
  low.id = core::TransmitterId::wifi(address_of(low, seed));
  emitters.push_back(low);
  if (!options.dual_band) return;
  Emitter high = base;
  high.name += "/5";
  high.power_dbm = options.wifi_power_dbm - options.band_5ghz_loss_db;
  high.frequency_mhz = kChannels5_mhz[(draw / 16) % kChannels5_mhz.size()];
  high.id = core::TransmitterId::wifi(address_of(high, seed));
  emitters.push_back(high);
}

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A wall's end counts as its first end only, so that a corner of two walls counts once.
bool crosses(const Vector2& from, const Vector2& to, const site::Wall& wall) {
  const Vector2 way = to - from;
  const double a = cross(way, wall.from_m - from);
  const double b = cross(way, wall.to_m - from);
  if ((a >= 0.0) == (b >= 0.0)) return false;
  const Vector2 along = wall.to_m - wall.from_m;
  const double c = cross(along, from - wall.from_m);
  const double d = cross(along, to - wall.from_m);
  return (c >= 0.0) != (d >= 0.0);
}

}  // namespace

RadioWorld::RadioWorld(const Building& building, const RadioOptions& options, std::uint64_t seed)
    : building_(building), options_(options) {
  for (const Transmitter& transmitter : building.transmitters) {
    Emitter emitter;
    emitter.floor = transmitter.floor;
    emitter.position_m = transmitter.position_m;
    emitter.name = building.floor(transmitter.floor).name + "/" + transmitter.name;
    if (transmitter.kind == Transmitter::Kind::kWifi) {
      add_wifi(emitter, options, seed, emitters_);
      continue;
    }
    emitter.power_dbm = options.bluetooth_power_dbm;
    emitter.id = core::TransmitterId::bluetooth(address_of(emitter, seed));
    emitters_.push_back(emitter);
  }
  const auto correlation =
      options.shadowing_is_smooth ? Correlation::kSquaredExponential : Correlation::kExponential;
  for (const Emitter& emitter : emitters_) {
    for (const site::FloorDraft& draft : building.floors) {
      shadowing_.emplace_back(derive_seed(seed, "shadow/" + emitter.name + "/" + draft.floor.name),
                              correlation, options.shadowing_range_m);
    }
  }
}

double RadioWorld::distance_m(std::size_t emitter, core::FloorId floor,
                              const Vector2& position_m) const {
  const Emitter& from = emitters_[emitter];
  const double up_m = building_.floor(from.floor).elevation_m + options_.transmitter_height_m -
                      building_.floor(floor).elevation_m - kPhoneHeight_m;
  return std::hypot((position_m - from.position_m).norm(), up_m);
}

double RadioWorld::shadowing_db(std::size_t emitter, core::FloorId floor,
                                const Vector2& position_m) const {
  if (options_.shadowing_sigma_db == 0.0) return 0.0;
  const RandomField& field = shadowing_[emitter * building_.floors.size() + floor.index];
  return options_.shadowing_sigma_db * field.at(position_m);
}

int RadioWorld::walls_crossed(core::FloorId floor, const Vector2& from_m,
                              const Vector2& to_m) const {
  const auto& walls = building_.radio_walls[floor.index];
  return static_cast<int>(std::count_if(walls.begin(), walls.end(), [&](const site::Wall& wall) {
    return crosses(from_m, to_m, wall);
  }));
}

double RadioWorld::mean_rssi_dbm(std::size_t emitter, core::FloorId floor,
                                 const Vector2& position_m) const {
  const Emitter& from = emitters_[emitter];
  const int slabs = std::abs(building_.floor(from.floor).level - building_.floor(floor).level);
  const double far_m = std::max(options_.nearest_m, distance_m(emitter, floor, position_m));
  const double in_the_open_dbm =
      from.power_dbm -
      10.0 * options_.path_loss_exponent * std::log10(far_m / options_.reference_distance_m) -
      options_.floor_loss_db * slabs;
  constexpr double kBeyondHearing_db = 20.0;
  if (in_the_open_dbm + 3.0 * options_.shadowing_sigma_db <
      options_.detection_threshold_dbm - kBeyondHearing_db) {
    return in_the_open_dbm;
  }
  const double wall_db =
      std::min(options_.wall_loss_cap_db,
               options_.wall_loss_db * walls_crossed(floor, from.position_m, position_m));
  return in_the_open_dbm - wall_db + shadowing_db(emitter, floor, position_m);
}

}  // namespace waylode::sim::detail
