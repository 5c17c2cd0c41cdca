// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/id.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <unordered_set>

namespace waylode::core {
namespace {

constexpr std::uint64_t kMax48 = 0xFFFF'FFFF'FFFFULL;

TEST(ParseMac, AcceptsEitherCase) {
  EXPECT_EQ(parse_mac("0a:1b:2c:3d:4e:5f"), 0x0A1B'2C3D'4E5FULL);
  EXPECT_EQ(parse_mac("0A:1B:2C:3D:4E:5F"), 0x0A1B'2C3D'4E5FULL);
  EXPECT_EQ(parse_mac("ff:ff:ff:ff:ff:ff"), kMax48);
}

TEST(ParseMac, RefusesEverythingElse) {
  for (const char* text :
       {"", "0a:1b:2c:3d:4e", "0a:1b:2c:3d:4e:5f:", "0a-1b-2c-3d-4e-5f", "0a:1b:2c:3d:4e:5g",
        " a:1b:2c:3d:4e:5f", "0a:1b:2c:3d:4e:5f ", "0a1b:2c:3d:4e:5f:6", "+a:1b:2c:3d:4e:5f"}) {
    EXPECT_EQ(parse_mac(text), std::nullopt) << text;
  }
}

TEST(TransmitterId, KeepsTheSpacesApart) {
  EXPECT_NE(TransmitterId::wifi(17), TransmitterId::bluetooth(17));
  EXPECT_NE(TransmitterId::wifi(17), TransmitterId::column(17));
  EXPECT_EQ(TransmitterId::bluetooth(17).kind(), TransmitterId::Kind::kBluetooth);
  EXPECT_EQ(TransmitterId::bluetooth(17).address48(), 17U);
}

TEST(TransmitterId, KnowsAddressesThatSoftwareChose) {
  EXPECT_TRUE(TransmitterId::wifi(*parse_mac("02:00:00:00:00:01")).locally_administered());
  EXPECT_TRUE(TransmitterId::wifi(*parse_mac("da:a1:19:00:00:01")).locally_administered());
  EXPECT_FALSE(TransmitterId::wifi(*parse_mac("00:1a:11:02:02:02")).locally_administered());
  EXPECT_FALSE(TransmitterId::bluetooth(*parse_mac("fc:02:00:00:00:02")).locally_administered());
}

TEST(TransmitterId, IsWrittenWithItsKind) {
  EXPECT_EQ(to_string(TransmitterId::wifi(0x0A1B'2C3D'4E5F)), "0a:1b:2c:3d:4e:5f");
  EXPECT_EQ(to_string(TransmitterId::bluetooth(0xF)), "ble:00:00:00:00:00:0f");
  EXPECT_EQ(to_string(TransmitterId::column(519)), "column:519");
}

TEST(TransmitterId, IsNotParsedFromAnythingElse) {
  for (const char* text : {"", "ble:", "ble:17", "column:", "column:-1", "column:1x", "column: 1",
                           "wifi:0a:1b:2c:3d:4e:5f", "column:99999999999999999999"}) {
    EXPECT_EQ(parse_transmitter_id(text), std::nullopt) << text;
  }
}

TEST(TransmitterId, RefusesAColumnThatDoesNotFit) {
  EXPECT_EQ(parse_transmitter_id("column:281474976710655"), TransmitterId::column(kMax48));
  EXPECT_EQ(parse_transmitter_id("column:281474976710656"), std::nullopt);
}

RC_GTEST_PROP(TransmitterId, SurvivesTextAndPacking, (std::uint64_t number)) {
  for (const TransmitterId id : {TransmitterId::wifi(number & kMax48),
                                 TransmitterId::bluetooth(number), TransmitterId::column(number)}) {
    RC_ASSERT(id.address48() == (number & kMax48));
    RC_ASSERT(parse_transmitter_id(to_string(id)) == id);
    RC_ASSERT(TransmitterId::from_packed(id.packed()) == id);
  }
}

TEST(TransmitterId, ServesAsAKey) {
  const std::unordered_set<TransmitterId> ids = {
      TransmitterId::wifi(3), TransmitterId::bluetooth(3), TransmitterId::wifi(3)};
  EXPECT_EQ(ids.size(), 2U);
  EXPECT_TRUE(ids.contains(TransmitterId::bluetooth(3)));
}

TEST(FloorId, IsOrderedByIndex) {
  EXPECT_LT(FloorId{2}, FloorId{3});
  EXPECT_EQ(FloorId{}, FloorId{0});
}

}  // namespace
}  // namespace waylode::core
