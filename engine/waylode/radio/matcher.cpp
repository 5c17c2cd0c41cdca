// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace waylode::radio {
namespace {

/// Index into a fingerprint's sums.
std::size_t band_of(core::TransmitterId transmitter) {
  return transmitter.kind() == core::TransmitterId::Kind::kBluetooth ? 1 : 0;
}

/// Sums over the transmitters that query and fingerprint share, per fingerprint of a range.
struct CommonSums {
  std::vector<float> minimum;
  std::vector<float> product;
};

/// Distance from the common sums: |q-f| sums to q + f - 2 min(q, f), and so on.
template <typename Sums>
float distance_from_sums(Distance distance, const Sums& query, const Sums& other, float minimum,
                         float product) {
  const auto sorensen = [&] { return 1.0F - 2.0F * minimum / (query.strength + other.strength); };
  const auto cosine = [&] { return 1.0F - product / std::sqrt(query.square * other.square); };
  switch (distance) {
    case Distance::kEuclidean:
      return std::sqrt(std::max(0.0F, query.square + other.square - 2.0F * product));
    case Distance::kManhattan:
      return std::max(0.0F, query.strength + other.strength - 2.0F * minimum);
    case Distance::kSorensen:
      return std::max(0.0F, sorensen());
    case Distance::kCosine:
      return std::max(0.0F, cosine());
    case Distance::kSorensenCosine:
      break;
  }
  constexpr float kCosineShare = 0.5F;
  return std::max(0.0F, sorensen() + kCosineShare * cosine());
}

std::vector<Neighbour> keep_nearest(std::vector<Neighbour> all, std::size_t count) {
  const auto nearer = [](const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.fingerprint < b.fingerprint;
  };
  if (all.size() > count) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                     nearer);
    all.resize(count);
  }
  std::ranges::sort(all, nearer);
  return all;
}

}  // namespace

core::Result<void> Matcher::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "matcher");
  };
  if (!(floor_dbm < -50.0F && floor_dbm >= -127.5F)) {
    return refuse("floor_dbm must be in [-127.5, -50)");
  }
  if (!(exponent > 0.0F && exponent <= 10.0F)) return refuse("exponent must be in (0, 10]");
  if (!(age_decay_per_s > 0.0F && age_decay_per_s <= 1.0F)) {
    return refuse("age_decay_per_s must be in (0, 1]");
  }
  return {};
}

core::Result<Matcher> Matcher::create(const site::RadioMap& map, const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return Matcher(map, options);
}

Matcher::Matcher(const site::RadioMap& map, const Options& options)
    : map_(map),
      options_(options),
      posting_strength_(map.postings.size()),
      sums_(map.fingerprints.size()) {
  for (std::size_t t = 0; t < map_.transmitters.size(); ++t) {
    const std::size_t band = band_of(core::TransmitterId::from_packed(map_.transmitters[t]));
    for (std::uint32_t i = map_.posting_begin[t]; i < map_.posting_begin[t + 1]; ++i) {
      const site::Posting& posting = map_.postings[i];
      const float value =
          strength(posting.rssi_dbm(), 0.1F * static_cast<float>(posting.age_tenth_s));
      posting_strength_[i] = value;
      sums_[posting.fingerprint][band].strength += value;
      sums_[posting.fingerprint][band].square += value * value;
    }
  }
  for (std::uint32_t i = 0; i < map_.fingerprints.size(); ++i) {
    const core::FloorId floor{map_.fingerprints[i].floor};
    if (floors_.empty() || floors_.back().floor != floor) floors_.push_back({floor, i, i});
    floors_.back().end = i + 1;
  }
}

float Matcher::strength(float rssi_dbm, float age_s) const {
  constexpr float kTrace = 0.01F;  // Of full scale, before the power: heard, if only just.
  const float scaled = std::max(kTrace, (rssi_dbm - options_.floor_dbm) / -options_.floor_dbm);
  const float fresh = std::pow(options_.age_decay_per_s, std::max(0.0F, age_s - 1.0F));
  return std::pow(scaled, options_.exponent) * fresh;
}

MatchResult Matcher::match(std::span<const QueryReading> readings, std::size_t count,
                           std::optional<core::FloorId> only_floor) const {
  std::uint32_t begin = 0;
  auto end = static_cast<std::uint32_t>(map_.fingerprints.size());
  if (only_floor) {
    const auto range = std::ranges::find(floors_, *only_floor, &FloorRange::floor);
    if (range == floors_.end()) return {};
    begin = range->begin;
    end = range->end;
  }

  StrengthSums query;
  std::array<float, 2> listens = {0.0F, 0.0F};  // 1 for a kind that the query holds.
  float known_strength = 0.0F;
  CommonSums common{std::vector<float>(end - begin, 0.0F), std::vector<float>(end - begin, 0.0F)};
  for (const QueryReading& reading : readings) {
    const float value = strength(reading.rssi_dbm, reading.age_s);
    query.strength += value;
    query.square += value * value;
    listens[band_of(reading.transmitter)] = 1.0F;
    const auto postings = map_.postings_of(reading.transmitter);
    if (postings.empty()) continue;
    known_strength += value;
    const auto first_index = static_cast<std::size_t>(postings.data() - map_.postings.data());
    const auto first = std::ranges::lower_bound(postings, begin, {}, &site::Posting::fingerprint);
    for (auto posting = first; posting != postings.end() && posting->fingerprint < end; ++posting) {
      const float other =
          posting_strength_[first_index + static_cast<std::size_t>(posting - postings.begin())];
      common.minimum[posting->fingerprint - begin] += std::min(value, other);
      common.product[posting->fingerprint - begin] += value * other;
    }
  }

  MatchResult result;
  if (query.strength > 0.0F) result.known_share_ratio = known_strength / query.strength;
  for (const FloorRange& range : floors_) {
    if (only_floor && range.floor != *only_floor) continue;
    std::vector<Neighbour> sharing;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const float minimum = common.minimum[i - begin];
      if (minimum <= 0.0F) continue;
      const auto& [wifi, bluetooth] = sums_[i];
      const StrengthSums other{listens[0] * wifi.strength + listens[1] * bluetooth.strength,
                               listens[0] * wifi.square + listens[1] * bluetooth.square};
      sharing.push_back({i, distance_from_sums(options_.distance, query, other, minimum,
                                               common.product[i - begin])});
    }
    if (sharing.empty()) continue;
    result.compared += sharing.size();
    result.floors.push_back({range.floor, keep_nearest(std::move(sharing), count)});
  }
  return result;
}

}  // namespace waylode::radio
