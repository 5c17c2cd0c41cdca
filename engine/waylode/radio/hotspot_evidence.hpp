// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/radio/path_loss.hpp"

namespace waylode::radio {

/// Tells by what surveys heard whether a transmitter moves, for those of whom a HotspotClassifier
/// is unsure. A transmitter that stays put is loud near one place only, is heard at every visit
/// there, and falls off with distance from it.
class HotspotEvidence {
 public:
  struct Options {
    float loud_dbm = -62.0F;   ///< Heard this loudly, a transmitter is near; below 0.
    double farthest_m = 30.0;  ///< Loud places of one floor farther apart mean it moved; above 0.
    /// Of the visits that came within visit_radius_m of its loudest place, at least this share hear
    /// one that stays; 0 to 1, 0 asks for nothing. Only for one that was ever loud.
    double min_visit_ratio = 0.25;
    std::size_t min_visits = 4;   ///< Fewer visits prove nothing; from 1.
    double visit_radius_m = 5.0;  ///< Above 0.
    /// Residual about the best place and path loss, standard deviation; above 0, infinite asks for
    /// nothing.
    double max_residual_db = 12.0;
    std::size_t min_readings = 20;  ///< Fewer on a floor prove nothing; from 5.
    TransmitterLocator::Options locator{};

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// What speaks for a transmitter's moving.
  struct Finding {
    double loud_extent_m = 0.0;         ///< Diagonal of the loud places, the largest of floors.
    std::optional<double> visit_ratio;  ///< Where there were enough visits.
    std::optional<double> residual_db;  ///< Where there were enough readings; largest of floors.
    bool is_loud_apart = false;
    bool is_rarely_seen = false;
    bool fits_no_place = false;

    bool moves() const { return is_loud_apart || is_rarely_seen || fits_no_place; }
  };

  /// `options` must be valid.
  explicit HotspotEvidence(const Options& options) : options_(options) {}

  /// A new walk or day begins. What comes before the first belongs to one of its own.
  void begin_visit() { ++visit_; }
  /// The surveyor was here and listened. Places that are not finite are passed over.
  void pass(core::FloorId floor, const core::Vector2& position_m);
  /// Heard here; passes here, too.
  void hear(core::TransmitterId transmitter, float rssi_dbm, core::FloorId floor,
            const core::Vector2& position_m);

  /// Nothing speaks against one never heard.
  Finding finding(core::TransmitterId transmitter) const;

 private:
  /// Keeps every stride-th reading, so that a long survey does not grow without bound.
  struct OnFloor {
    std::optional<core::Bounds2> loud;
    std::vector<PlacedReading> readings;
    std::size_t stride = 1;
    std::size_t heard = 0;
  };
  struct Heard {
    std::map<core::FloorId, OnFloor> floors;
    std::set<std::uint32_t> visits;
    float loudest_dbm = -1e9F;
    core::FloorId loudest_floor;
    core::Vector2 loudest_m = core::Vector2::Zero();
  };

  void keep(OnFloor& floor, const PlacedReading& reading) const;
  std::optional<double> visit_ratio(const Heard& heard) const;
  std::optional<double> residual_db(const Heard& heard) const;

  Options options_;
  std::uint32_t visit_ = 0;
  std::map<core::TransmitterId, Heard> heard_;
  /// Places passed, by floor and visit; neighbours of one visit thinned out.
  std::map<core::FloorId, std::map<std::uint32_t, std::vector<core::Vector2>>> passed_;
};

}  // namespace waylode::radio
