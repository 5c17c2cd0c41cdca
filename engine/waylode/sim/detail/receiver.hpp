// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "waylode/core/rng.hpp"
#include "waylode/core/time.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/sim/detail/radio_world.hpp"
#include "waylode/sim/detail/walk.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

/// One phone's radio on one walk: what is heard when, with fading in time, the owner's body, the
/// drift since the survey and the phone's own scale.
class Receiver {
 public:
  /// `drift_seed` gives the addresses' drift; nullopt for the survey, which has none.
  Receiver(const RadioWorld& world, const RadioOptions& radio, const PhoneOptions& phone,
           std::optional<std::uint64_t> drift_seed, core::Rng rng);

  /// What this phone would show at that instant, in whole decibels; nullopt when it hears nothing.
  /// Instants of one emitter must not run backwards.
  std::optional<float> hear(std::size_t emitter, const BodyState& body, double t_s);

  /// Wi-Fi deliveries over a whole walk: each a sweep over the channels before it, with readings
  /// missed by the sweep repeated from the cache.
  void sense_wifi(const Walk& walk, core::DeviceTime epoch, std::vector<sample::Sample>& samples);
  /// Advertisements of the beacons.
  void sense_bluetooth(const Walk& walk, core::DeviceTime epoch,
                       std::vector<sample::Sample>& samples);

 private:
  struct Fading {
    double value = 0.0;  ///< In sigmas.
    double t_s = 0.0;
    bool is_started = false;
  };
  /// The mean at the last place, which standing people ask for again and again.
  struct Mean {
    core::FloorId floor;
    core::Vector2 position_m = core::Vector2::Zero();
    double rssi_dbm = 0.0;
    bool is_known = false;
  };
  struct Cached {
    float rssi_dbm = 0.0F;
    double heard_s = 0.0;
  };

  double mean_dbm(std::size_t emitter, const BodyState& body);
  double fading_db(std::size_t emitter, double t_s);
  double body_db(std::size_t emitter, const BodyState& body) const;

  const RadioWorld& world_;
  RadioOptions radio_;
  PhoneOptions phone_;
  core::Rng rng_;
  std::vector<double> drift_db_;
  std::vector<Fading> fading_;
  std::vector<Mean> means_;
};

}  // namespace waylode::sim::detail
