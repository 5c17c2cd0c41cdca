// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/receiver.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/sim/detail/seeds.hpp"

namespace waylode::sim::detail {

namespace {

/// Where in a sweep a channel comes up, 0 to 1: the low band first.
double place_in_sweep(std::int32_t frequency_mhz) {
  constexpr double kLowBandShare = 0.4;
  if (frequency_mhz < 3000) return kLowBandShare * (frequency_mhz - 2412) / (2484.0 - 2412.0);
  return kLowBandShare + (1.0 - kLowBandShare) * (frequency_mhz - 5180) / (5885.0 - 5180.0);
}

}  // namespace

Receiver::Receiver(const RadioWorld& world, const RadioOptions& radio, const PhoneOptions& phone,
                   std::optional<std::uint64_t> drift_seed, core::Rng rng)
    : world_(world), radio_(radio), phone_(phone), rng_(std::move(rng)) {
  fading_.resize(world.emitters().size());
  means_.resize(world.emitters().size());
  for (const Emitter& emitter : world.emitters()) {
    core::Rng drift(derive_seed(drift_seed.value_or(0), "drift/" + emitter.name));
    drift_db_.push_back(drift_seed ? drift.normal(0.0, radio.drift_sigma_db) : 0.0);
  }
}

double Receiver::mean_dbm(std::size_t emitter, const BodyState& body) {
  Mean& mean = means_[emitter];
  const bool is_same =
      mean.is_known && mean.floor == body.floor && mean.position_m == body.position_m;
  if (!is_same) {
    mean = {body.floor, body.position_m, world_.mean_rssi_dbm(emitter, body.floor, body.position_m),
            true};
  }
  return mean.rssi_dbm;
}

double Receiver::fading_db(std::size_t emitter, double t_s) {
  Fading& fading = fading_[emitter];
  const double dt_s = std::max(0.0, t_s - fading.t_s);
  const double kept = fading.is_started ? std::exp(-dt_s / radio_.temporal_time_s) : 0.0;
  fading.value = kept * fading.value + std::sqrt(1.0 - kept * kept) * rng_.normal();
  fading.t_s = t_s;
  fading.is_started = true;
  return radio_.temporal_sigma_db * fading.value;
}

double Receiver::body_db(std::size_t emitter, const BodyState& body) const {
  const core::Vector2 towards = world_.emitters()[emitter].position_m - body.position_m;
  const double distance_m = towards.norm();
  if (distance_m < 0.5) return 0.0;
  const core::Vector2 ahead(std::cos(body.heading_rad), std::sin(body.heading_rad));
  // The phone is in front of the body: full loss for a transmitter behind, none for one ahead.
  const double cosine = ahead.dot(towards) / distance_m;
  const double share =
      radio_.body_shadows_behind_only ? std::max(0.0, -cosine) : 0.5 * (1.0 - cosine);
  return -radio_.body_loss_db * share;
}

std::optional<float> Receiver::hear(std::size_t emitter, const BodyState& body, double t_s) {
  const double on_air_dbm = mean_dbm(emitter, body) + drift_db_[emitter] + body_db(emitter, body) +
                            fading_db(emitter, t_s);
  const double level = (on_air_dbm - radio_.detection_threshold_dbm) / radio_.detection_softness_db;
  if (rng_.uniform() >= 1.0 / (1.0 + std::exp(-level))) return std::nullopt;
  constexpr double kMiddle_dbm = -60.0;
  const double shown_dbm =
      kMiddle_dbm + phone_.rssi_gain_ratio * (on_air_dbm - kMiddle_dbm) + phone_.rssi_offset_db;
  return static_cast<float>(std::clamp(std::round(shown_dbm), -110.0, -10.0));
}

void Receiver::sense_wifi(const Walk& walk, core::DeviceTime epoch,
                          std::vector<sample::Sample>& samples) {
  std::vector<std::optional<Cached>> cache(world_.emitters().size());
  const double sweep_s = std::min(phone_.scan_sweep_s, 0.9 * phone_.scan_interval_s);
  constexpr double kRounding_s = 1e-6;
  const double oldest_s =
      std::max(sweep_s + phone_.scan_delay_s, phone_.scan_cache_s) + kRounding_s;
  double delivery_s = phone_.scan_delay_s + rng_.uniform(0.2, 1.0) * phone_.scan_interval_s;
  for (; delivery_s <= walk.duration_s(); delivery_s += phone_.scan_interval_s) {
    sample::WifiScan scan;
    scan.time = epoch + core::from_seconds(delivery_s);
    for (std::size_t i = 0; i < world_.emitters().size(); ++i) {
      const Emitter& emitter = world_.emitters()[i];
      if (emitter.id.kind() != core::TransmitterId::Kind::kWifi) continue;
      const double into_sweep = place_in_sweep(emitter.frequency_mhz) + 0.03 * rng_.uniform();
      const double heard_s =
          delivery_s - phone_.scan_delay_s - sweep_s * (1.0 - std::min(1.0, into_sweep));
      const bool is_missed = rng_.uniform() < phone_.scan_miss_ratio || heard_s < 0.0;
      if (!is_missed) {
        if (const auto rssi_dbm = hear(i, walk.at(heard_s), heard_s)) {
          cache[i] = Cached{*rssi_dbm, heard_s};
        }
      }
      if (!cache[i] || delivery_s - cache[i]->heard_s > oldest_s) continue;
      scan.readings.push_back({emitter.id, cache[i]->rssi_dbm, emitter.frequency_mhz,
                               epoch + core::from_seconds(cache[i]->heard_s), "waylode-sim"});
    }
    samples.push_back(std::move(scan));
  }
}

void Receiver::sense_bluetooth(const Walk& walk, core::DeviceTime epoch,
                               std::vector<sample::Sample>& samples) {
  const double interval_s = 1.0 / radio_.advertisement_rate_hz;
  for (std::size_t i = 0; i < world_.emitters().size(); ++i) {
    const Emitter& emitter = world_.emitters()[i];
    if (emitter.id.kind() != core::TransmitterId::Kind::kBluetooth) continue;
    // Advertisements come with up to 10 ms of random delay, and phones listen off and on.
    for (double t_s = interval_s * rng_.uniform(); t_s <= walk.duration_s();
         t_s += interval_s * rng_.uniform(0.8, 1.2)) {
      const auto rssi_dbm = hear(i, walk.at(t_s), t_s);
      if (!rssi_dbm) continue;
      const double noise_db = std::round(rng_.normal(0.0, radio_.bluetooth_noise_db));
      sample::BleReading reading;
      reading.time = epoch + core::from_seconds(t_s);
      reading.transmitter = emitter.id;
      reading.rssi_dbm = *rssi_dbm + static_cast<float>(noise_db);
      reading.tx_power_dbm = static_cast<float>(radio_.bluetooth_power_dbm);
      reading.beacon = "simulated/" + emitter.name;
      samples.push_back(std::move(reading));
    }
  }
}

}  // namespace waylode::sim::detail
