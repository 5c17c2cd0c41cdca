// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace waylode::radio {
namespace {

constexpr core::FloorId kFloor{0};

/// Points at x = 0, 1, ..., 9 m; a transmitter heard at -40 dBm less 3 dB a metre from x = 2 m, and
/// one that is heard as loudly near x = 8 m.
ReferenceMap line_map() {
  site::RadioMapBuilder builder;
  for (int x_m = 0; x_m < 10; ++x_m) {
    site::FingerprintRecord record;
    record.x_m = static_cast<float>(x_m);
    record.y_m = 1.5F;
    const float near = static_cast<float>(std::min(std::abs(x_m - 2), std::abs(x_m - 8)));
    builder.add(record, {{core::TransmitterId::wifi(7), -40.0F - 3.0F * near, 0.0F}});
  }
  const site::RadioMapStorage storage = builder.build();
  return *ReferenceMap::create(storage.view(), {});
}

TEST(Alternatives, AreTheBestPlacesApartFromEachOther) {
  const ReferenceMap map = line_map();
  const std::vector<QueryReading> heard = {{core::TransmitterId::wifi(7), -40.5F, 0.0F}};
  const auto places = alternatives(map, heard, kFloor, 2, 3.0);
  ASSERT_EQ(places.size(), 2U);
  // Both middles fit alike; of equals the first surveyed comes first.
  EXPECT_EQ(places[0], core::Vector2(2.0, 1.5));
  EXPECT_EQ(places[1], core::Vector2(8.0, 1.5));
}

TEST(Alternatives, AreNoMoreThanFitApart) {
  const ReferenceMap map = line_map();
  const std::vector<QueryReading> heard = {{core::TransmitterId::wifi(7), -40.5F, 0.0F}};
  EXPECT_EQ(alternatives(map, heard, kFloor, 100, 20.0).size(), 1U);
  EXPECT_EQ(alternatives(map, heard, kFloor, 100, 0.0).size(), 10U);
  EXPECT_TRUE(alternatives(map, heard, kFloor, 0, 1.0).empty());
}

TEST(Alternatives, TakeTheMeanOfWhatSeveralScansHeard) {
  const ReferenceMap map = line_map();
  // -40 and -46 dBm: one metre off the middle, -43 dBm.
  const std::vector<QueryReading> heard = {{core::TransmitterId::wifi(7), -40.0F, 0.0F},
                                           {core::TransmitterId::wifi(7), -46.0F, 0.0F}};
  EXPECT_EQ(alternatives(map, heard, kFloor, 1, 1.0).front(), core::Vector2(1.0, 1.5));
}

TEST(Alternatives, AreNoneWhereNothingIsKnown) {
  const ReferenceMap map = line_map();
  const std::vector<QueryReading> strange = {{core::TransmitterId::wifi(8), -40.0F, 0.0F}};
  EXPECT_TRUE(alternatives(map, strange, kFloor, 3, 1.0).empty());
  EXPECT_TRUE(alternatives(map, {}, kFloor, 3, 1.0).empty());
  const std::vector<QueryReading> heard = {{core::TransmitterId::wifi(7), -40.0F, 0.0F}};
  EXPECT_TRUE(alternatives(map, heard, core::FloorId{3}, 3, 1.0).empty());
}

}  // namespace
}  // namespace waylode::radio
