// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/moving_transmitters.hpp"

#include <gtest/gtest.h>

namespace waylode::survey {
namespace {

using core::FloorId;
using core::TransmitterId;
using core::Vector2;

constexpr MovingTransmitterFilter::Options kOptions{.loud_dbm = -62.0F, .farthest_m = 45.0};
constexpr TransmitterId kBox = TransmitterId::wifi(0x1234);

TEST(MovingTransmitterFilter, FindsOneThatIsLoudFarApart) {
  MovingTransmitterFilter filter(kOptions);
  filter.hear(kBox, "guest", -50.0F, FloorId{0}, Vector2(0.0, 0.0));
  EXPECT_FALSE(filter.is_moving(kBox));
  filter.hear(kBox, "guest", -62.0F, FloorId{0}, Vector2(30.0, 30.0));
  EXPECT_FALSE(filter.is_moving(kBox));  // 42.4 m.
  filter.hear(kBox, "guest", -55.0F, FloorId{0}, Vector2(-4.0, 0.0));
  EXPECT_TRUE(filter.is_moving(kBox));  // 45.3 m.
}

TEST(MovingTransmitterFilter, LetsAQuietOneBeHeardFarAway) {
  MovingTransmitterFilter filter(kOptions);
  filter.hear(kBox, "guest", -50.0F, FloorId{0}, Vector2(0.0, 0.0));
  filter.hear(kBox, "guest", -63.0F, FloorId{0}, Vector2(200.0, 0.0));
  filter.hear(kBox, "guest", -90.0F, FloorId{0}, Vector2(-300.0, 0.0));
  EXPECT_FALSE(filter.is_moving(kBox));
}

TEST(MovingTransmitterFilter, ComparesPlacesOfOneFloorOnly) {
  MovingTransmitterFilter filter(kOptions);
  filter.hear(kBox, "", -50.0F, FloorId{0}, Vector2(0.0, 0.0));
  filter.hear(kBox, "", -50.0F, FloorId{1}, Vector2(100.0, 0.0));  // Another frame.
  EXPECT_FALSE(filter.is_moving(kBox));
}

TEST(MovingTransmitterFilter, KeepsTransmittersApart) {
  MovingTransmitterFilter filter(kOptions);
  filter.hear(kBox, "", -50.0F, FloorId{0}, Vector2(0.0, 0.0));
  filter.hear(TransmitterId::wifi(0x1235), "", -50.0F, FloorId{0}, Vector2(100.0, 0.0));
  EXPECT_FALSE(filter.is_moving(kBox));
  EXPECT_FALSE(filter.is_moving(TransmitterId::wifi(0x1235)));
  EXPECT_FALSE(filter.is_moving(TransmitterId::wifi(0x9999)));
}

TEST(MovingTransmitterFilter, TakesAHotspotsNameForEvidence) {
  MovingTransmitterFilter filter(kOptions);
  filter.hear(kBox, "AndroidAP_7731", -90.0F, FloorId{0}, Vector2(0.0, 0.0));
  filter.hear(kBox, "", -90.0F, FloorId{0}, Vector2(0.0, 0.0));
  EXPECT_TRUE(filter.is_moving(kBox));
}

TEST(HotspotNames, AreThoseThatPhonesGive) {
  for (const char* name : {"AndroidAP", "iPhone von Eva", "Eva's iPhone", "DIRECT-roku-12"}) {
    EXPECT_TRUE(is_hotspot_name(name)) << name;
  }
  for (const char* name : {"", "eduroam", "iphone", "MyAndroidAP", "mall-free-wifi"}) {
    EXPECT_FALSE(is_hotspot_name(name)) << name;
  }
}

TEST(AsksNotToBeMapped, IsSaidByTheEndOfTheName) {
  EXPECT_TRUE(asks_not_to_be_mapped("home_nomap"));
  EXPECT_FALSE(asks_not_to_be_mapped("home_nomap_2"));
  EXPECT_FALSE(asks_not_to_be_mapped(""));
}

TEST(MovingTransmitterFilter, RefusesOptionsOutOfRange) {
  using Options = MovingTransmitterFilter::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.loud_dbm = 0.0F}.validate());
  EXPECT_FALSE(Options{.farthest_m = 0.0}.validate());
}

}  // namespace
}  // namespace waylode::survey
