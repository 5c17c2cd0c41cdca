// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/matcher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace waylode::radio {
namespace {

using core::FloorId;
using core::TransmitterId;
using site::MapReading;

constexpr Distance kAllDistances[] = {Distance::kEuclidean, Distance::kManhattan,
                                      Distance::kSorensen, Distance::kCosine,
                                      Distance::kSorensenCosine};

TransmitterId transmitter(std::uint64_t number) { return TransmitterId::wifi(number); }

/// Strength (rssi + 100) / 100, without fading by age: distances can be worked out by hand.
Matcher::Options plain_options(Distance distance) {
  return {.distance = distance, .floor_dbm = -100.0F, .exponent = 1.0F, .age_decay_per_s = 1.0F};
}

/// Fingerprints by rising floor, so that their indices are those of the map.
struct Surveyed {
  FloorId floor;
  std::vector<MapReading> readings;
};

site::RadioMapStorage map_of(const std::vector<Surveyed>& fingerprints) {
  site::RadioMapBuilder builder;
  for (const Surveyed& surveyed : fingerprints) {
    site::FingerprintRecord record;
    record.floor = surveyed.floor.index;
    builder.add(record, surveyed.readings);
  }
  return builder.build();
}

Matcher matcher_of(const site::RadioMapStorage& storage, const Matcher::Options& options) {
  return *Matcher::create(storage.view(), options);
}

bool is_bluetooth(TransmitterId id) { return id.kind() == TransmitterId::Kind::kBluetooth; }

/// The definitions, transmitter by transmitter over the whole vectors, in double precision; kinds
/// that the query holds none of are left out.
class DenseReference {
 public:
  explicit DenseReference(const Matcher::Options& options) : options_(options) {}

  double strength(double rssi_dbm, double age_s) const {
    const auto floor_dbm = static_cast<double>(options_.floor_dbm);
    const double scaled = std::max(0.01, (rssi_dbm - floor_dbm) / -floor_dbm);
    return std::pow(scaled, static_cast<double>(options_.exponent)) *
           std::pow(static_cast<double>(options_.age_decay_per_s), std::max(0.0, age_s - 1.0));
  }

  /// nullopt when nothing is shared.
  std::optional<double> distance(const std::vector<QueryReading>& query,
                                 const Surveyed& surveyed) const {
    std::map<TransmitterId, std::pair<double, double>> vectors;
    for (const auto& reading : query) {
      vectors[reading.transmitter].first =
          strength(static_cast<double>(reading.rssi_dbm), static_cast<double>(reading.age_s));
    }
    for (const auto& reading : surveyed.readings) {
      const bool listens = std::ranges::any_of(query, [&](const QueryReading& own) {
        return is_bluetooth(own.transmitter) == is_bluetooth(reading.transmitter);
      });
      if (!listens) continue;
      vectors[reading.transmitter].second =
          strength(static_cast<double>(reading.rssi_dbm), static_cast<double>(reading.age_s));
    }
    bool shared = false;
    double absolute = 0.0, square = 0.0, sum = 0.0, product = 0.0, norm_q = 0.0, norm_f = 0.0;
    for (const auto& [id, pair] : vectors) {
      const auto [q, f] = pair;
      shared = shared || (q > 0.0 && f > 0.0);
      absolute += std::abs(q - f);
      square += (q - f) * (q - f);
      sum += q + f;
      product += q * f;
      norm_q += q * q;
      norm_f += f * f;
    }
    if (!shared) return std::nullopt;
    const double cosine = 1.0 - product / std::sqrt(norm_q * norm_f);
    switch (options_.distance) {
      case Distance::kEuclidean:
        return std::sqrt(square);
      case Distance::kManhattan:
        return absolute;
      case Distance::kSorensen:
        return absolute / sum;
      case Distance::kCosine:
        return cosine;
      case Distance::kSorensenCosine:
        break;
    }
    return absolute / sum + 0.5 * cosine;
  }

