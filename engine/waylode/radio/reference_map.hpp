// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/radio/domain_filter.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/site/radio_map.hpp"

namespace waylode::radio {

/// Which transmitters the distance between a scan and a point runs over.
enum class Compared : std::uint8_t {
  kUnion,       ///< Those of either; the fill value stands for the one that did not hear.
  kQuery,       ///< Those of the scan.
  kCommonMean,  ///< Those of both, as root mean square per transmitter; infinite without any.
};

/// A scan over the transmitters of one map.
struct ReferenceQuery {
  struct Heard {
    std::uint32_t transmitter = 0;  ///< Index into ReferenceMap::transmitters().
    double excess_db = 0.0;         ///< RSSI over the fill value.
  };
  std::vector<Heard> heard;        ///< Ascending by transmitter. Strange transmitters are left out.
  std::vector<double> excess_db;   ///< Per transmitter; 0 not heard, NaN of a kind not listened to.
  double known_share_ratio = 0.0;  ///< Share of the strength over fill that the map knows.
};

/// The instances of a radio map gathered to reference points, for methods that compare plain RSSI
/// vectors point by point. Owns its data; immutable. Stores what was heard only, so that 20,000
/// points by 500 transmitters cost what was heard of them.
class ReferenceMap {
 public:
  struct Options {
    /// Instances of a floor that near to a point's first one become that point; 0 to 100. A survey
    /// made walking wants 1 m or 2 m, one of standing at marks the default.
    double merge_radius_m = 0.5;
    float fill_dbm = -100.0F;        ///< Stands for a transmitter not heard; -127.5 to -50.
    DomainFilter::Options filter{};  ///< Over the readings of one transmitter at one point.
    /// Transmitters that a smaller share of a point's instances heard are left out of it; 0 to 1.
    double min_heard_ratio = 0.0;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  struct Reading {
    std::uint32_t transmitter = 0;  ///< Index into transmitters().
    std::uint32_t count = 0;        ///< Readings behind it.
    float mean_dbm = 0.0F;          ///< After the filter.
    float sigma_db = 0.0F;
  };

  struct Point {
    core::FloorId floor;
    core::Vector2 position_m = core::Vector2::Zero();  ///< Mean of its instances, floor frame.
    std::uint32_t instances = 0;
    std::uint32_t first_reading = 0;
    std::uint32_t reading_count = 0;
    /// Of largest mean, Bluetooth only where there is nothing else; kNobody without readings.
    std::uint32_t strongest = kNobody;
  };

  /// Points first, first + 1, ..., last - 1.
  struct FloorRange {
    core::FloorId floor;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };

  /// What the making of the map did to its readings.
  struct Report {
    std::size_t instances = 0;
    std::size_t instances_unplaced = 0;  ///< Passed over: their place is not finite.
    std::size_t readings = 0;
    std::size_t readings_replaced = 0;  ///< By the domain filter.
    std::size_t readings_rare = 0;      ///< Left out by min_heard_ratio.
  };

  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  /// `map` is read once and may go. A map without fingerprints gives a map without points.
  static core::Result<ReferenceMap> create(const site::RadioMap& map, const Options& options);

  std::span<const Point> points() const { return points_; }
  std::span<const FloorRange> floors() const { return floors_; }
  std::span<const core::TransmitterId> transmitters() const { return transmitters_; }
  /// Ascending by transmitter.
  std::span<const Reading> readings_of(std::uint32_t point) const;
  /// The points of a floor that heard a transmitter, ascending.
  std::span<const std::uint32_t> points_hearing(std::uint32_t transmitter,
                                                core::FloorId floor) const;
  /// The points of a floor at which this transmitter is the strongest, ascending.
  std::span<const std::uint32_t> region_of(std::uint32_t transmitter, core::FloorId floor) const;
  /// NaN when the point did not hear it.
  float mean_dbm(std::uint32_t point, std::uint32_t transmitter) const;

  /// A transmitter that is named repeatedly counts with its mean; RSSI that is not finite is passed
  /// over.
  ReferenceQuery prepare(std::span<const QueryReading> readings) const;
  /// `query` must be of this map.
  double distance_db(const ReferenceQuery& query, std::uint32_t point, Compared compared) const;

  const Options& options() const { return options_; }
  const Report& report() const { return report_; }

 private:
  explicit ReferenceMap(const Options& options) : options_(options) {}

  /// Points per transmitter, ascending.
  struct Index {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> points;
  };

  void gather(const site::RadioMap& map);
  void number_transmitters(const site::RadioMap& map);
  void index();
  std::span<const std::uint32_t> on_floor(const Index& index, std::uint32_t transmitter,
                                          core::FloorId floor) const;

  Options options_;
  Report report_;
  std::vector<core::TransmitterId> transmitters_;  ///< Ascending.
  std::vector<Point> points_;                      ///< By floor.
  std::vector<FloorRange> floors_;
  std::vector<Reading> readings_;
  Index hearing_;
  Index regions_;
};

}  // namespace waylode::radio
