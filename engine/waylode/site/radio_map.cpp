// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/radio_map.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace waylode::site {
namespace {

std::uint8_t saturate_to_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0F, 255.0F));
}

}  // namespace

std::span<const Posting> RadioMap::postings_of(core::TransmitterId transmitter) const {
  const auto found = std::ranges::lower_bound(transmitters, transmitter.packed());
  if (found == transmitters.end() || *found != transmitter.packed()) return {};
  const auto index = static_cast<std::size_t>(found - transmitters.begin());
  return postings.subspan(posting_begin[index], posting_begin[index + 1] - posting_begin[index]);
}

void RadioMapBuilder::add(FingerprintRecord record, std::vector<MapReading> readings) {
  std::ranges::stable_sort(readings, {}, &MapReading::transmitter);
  std::vector<MapReading> unique;
  unique.reserve(readings.size());
  for (const MapReading& reading : readings) {
    if (!unique.empty() && unique.back().transmitter == reading.transmitter) {
      unique.back() = reading;
    } else {
      unique.push_back(reading);
    }
  }
  record.reading_count = static_cast<std::uint16_t>(std::min<std::size_t>(unique.size(), 0xFFFF));
  entries_.push_back({record, std::move(unique)});
}

RadioMapStorage RadioMapBuilder::build() const {
  std::vector<std::size_t> order(entries_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return entries_[i].record.floor; });

  RadioMapStorage storage;
  std::map<std::uint64_t, std::vector<Posting>> postings;
  for (const std::size_t i : order) {
    const auto fingerprint = static_cast<std::uint32_t>(storage.fingerprints.size());
    storage.fingerprints.push_back(entries_[i].record);
    for (const MapReading& reading : entries_[i].readings) {
      postings[reading.transmitter.packed()].push_back(
          {fingerprint, saturate_to_byte(-2.0F * reading.rssi_dbm),
           saturate_to_byte(10.0F * reading.age_s), 0});
    }
  }
  storage.posting_begin.push_back(0);
  for (const auto& [transmitter, list] : postings) {
    storage.transmitters.push_back(transmitter);
    storage.postings.insert(storage.postings.end(), list.begin(), list.end());
    storage.posting_begin.push_back(static_cast<std::uint32_t>(storage.postings.size()));
  }
  return storage;
}

}  // namespace waylode::site