 private:
  Matcher::Options options_;
};

/// Whole dB and tenths of a second: the map stores these exactly.
std::vector<MapReading> any_readings() {
  std::map<std::uint64_t, MapReading> readings;
  const int count = *rc::gen::inRange(0, 7);
  for (int i = 0; i < count; ++i) {
    const auto number = *rc::gen::inRange<std::uint64_t>(1, 9);
    readings[number] = {number <= 5 ? transmitter(number) : TransmitterId::bluetooth(number),
                        static_cast<float>(*rc::gen::inRange(-110, -20)),
                        0.1F * static_cast<float>(*rc::gen::inRange(0, 60))};
  }
  std::vector<MapReading> result;
  for (const auto& [number, reading] : readings) result.push_back(reading);
  return result;
}

std::vector<Surveyed> any_survey() {
  std::vector<Surveyed> fingerprints;
  for (std::uint16_t floor = 0; floor < 3; ++floor) {
    const int count = *rc::gen::inRange(0, 6);
    for (int i = 0; i < count; ++i) fingerprints.push_back({FloorId{floor}, any_readings()});
  }
  return fingerprints;
}

std::vector<QueryReading> any_query() {
  std::vector<QueryReading> query;
  for (const MapReading& reading : any_readings()) {
    query.push_back({reading.transmitter, reading.rssi_dbm, reading.age_s});
  }
  return query;
}

/// Differences of float sums: a Euclidean distance near zero keeps half of the digits.
double tolerance(Distance distance) { return distance == Distance::kEuclidean ? 3e-3 : 2e-5; }

void check_floor(const FloorMatch& match, std::size_t count, const std::vector<Surveyed>& survey,
                 const std::vector<QueryReading>& query, const Matcher::Options& options) {
  const DenseReference reference(options);
  const double slack = tolerance(options.distance);
  RC_ASSERT(std::ranges::is_sorted(match.neighbours, {}, [](const Neighbour& neighbour) {
    return std::pair(neighbour.distance, neighbour.fingerprint);
  }));
  std::size_t sharing = 0;
  for (std::uint32_t i = 0; i < survey.size(); ++i) {
    if (survey[i].floor != match.floor) continue;
    const auto expected = reference.distance(query, survey[i]);
    const auto found = std::ranges::find(match.neighbours, i, &Neighbour::fingerprint);
    if (expected) ++sharing;
    if (found != match.neighbours.end()) {
      RC_ASSERT(expected.has_value());
      RC_ASSERT(std::abs(static_cast<double>(found->distance) - *expected) < slack);
    } else if (expected) {
      RC_ASSERT(match.neighbours.size() == count);
      RC_ASSERT(*expected > static_cast<double>(match.neighbours.back().distance) - slack);
    }
  }
  RC_ASSERT(match.neighbours.size() == std::min(count, sharing));
}

RC_GTEST_PROP(Matcher, AgreesWithComparingTheFullVectors, ()) {
  const std::vector<Surveyed> survey = any_survey();
  const std::vector<QueryReading> query = any_query();
  const auto count = *rc::gen::inRange<std::size_t>(1, 5);
  const auto storage = map_of(survey);
  for (const Distance distance : kAllDistances) {
    const Matcher::Options options{
        .distance = distance, .floor_dbm = -105.0F, .exponent = 2.0F, .age_decay_per_s = 0.85F};
    const Matcher matcher = matcher_of(storage, options);
    const DenseReference reference(options);
    const MatchResult whole = matcher.match(query, count);
    std::size_t floors = 0;
    for (std::uint16_t index = 0; index < 3; ++index) {
      const FloorId floor{index};
      const bool shares = std::ranges::any_of(survey, [&](const Surveyed& surveyed) {
        return surveyed.floor == floor && reference.distance(query, surveyed);
      });
      const MatchResult one = matcher.match(query, count, floor);
      RC_ASSERT(one.floors.size() == (shares ? 1U : 0U));
      if (!shares) continue;
      const FloorMatch& on_whole_site = whole.floors.at(floors++);
      RC_ASSERT(on_whole_site.floor == floor);
      check_floor(on_whole_site, count, survey, query, options);
      RC_ASSERT(one.floors.front().floor == floor);
      RC_ASSERT(one.floors.front().neighbours == on_whole_site.neighbours);
    }
    RC_ASSERT(whole.floors.size() == floors);
  }
}

RC_GTEST_PROP(Matcher, DoesNotCareAboutTheOrderOfReadings, ()) {
  const auto storage = map_of(any_survey());
  std::vector<QueryReading> query = any_query();
  for (const Distance distance : kAllDistances) {
    const Matcher matcher = matcher_of(storage, plain_options(distance));
    const MatchResult forward = matcher.match(query, 100);
    std::ranges::reverse(query);
    const MatchResult backward = matcher.match(query, 100);
    RC_ASSERT(forward.floors.size() == backward.floors.size());
    for (std::size_t i = 0; i < forward.floors.size(); ++i) {
      std::map<std::uint32_t, double> distances;
      for (const auto& n : forward.floors[i].neighbours) {
        distances[n.fingerprint] = static_cast<double>(n.distance);
      }
      RC_ASSERT(distances.size() == backward.floors[i].neighbours.size());
      for (const auto& n : backward.floors[i].neighbours) {
        RC_ASSERT(std::abs(static_cast<double>(n.distance) - distances.at(n.fingerprint)) <
                  tolerance(distance));
      }
    }
  }
}

RC_GTEST_PROP(Matcher, IgnoresAnUnheardTransmitterInTheMap, ()) {
  std::vector<Surveyed> survey = any_survey();
  const std::vector<QueryReading> query = any_query();
  const auto before_storage = map_of(survey);
  // A fingerprint of its own, after all others, heard only the new one.
  survey.push_back({FloorId{7}, {{transmitter(99), -40.0F, 0.0F}}});
  const auto after_storage = map_of(survey);
  for (const Distance distance : kAllDistances) {
    const auto before = matcher_of(before_storage, plain_options(distance)).match(query, 4);
    const auto after = matcher_of(after_storage, plain_options(distance)).match(query, 4);
    RC_ASSERT(before.known_share_ratio == after.known_share_ratio);
    RC_ASSERT(before.floors.size() == after.floors.size());
    for (std::size_t i = 0; i < before.floors.size(); ++i) {
      RC_ASSERT(before.floors[i].floor == after.floors[i].floor);
      RC_ASSERT(before.floors[i].neighbours == after.floors[i].neighbours);
    }
  }
}

TEST(Matcher, CountsUnknownTransmittersAsHeardHereAndNotThere) {
  const auto storage = map_of({{FloorId{0}, {{transmitter(1), -40.0F, 0.0F}}}});
  const std::vector<QueryReading> query = {{transmitter(1), -40.0F, 0.0F},
                                           {transmitter(2), -80.0F, 0.0F}};
  // q = (0.6, 0.2), f = (0.6, 0).
  const std::map<Distance, double> expected = {
      {Distance::kEuclidean, 0.2},
      {Distance::kManhattan, 0.2},
      {Distance::kSorensen, 0.2 / 1.4},
      {Distance::kCosine, 1.0 - 0.6 / std::sqrt(0.4)},
      {Distance::kSorensenCosine, 0.2 / 1.4 + 0.5 * (1.0 - 0.6 / std::sqrt(0.4))}};
  for (const auto& [distance, value] : expected) {
    const auto match = matcher_of(storage, plain_options(distance)).match(query, 3);
    ASSERT_EQ(match.floors.size(), 1U);
    ASSERT_EQ(match.floors[0].neighbours.size(), 1U);
    EXPECT_NEAR(match.floors[0].neighbours[0].distance, value, 1e-6);
    EXPECT_NEAR(match.known_share_ratio, 0.6 / 0.8, 1e-6);
  }
}

TEST(Matcher, HoldsNoSilenceAgainstAPhoneThatDoesNotListen) {
  const auto storage = map_of(
      {{FloorId{0},
        {{TransmitterId::wifi(1), -40.0F, 0.0F}, {TransmitterId::bluetooth(2), -60.0F, 0.0F}}}});
  const Matcher matcher = matcher_of(storage, plain_options(Distance::kManhattan));
  const auto distance_of = [&](const std::vector<QueryReading>& query) {
    return matcher.match(query, 1).floors.at(0).neighbours.at(0).distance;
  };
  EXPECT_NEAR(distance_of({{TransmitterId::wifi(1), -50.0F, 0.0F}}), 0.1, 1e-6);
  EXPECT_NEAR(distance_of({{TransmitterId::bluetooth(2), -90.0F, 0.0F}}), 0.3, 1e-6);
  // Hears another beacon, so it would have heard this one: 0.1 + 0.4 + 0.2.
  EXPECT_NEAR(distance_of({{TransmitterId::wifi(1), -50.0F, 0.0F},
                           {TransmitterId::bluetooth(3), -80.0F, 0.0F}}),
              0.7, 1e-6);
}

TEST(Matcher, PutsEqualDistancesInOrderOfIndex) {
  const std::vector<MapReading> same = {{transmitter(1), -50.0F, 0.0F}};
  const std::vector<MapReading> nearer = {{transmitter(1), -61.0F, 0.0F}};
  const auto storage = map_of({{FloorId{0}, same},
                               {FloorId{0}, same},
                               {FloorId{0}, nearer},
                               {FloorId{0}, same},
                               {FloorId{0}, same}});
  const std::vector<QueryReading> query = {{transmitter(1), -60.0F, 0.0F}};
  const auto match = matcher_of(storage, plain_options(Distance::kManhattan)).match(query, 3);
  ASSERT_EQ(match.floors.size(), 1U);
  std::vector<std::uint32_t> order;
  for (const Neighbour& neighbour : match.floors[0].neighbours) {
    order.push_back(neighbour.fingerprint);
  }
  EXPECT_THAT(order, testing::ElementsAre(2U, 0U, 1U));
}

TEST(Matcher, GivesIdenticalVectorsNoDistance) {
  const std::vector<MapReading> heard = {{transmitter(1), -47.0F, 0.0F},
                                         {transmitter(2), -71.5F, 0.0F},
                                         {transmitter(3), -88.0F, 0.0F}};
  const auto storage = map_of({{FloorId{0}, heard}});
  const std::vector<QueryReading> query = {{transmitter(1), -47.0F, 0.0F},
                                           {transmitter(2), -71.5F, 0.0F},
                                           {transmitter(3), -88.0F, 0.0F}};
  for (const Distance distance : kAllDistances) {
    const auto match = matcher_of(storage, plain_options(distance)).match(query, 1);
    ASSERT_EQ(match.floors.size(), 1U);
    EXPECT_NEAR(match.floors[0].neighbours.at(0).distance, 0.0,
                distance == Distance::kEuclidean ? 5e-4 : 1e-6);
  }
}

TEST(Matcher, FindsNoNeighbourWhereNothingIsShared) {
  const auto storage = map_of({{FloorId{0}, {{transmitter(1), -40.0F, 0.0F}}}});
  const std::vector<QueryReading> query = {{transmitter(2), -40.0F, 0.0F}};
  for (const Distance distance : kAllDistances) {
    const Matcher matcher = matcher_of(storage, plain_options(distance));
    EXPECT_TRUE(matcher.match(query, 3).floors.empty());
    EXPECT_EQ(matcher.match(query, 3).known_share_ratio, 0.0F);
    EXPECT_TRUE(matcher.match({}, 3).floors.empty());
  }
}

TEST(Matcher, FindsNothingOnAFloorTheMapLacks) {
  const auto storage = map_of({{FloorId{0}, {{transmitter(1), -40.0F, 0.0F}}}});
  const std::vector<QueryReading> query = {{transmitter(1), -40.0F, 0.0F}};
  const Matcher matcher = matcher_of(storage, plain_options(Distance::kSorensen));
  EXPECT_TRUE(matcher.match(query, 3, FloorId{4}).floors.empty());
  EXPECT_TRUE(
      matcher_of(map_of({}), plain_options(Distance::kSorensen)).match(query, 3).floors.empty());
}

TEST(Matcher, KeepsAddressSpacesApart) {
  const auto storage = map_of({{FloorId{0}, {{TransmitterId::wifi(5), -40.0F, 0.0F}}}});
  const std::vector<QueryReading> query = {{TransmitterId::bluetooth(5), -40.0F, 0.0F}};
  const Matcher matcher = matcher_of(storage, plain_options(Distance::kSorensen));
  EXPECT_TRUE(matcher.match(query, 3).floors.empty());
}

TEST(Matcher, FadesStrengthPerSecondBeyondTheFirst) {
  const auto storage = map_of({});
  const Matcher matcher =
      matcher_of(storage, {.floor_dbm = -100.0F, .exponent = 2.0F, .age_decay_per_s = 0.5F});
  // ((-40 + 100) / 100)^2 = 0.36; three seconds beyond the first leave an eighth.
  EXPECT_NEAR(matcher.strength(-40.0F, 0.0F), 0.36, 1e-6);
  EXPECT_NEAR(matcher.strength(-40.0F, 1.0F), 0.36, 1e-6);
  EXPECT_NEAR(matcher.strength(-40.0F, 4.0F), 0.045, 1e-6);
}

TEST(Matcher, FadesReadingsOfTheMapToo) {
  const auto storage = map_of({{FloorId{0}, {{transmitter(1), -40.0F, 3.0F}}}});
  const Matcher matcher = matcher_of(storage, {.distance = Distance::kManhattan,
                                               .floor_dbm = -100.0F,
                                               .exponent = 1.0F,
                                               .age_decay_per_s = 0.5F});
  const std::vector<QueryReading> query = {{transmitter(1), -40.0F, 0.0F}};
  const auto match = matcher.match(query, 1);
  ASSERT_EQ(match.floors.size(), 1U);
  EXPECT_NEAR(match.floors[0].neighbours.at(0).distance, 0.6 - 0.6 / 4.0, 1e-6);
}

TEST(Matcher, LeavesATraceAtAndBelowTheFloor) {
  const auto storage = map_of({});
  const Matcher matcher = matcher_of(storage, plain_options(Distance::kSorensen));
  EXPECT_NEAR(matcher.strength(-100.0F, 0.0F), 0.01, 1e-7);
  EXPECT_NEAR(matcher.strength(-120.0F, 0.0F), 0.01, 1e-7);
}

TEST(Matcher, RefusesOptionsOutOfRange) {
  const auto storage = map_of({});
  const auto code_of = [&](const Matcher::Options& options) {
    const auto made = Matcher::create(storage.view(), options);
    return made ? std::optional<core::ErrorCode>() : made.error().code;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(code_of({}), std::nullopt);
  for (const float floor_dbm : {-50.0F, -128.0F, kNan}) {
    EXPECT_EQ(code_of({.floor_dbm = floor_dbm}), core::ErrorCode::kInvalidOptions);
  }
  for (const float exponent : {0.0F, 10.5F, kNan}) {
    EXPECT_EQ(code_of({.exponent = exponent}), core::ErrorCode::kInvalidOptions);
  }
  for (const float decay : {0.0F, 1.01F, kNan}) {
    EXPECT_EQ(code_of({.age_decay_per_s = decay}), core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::radio
