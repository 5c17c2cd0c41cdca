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

TEST(MovingTransmitterFilter, TakesTheAddressOfAPhonesMakerForEvidence) {
  MovingTransmitterFilter filter(kOptions);
  const TransmitterId phone = TransmitterId::wifi(0x1C48'CE12'3456ULL);  // A maker of phones only.
  filter.hear(phone, "cafe", -90.0F, FloorId{0}, Vector2(0.0, 0.0));
  EXPECT_TRUE(filter.is_moving(phone));
}

TEST(MovingTransmitterFilter, LetsARouterBearAPhonesName) {
  MovingTransmitterFilter filter(kOptions);
  const TransmitterId router = TransmitterId::wifi(0x0000'0C12'3456ULL);  // Of routers only.
  filter.hear(router, "iPhone", -50.0F, FloorId{0}, Vector2(0.0, 0.0));
  EXPECT_FALSE(filter.is_moving(router));
  filter.hear(router, "iPhone", -50.0F, FloorId{0}, Vector2(0.0, 46.0));
  EXPECT_TRUE(filter.is_moving(router));
}

TEST(MovingTransmitterFilter, CountsVisitsOnlyWhenAllEvidenceCounts) {
  for (const auto evidence :
       {MovingTransmitterFilter::Evidence::kLoudPlaces, MovingTransmitterFilter::Evidence::kAll}) {
    MovingTransmitterFilter filter(kOptions, evidence);
    filter.begin_walk();
    filter.hear(kBox, "guest", -50.0F, FloorId{0}, Vector2(3.0, 4.0));
    for (int i = 0; i < 7; ++i) {
      filter.begin_walk();
      filter.pass(FloorId{0}, Vector2(3.0, 5.0));
    }
    EXPECT_EQ(filter.is_moving(kBox), evidence == MovingTransmitterFilter::Evidence::kAll);
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
