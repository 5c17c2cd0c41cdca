// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "waylode/core/id.hpp"

namespace waylode::site {

/// One surveyed instance: what was heard at one place at one time. Fixed layout: it is stored.
struct FingerprintRecord {
  float x_m = 0.0F;  ///< Floor frame.
  float y_m = 0.0F;
  float position_sigma_m = 0.0F;  ///< Of the label, per axis.
  std::uint32_t recording = 0;  ///< Which surveyed walk; instances of one walk are not independent.
  std::uint16_t floor = 0;      ///< FloorId.
  std::uint16_t reading_count = 0;

  bool operator==(const FingerprintRecord&) const = default;
};
static_assert(sizeof(FingerprintRecord) == 20);

/// That a fingerprint heard a transmitter. RSSI in units of 0.5 dB: rssi_dbm = -0.5 * half_db.
struct Posting {
  std::uint32_t fingerprint = 0;
  std::uint8_t attenuation_half_db = 0;
  std::uint8_t age_tenth_s = 0;  ///< Time from hearing to delivery, 0.1 s, saturated at 25.5 s.
  std::uint16_t reserved = 0;

  float rssi_dbm() const { return -0.5F * static_cast<float>(attenuation_half_db); }
  bool operator==(const Posting&) const = default;
};
static_assert(sizeof(Posting) == 8);

/// The surveyed instances of a whole site as an inverted index: for each transmitter, who heard it.
/// A view; the storage (a mapped bundle or RadioMapStorage) must outlive it.
struct RadioMap {
  std::span<const FingerprintRecord> fingerprints;  ///< Sorted by floor.
  std::span<const std::uint64_t> transmitters;      ///< Packed TransmitterIds, ascending.
  std::span<const std::uint32_t> posting_begin;     ///< Per transmitter + 1, into postings.
  std::span<const Posting> postings;  ///< Per transmitter by rising fingerprint index.

  bool empty() const { return fingerprints.empty(); }
  /// The postings of a transmitter; empty when the map does not know it.
  std::span<const Posting> postings_of(core::TransmitterId transmitter) const;
};

/// Owns what a RadioMap views.
struct RadioMapStorage {
  std::vector<FingerprintRecord> fingerprints;
  std::vector<std::uint64_t> transmitters;
  std::vector<std::uint32_t> posting_begin;
  std::vector<Posting> postings;

  RadioMap view() const { return {fingerprints, transmitters, posting_begin, postings}; }
  bool operator==(const RadioMapStorage&) const = default;
};

/// A reading as it goes into a map.
struct MapReading {
  core::TransmitterId transmitter;
  float rssi_dbm = 0.0F;
  float age_s = 0.0F;
};

/// Collects fingerprints in any order and freezes them into an index.
class RadioMapBuilder {
 public:
  /// `record.reading_count` is filled in. A transmitter named twice keeps the last reading.
  void add(FingerprintRecord record, std::vector<MapReading> readings);
  std::size_t size() const { return entries_.size(); }
  /// Same input in the same order gives the same bytes.
  RadioMapStorage build() const;

 private:
  struct Entry {
    FingerprintRecord record;
    std::vector<MapReading> readings;
  };
  std::vector<Entry> entries_;
};

}  // namespace waylode::site
