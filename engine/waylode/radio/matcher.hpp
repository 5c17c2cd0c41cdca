// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/site/radio_map.hpp"

namespace waylode::radio {

/// What was heard of one transmitter, as it enters the comparison.
struct QueryReading {
  core::TransmitterId transmitter;
  float rssi_dbm = 0.0F;
  float age_s = 0.0F;  ///< How long before delivery it was heard.
};

/// How two scans are compared, after every RSSI was turned into a positive strength ("powed").
/// All four decompose over the transmitters heard in common, so the inverted index is exact.
/// [TorresSospedra2015] names and compares them.
enum class Distance : std::uint8_t {
  kEuclidean,
  kManhattan,
  kSorensen,        ///< sum |q - f| / sum (q + f), in [0, 1].
  kCosine,          ///< 1 - cos, in [0, 1].
  kSorensenCosine,  ///< Sorensen + 0.5 cosine.
};

struct Neighbour {
  std::uint32_t fingerprint = 0;  ///< Index into RadioMap::fingerprints.
  float distance = 0.0F;

  bool operator==(const Neighbour&) const = default;
};

/// The nearest fingerprints of one floor.
struct FloorMatch {
  core::FloorId floor;
  std::vector<Neighbour> neighbours;  ///< By rising distance, then index.
};

struct MatchResult {
  /// Share of the query's strength that comes from transmitters in the map, 0 to 1.
  float known_share_ratio = 0.0F;
  std::size_t compared = 0;  ///< Fingerprints that share a transmitter with the query.
  std::vector<FloorMatch>
      floors;  ///< Floors with at least one fingerprint that shares a transmitter.
};

/// Compares a scan with every fingerprint of a radio map. Immutable, so any number of sessions
/// share one. Exact: the result equals that of comparing the full vectors one by one. Wi-Fi counts
/// only for a scan that has Wi-Fi, Bluetooth only for one that has Bluetooth: a phone that does not
/// listen tells nothing by its silence.
class Matcher {
 public:
  struct Options {
    Distance distance = Distance::kSorensenCosine;
    /// Strength of an RSSI: ((rssi - floor_dbm) / -floor_dbm)^exponent; at or below the floor a
    /// trace remains, so that having heard still differs from not having heard.
    float floor_dbm = -105.0F;
    float exponent = 2.0F;
    /// Strength fades by this factor per second of age beyond one. 1 switches it off.
    float age_decay_per_s = 0.85F;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `map`'s storage must outlive the matcher.
  static core::Result<Matcher> create(const site::RadioMap& map, const Options& options);

  /// The `count` nearest fingerprints on every floor, or on one. A transmitter is named once at
  /// most. Readings the map does not know count as heard here and not there.
  MatchResult match(std::span<const QueryReading> readings, std::size_t count,
                    std::optional<core::FloorId> only_floor = std::nullopt) const;

  const site::RadioMap& map() const { return map_; }
  /// The strength of a reading; positive.
  float strength(float rssi_dbm, float age_s) const;

 private:
  Matcher(const site::RadioMap& map, const Options& options);

  struct FloorRange {
    core::FloorId floor;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  struct StrengthSums {
    float strength = 0.0F;
    float square = 0.0F;
  };

  site::RadioMap map_;
  Options options_;
  std::vector<float> posting_strength_;  ///< Parallel to map_.postings.
  /// Per fingerprint: of its Wi-Fi (and column) readings, and of its Bluetooth readings.
  std::vector<std::array<StrengthSums, 2>> sums_;
  std::vector<FloorRange> floors_;
};

}  // namespace waylode::radio
