// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/world.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "waylode/core/angle.hpp"
#include "waylode/core/assert.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/core/time.hpp"
#include "waylode/sim/detail/magnetic_world.hpp"
#include "waylode/sim/detail/radio_world.hpp"
#include "waylode/sim/detail/receiver.hpp"
#include "waylode/sim/detail/seeds.hpp"

namespace waylode::sim {

namespace {

using core::Vector2;

/// Places to the millimetre name their random part, so that a survey may be made in any order.
std::string name_of(core::FloorId floor, const Vector2& position_m) {
  constexpr double kMillimetre_per_m = 1000.0;
  return std::to_string(floor.index) + "/" +
         std::to_string(std::llround(position_m.x() * kMillimetre_per_m)) + "/" +
         std::to_string(std::llround(position_m.y() * kMillimetre_per_m));
}

PhoneOptions reference_phone() { return {}; }

}  // namespace

struct World::Parts {
  explicit Parts(const Scenario& given)
      : scenario(given),
        radio(scenario.building, scenario.radio, detail::derive_seed(scenario.seed, "radio")),
        magnetic(scenario.building, scenario.magnetic,
                 detail::derive_seed(scenario.seed, "magnetic")) {}

  std::vector<sample::WifiReading> hear_all(detail::Receiver& receiver,
                                            const detail::BodyState& body, double t_s) const {
    std::vector<sample::WifiReading> readings;
    for (std::size_t i = 0; i < radio.emitters().size(); ++i) {
      const detail::Emitter& emitter = radio.emitters()[i];
      if (emitter.id.kind() != core::TransmitterId::Kind::kWifi) continue;
      const auto rssi_dbm = receiver.hear(i, body, t_s);
      if (!rssi_dbm) continue;
      readings.push_back({emitter.id, *rssi_dbm, emitter.frequency_mhz,
                          core::device_time_from_seconds(t_s), "waylode-sim"});
    }
    return readings;
  }

  Scenario scenario;
  detail::RadioWorld radio;  ///< Refers to the building in `scenario`.
  detail::MagneticWorld magnetic;
};

core::Result<World> World::make(const Scenario& scenario) {
  if (auto valid = validate(scenario); !valid) return tl::unexpected(std::move(valid.error()));
  return World(std::make_shared<const Parts>(scenario));
}

std::vector<sample::FingerprintRow> World::survey_scans(core::FloorId floor,
                                                        const Vector2& position_m,
                                                        std::size_t count, Facing facing) const {
  RadioOptions radio = parts_->scenario.radio;
  if (facing == Facing::kNone) radio.body_loss_db = 0.0;
  const std::uint64_t seed = detail::derive_seed(parts_->scenario.seed, "survey");
  detail::Receiver receiver(parts_->radio, radio, reference_phone(), std::nullopt,
                            core::Rng(detail::derive_seed(seed, name_of(floor, position_m))));
  detail::BodyState body;
  body.floor = floor;
  body.position_m = position_m;
  std::vector<sample::FingerprintRow> rows;
  for (std::size_t i = 0; i < count; ++i) {
    body.heading_rad = 0.5 * core::kPi * static_cast<double>(i % 4);
    // Fading has long forgotten the scan before.
    constexpr double kForgotten_times = 50.0;
    const double t_s = static_cast<double>(i) * kForgotten_times * radio.temporal_time_s;
    sample::FingerprintRow row;
    row.building = parts_->scenario.building.name;
    row.floor = parts_->scenario.building.floor(floor).name;
    row.position_m = position_m;
    row.readings = parts_->hear_all(receiver, body, t_s);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<sample::WifiScan> World::standing_scans(const Standing& standing, std::size_t count,
                                                    double interval_s, std::string_view who) const {
  WAYLODE_ASSERT(interval_s > 0.0);
  const std::uint64_t seed = parts_->scenario.seed;
  detail::Receiver receiver(
      parts_->radio, parts_->scenario.radio, reference_phone(), detail::derive_seed(seed, "drift"),
      core::Rng(detail::derive_seed(detail::derive_seed(seed, "standing"), who)));
  detail::BodyState body;
  body.floor = standing.floor;
  body.position_m = standing.position_m;
  body.heading_rad = standing.heading_rad;
  std::vector<sample::WifiScan> scans;
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) * interval_s;
    scans.push_back({core::device_time_from_seconds(t_s), parts_->hear_all(receiver, body, t_s)});
  }
  return scans;
}

std::optional<double> World::mean_rssi_dbm(core::TransmitterId transmitter, core::FloorId floor,
                                           const Vector2& position_m) const {
  const auto& emitters = parts_->radio.emitters();
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    if (emitters[i].id == transmitter) return parts_->radio.mean_rssi_dbm(i, floor, position_m);
  }
  return std::nullopt;
}

std::vector<core::TransmitterId> World::transmitters() const {
  std::vector<core::TransmitterId> ids;
  for (const detail::Emitter& emitter : parts_->radio.emitters()) ids.push_back(emitter.id);
  return ids;
}

core::Vector3 World::field_ut(core::FloorId floor, const Vector2& position_m,
                              double height_m) const {
  return parts_->magnetic.at(floor, position_m, height_m);
}

}  // namespace waylode::sim
