// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/hotspot_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::radio {
namespace {

using core::FloorId;
using core::TransmitterId;
using core::Vector2;

constexpr TransmitterId kBox = TransmitterId::wifi(0x1234);
constexpr TransmitterId kOther = TransmitterId::wifi(0x1235);
constexpr FloorId kFloor{0};

TEST(HotspotEvidence, HoldsLoudPlacesFarApartAgainstATransmitter) {
  HotspotEvidence evidence({.farthest_m = 30.0});
  evidence.hear(kBox, -50.0F, kFloor, {0.0, 0.0});
  evidence.hear(kBox, -62.0F, kFloor, {18.0, 24.0});
  EXPECT_FALSE(evidence.finding(kBox).moves());
  EXPECT_NEAR(evidence.finding(kBox).loud_extent_m, 30.0, 1e-9);
  evidence.hear(kBox, -63.0F, kFloor, {-200.0, 0.0});    // Not loud.
  evidence.hear(kBox, -40.0F, FloorId{1}, {99.0, 0.0});  // Another frame.
  evidence.hear(kOther, -40.0F, kFloor, {99.0, 0.0});
  EXPECT_FALSE(evidence.finding(kBox).moves());
  evidence.hear(kBox, -61.0F, kFloor, {18.0, 24.1});
  EXPECT_TRUE(evidence.finding(kBox).is_loud_apart);
  EXPECT_FALSE(evidence.finding(kOther).moves());
}

/// Eight walks along a corridor; those of `heard` hear the box at its middle.
HotspotEvidence visited(const std::set<int>& heard, float rssi_dbm) {
  HotspotEvidence evidence({});
  for (int visit = 0; visit < 8; ++visit) {
    evidence.begin_visit();
    for (int i = 0; i < 40; ++i) evidence.pass(kFloor, {1.0 * i, 2.0});
    if (heard.contains(visit)) evidence.hear(kBox, rssi_dbm, kFloor, {20.0, 2.0});
  }
  for (int visit = 0; visit < 9; ++visit) {  // None of these comes near.
    evidence.begin_visit();
    evidence.pass(kFloor, {25.5, 2.0});
    evidence.pass(FloorId{1}, {20.0, 2.0});
  }
  return evidence;
}

TEST(HotspotEvidence, HoldsVisitsThatDoNotHearItAgainstATransmitter) {
  const auto rare = visited({3}, -50.0F).finding(kBox);
  ASSERT_TRUE(rare.visit_ratio);
  EXPECT_NEAR(*rare.visit_ratio, 1.0 / 8.0, 1e-12);
  EXPECT_TRUE(rare.is_rarely_seen);
  const auto often = visited({0, 5}, -50.0F).finding(kBox);
  EXPECT_NEAR(*often.visit_ratio, 0.25, 1e-12);
  EXPECT_FALSE(often.moves());
}

TEST(HotspotEvidence, ExpectsAFaintTransmitterToBeMissed) {
  const auto faint = visited({3}, -85.0F).finding(kBox);
  EXPECT_FALSE(faint.visit_ratio);
  EXPECT_FALSE(faint.moves());
}

TEST(HotspotEvidence, LearnsNothingFromFewVisits) {
  HotspotEvidence evidence({});
  evidence.begin_visit();
  evidence.hear(kBox, -50.0F, kFloor, {0.0, 0.0});
  for (int visit = 0; visit < 2; ++visit) {
    evidence.begin_visit();
    evidence.pass(kFloor, {0.0, 0.0});
  }
  EXPECT_FALSE(evidence.finding(kBox).visit_ratio);
  evidence.begin_visit();
  evidence.pass(kFloor, {0.0, 0.0});
  ASSERT_TRUE(evidence.finding(kBox).visit_ratio);
  EXPECT_NEAR(*evidence.finding(kBox).visit_ratio, 0.25, 1e-12);
}

TEST(HotspotEvidence, HoldsAPoorFitOfPathLossAgainstATransmitter) {
  const PathLoss law{.reference_distance_m = 1.0, .reference_dbm = -45.0, .exponent = 3.0};
  HotspotEvidence evidence({.loud_dbm = -1.0F});
  for (int i = 0; i < 900; ++i) {  // More than are kept.
    const Vector2 place_m(0.5 * (i % 50), 2.0 * (i % 7));
    const double distance_m = std::hypot((place_m - Vector2(11.0, 5.0)).norm(), 1.5);
    evidence.hear(kBox, static_cast<float>(law.mean_dbm(distance_m)), kFloor, place_m);
    evidence.hear(kOther, i % 3 == 0 ? -45.0F : -90.0F, kFloor, place_m);
  }
  const auto still = evidence.finding(kBox);
  ASSERT_TRUE(still.residual_db);
  EXPECT_LT(*still.residual_db, 0.5);
  EXPECT_FALSE(still.moves());
  EXPECT_TRUE(evidence.finding(kOther).fits_no_place);
}

TEST(HotspotEvidence, PassesOverWhatIsNotFinite) {
  HotspotEvidence evidence({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  evidence.pass(kFloor, {nan, 0.0});
  evidence.hear(kBox, -50.0F, kFloor, {0.0, nan});
  evidence.hear(kBox, std::numeric_limits<float>::quiet_NaN(), kFloor, {0.0, 0.0});
  EXPECT_FALSE(evidence.finding(kBox).moves());
  EXPECT_EQ(evidence.finding(kBox).loud_extent_m, 0.0);
}

TEST(HotspotEvidence, RefusesOptionsOutOfRange) {
  using Options = HotspotEvidence::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_FALSE(Options{.loud_dbm = 0.0F}.validate());
  EXPECT_FALSE(Options{.farthest_m = 0.0}.validate());
  EXPECT_FALSE(Options{.min_visit_ratio = 1.1}.validate());
  EXPECT_FALSE(Options{.min_visits = 0}.validate());
  EXPECT_FALSE(Options{.visit_radius_m = 0.0}.validate());
  EXPECT_FALSE(Options{.max_residual_db = 0.0}.validate());
  EXPECT_FALSE(Options{.min_readings = 4}.validate());
  EXPECT_FALSE(Options{.locator = {.grid = 1}}.validate());
}

}  // namespace
}  // namespace waylode::radio
