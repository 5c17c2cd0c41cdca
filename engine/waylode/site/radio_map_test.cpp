// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/radio_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>

namespace waylode::site {
namespace {

using core::TransmitterId;

const TransmitterId kA = TransmitterId::wifi(0xA);
const TransmitterId kB = TransmitterId::wifi(0xB);
const TransmitterId kC = TransmitterId::bluetooth(0xA);

FingerprintRecord on_floor(std::uint16_t floor, float x_m) {
  return {x_m, 0.0F, 1.0F, 7, floor, 0};
}

TEST(RadioMap, ListsWhoHeardATransmitter) {
  RadioMapBuilder builder;
  builder.add(on_floor(0, 10.0F), {{kA, -40.0F, 0.0F}, {kB, -50.5F, 1.2F}});
  builder.add(on_floor(0, 20.0F), {{kA, -80.0F, 0.0F}});
  const RadioMapStorage storage = builder.build();
  const RadioMap map = storage.view();
  const auto heard_a = map.postings_of(kA);
  ASSERT_EQ(heard_a.size(), 2U);
  EXPECT_EQ(heard_a[0], (Posting{0, 80, 0, 0}));
  EXPECT_EQ(heard_a[1], (Posting{1, 160, 0, 0}));
  const auto heard_b = map.postings_of(kB);
  ASSERT_EQ(heard_b.size(), 1U);
  EXPECT_EQ(heard_b[0], (Posting{0, 101, 12, 0}));
  EXPECT_FLOAT_EQ(heard_b[0].rssi_dbm(), -50.5F);
  EXPECT_TRUE(map.postings_of(kC).empty());
  EXPECT_EQ(map.fingerprints[0].reading_count, 2);
}

TEST(RadioMap, SortsFingerprintsByFloorAndKeepsTheirOrderOtherwise) {
  RadioMapBuilder builder;
  builder.add(on_floor(1, 10.0F), {{kA, -40.0F, 0.0F}});
  builder.add(on_floor(0, 20.0F), {{kA, -50.0F, 0.0F}});
  builder.add(on_floor(1, 30.0F), {});
  const RadioMapStorage storage = builder.build();
  ASSERT_EQ(storage.fingerprints.size(), 3U);
  EXPECT_EQ(storage.fingerprints[0].x_m, 20.0F);
  EXPECT_EQ(storage.fingerprints[1].x_m, 10.0F);
  EXPECT_EQ(storage.fingerprints[2].x_m, 30.0F);
  EXPECT_EQ(storage.view().postings_of(kA)[0].fingerprint, 0U);
  EXPECT_EQ(storage.view().postings_of(kA)[0].attenuation_half_db, 100);
}

TEST(RadioMap, KeepsTheLastReadingOfATransmitter) {
  RadioMapBuilder builder;
  builder.add(on_floor(0, 0.0F), {{kA, -40.0F, 0.0F}, {kB, -60.0F, 0.0F}, {kA, -45.0F, 0.0F}});
  const RadioMapStorage storage = builder.build();
  ASSERT_EQ(storage.view().postings_of(kA).size(), 1U);
  EXPECT_EQ(storage.view().postings_of(kA)[0].rssi_dbm(), -45.0F);
  EXPECT_EQ(storage.fingerprints[0].reading_count, 2);
}

TEST(RadioMap, SaturatesWhatDoesNotFitAByte) {
  RadioMapBuilder builder;
  builder.add(on_floor(0, 0.0F), {{kA, -140.0F, 60.0F}, {kB, 3.0F, -1.0F}});
  const RadioMapStorage storage = builder.build();
  EXPECT_EQ(storage.view().postings_of(kA)[0], (Posting{0, 255, 255, 0}));
  EXPECT_EQ(storage.view().postings_of(kB)[0], (Posting{0, 0, 0, 0}));
}

TEST(RadioMap, OfNothingIsEmpty) {
  const RadioMapStorage storage = RadioMapBuilder().build();
  EXPECT_TRUE(storage.view().empty());
  EXPECT_TRUE(storage.view().postings_of(kA).empty());
  EXPECT_TRUE(RadioMap{}.postings_of(kA).empty());
}

RC_GTEST_PROP(RadioMapProperty, HoldsExactlyWhatWasAdded, ()) {
  // Slow reference: transmitter -> fingerprint (by its recording number) -> attenuation.
  std::map<std::uint64_t, std::map<std::uint32_t, int>> expected;
  RadioMapBuilder builder;
  const auto count = *rc::gen::inRange<std::uint32_t>(0, 12);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto floor = *rc::gen::inRange<std::uint16_t>(0, 3);
    std::vector<MapReading> readings;
    const auto heard =
        *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(1, 9));
    for (const std::uint64_t address : heard) {
      const int half_db = *rc::gen::inRange(0, 256);
      const auto id = TransmitterId::wifi(address);
      readings.push_back({id, -0.5F * static_cast<float>(half_db), 0.0F});
      expected[id.packed()][i] = half_db;
    }
    builder.add({0.0F, 0.0F, 0.0F, i, floor, 0}, readings);
  }
  const RadioMapStorage storage = builder.build();
  std::map<std::uint64_t, std::map<std::uint32_t, int>> found;
  for (const std::uint64_t transmitter : storage.transmitters) {
    for (const Posting& posting :
         storage.view().postings_of(TransmitterId::from_packed(transmitter))) {
      const std::uint32_t i = storage.fingerprints[posting.fingerprint].recording;
      RC_ASSERT(found[transmitter].emplace(i, posting.attenuation_half_db).second);
    }
  }
  RC_ASSERT(found == expected);
  RC_ASSERT(std::ranges::is_sorted(storage.fingerprints, {}, &FingerprintRecord::floor));
}

}  // namespace
}  // namespace waylode::site
