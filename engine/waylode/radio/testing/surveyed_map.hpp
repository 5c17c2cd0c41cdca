// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/core/time.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/site/radio_map.hpp"

/// Small radio maps for tests.
namespace waylode::radio::testing {

/// What Wi-Fi transmitters 1, 2, ... were heard with; 0 for not heard.
struct Surveyed {
  std::uint16_t floor = 0;
  core::Vector2 position_m = core::Vector2::Zero();
  std::vector<float> rssi_dbm;
};

inline site::RadioMapStorage map_of(const std::vector<Surveyed>& fingerprints) {
  site::RadioMapBuilder builder;
  for (const Surveyed& surveyed : fingerprints) {
    site::FingerprintRecord record;
    record.floor = surveyed.floor;
    record.x_m = static_cast<float>(surveyed.position_m.x());
    record.y_m = static_cast<float>(surveyed.position_m.y());
    std::vector<site::MapReading> readings;
    for (std::size_t i = 0; i < surveyed.rssi_dbm.size(); ++i) {
      if (surveyed.rssi_dbm[i] != 0.0F) {
        readings.push_back({core::TransmitterId::wifi(i + 1), surveyed.rssi_dbm[i], 0.0F});
      }
    }
    builder.add(record, std::move(readings));
  }
  return builder.build();
}

inline Query query_of(const std::vector<float>& rssi_dbm) {
  Query query{core::device_time_from_ms(7'300), core::device_time_from_ms(8'000), {}};
  for (std::size_t i = 0; i < rssi_dbm.size(); ++i) {
    if (rssi_dbm[i] != 0.0F) {
      query.readings.push_back({core::TransmitterId::wifi(i + 1), rssi_dbm[i], 0.0F});
    }
  }
  return query;
}

/// A hall of 16 m x 15 m with a transmitter near each corner, surveyed on a grid of 1 m: the mean
/// of `readings_each` readings, 3 dB of noise each, 3.5 of path loss.
class Hall {
 public:
  explicit Hall(core::Rng& rng, int readings_each = 20) {
    for (int i = 0; i < 16 * 15; ++i) {
      const core::Vector2 place_m(0.5 + i % 16, 0.5 + i / 16);
      Surveyed surveyed{2, place_m, std::vector<float>(4, 0.0F)};
      for (int k = 0; k < readings_each; ++k) {
        const std::vector<float> scan = scan_at(place_m, rng);
        for (std::size_t t = 0; t < 4; ++t) {
          surveyed.rssi_dbm[t] += scan[t] / static_cast<float>(readings_each);
        }
      }
      survey.push_back(std::move(surveyed));
    }
  }

  static std::vector<float> scan_at(const core::Vector2& place_m, core::Rng& rng) {
    static constexpr std::array<std::array<double, 2>, 4> kAt_m = {
        {{1.3, 2.1}, {14.2, 1.7}, {2.4, 13.6}, {13.1, 12.9}}};
    std::vector<float> rssi_dbm;
    for (const auto& [x_m, y_m] : kAt_m) {
      const double away_m = std::hypot(place_m.x() - x_m, place_m.y() - y_m);
      const double mean_dbm = -35.0 - 35.0 * std::log10(std::max(away_m, 0.5) / 2.0);
      rssi_dbm.push_back(static_cast<float>(mean_dbm + 3.0 * rng.normal()));
    }
    return rssi_dbm;
  }

  std::vector<Surveyed> survey;
};

/// How far off a method is over many scans at random places of a hall.
struct HallErrors {
  double mean_m = 0.0;
  double mean_square_mahalanobis = 0.0;  ///< 2 when covariances are honest.
  double mean_comparisons = 0.0;
};

inline HallErrors errors_in_hall(const Positioner& positioner, core::Rng& rng, int scans = 400) {
  HallErrors errors;
  for (int i = 0; i < scans; ++i) {
    const core::Vector2 truth_m(rng.uniform(1.0, 15.0), rng.uniform(1.0, 14.0));
    const auto seen =
        positioner.estimate(query_of(Hall::scan_at(truth_m, rng)), std::nullopt, std::nullopt);
    if (!seen) continue;
    const observation::FloorHypothesis& best = seen->observation.floors.front();
    const core::Vector2 error_m = best.position_m - truth_m;
    errors.mean_m += error_m.norm() / scans;
    errors.mean_square_mahalanobis +=
        core::squared_mahalanobis(error_m, best.covariance_m2) / scans;
    errors.mean_comparisons += static_cast<double>(seen->comparisons) / scans;
  }
  return errors;
}

}  // namespace waylode::radio::testing
