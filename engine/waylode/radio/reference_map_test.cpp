// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/reference_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/rng.hpp"
#include "waylode/radio/testing/surveyed_map.hpp"

namespace waylode::radio {
namespace {

using core::FloorId;
using core::TransmitterId;
using core::Vector2;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::map_of;
using testing::query_of;
using testing::Surveyed;

constexpr ReferenceMap::Options kPlain{.filter = {.mode = DomainFilter::Mode::kOff}};

ReferenceMap make(const std::vector<Surveyed>& survey,
                  const ReferenceMap::Options& options = kPlain) {
  const site::RadioMapStorage storage = map_of(survey);
  return *ReferenceMap::create(storage.view(), options);
}

double distance(const ReferenceMap& map, const std::vector<float>& rssi_dbm, std::uint32_t point,
                Compared compared = Compared::kUnion) {
  return map.distance_db(map.prepare(query_of(rssi_dbm).readings), point, compared);
}

TEST(ReferenceMap, GathersInstancesOfOnePlaceToAPoint) {
  const ReferenceMap map = make({{0, {1.0, 2.0}, {-50.0F, -60.0F}},
                                 {0, {9.0, 2.0}, {-70.0F}},
                                 {0, {1.3, 2.2}, {-54.0F}},    // 0.36 m from the first.
                                 {0, {1.6, 2.8}, {-90.0F}},    // 1 m from it: another point.
                                 {1, {1.0, 2.0}, {-80.0F}}});  // Another floor.
  ASSERT_EQ(map.points().size(), 4U);
  const ReferenceMap::Point& point = map.points()[0];
  EXPECT_EQ(point.instances, 2U);
  EXPECT_NEAR(point.position_m.x(), 1.15, 1e-6);
  EXPECT_NEAR(point.position_m.y(), 2.1, 1e-6);
  ASSERT_EQ(map.readings_of(0).size(), 2U);
  EXPECT_EQ(map.readings_of(0)[0].count, 2U);
  EXPECT_FLOAT_EQ(map.readings_of(0)[0].mean_dbm, -52.0F);
  EXPECT_FLOAT_EQ(map.readings_of(0)[0].sigma_db, std::sqrt(8.0F));
  EXPECT_FLOAT_EQ(map.readings_of(0)[1].mean_dbm, -60.0F);
  EXPECT_EQ(map.points()[2].position_m.cast<float>(), Vector2(1.6, 2.8).cast<float>());
  EXPECT_EQ(map.points()[3].floor, FloorId{1});
}

TEST(ReferenceMap, KeepsDistinctPlacesApartWithoutARadius) {
  ReferenceMap::Options options = kPlain;
  options.merge_radius_m = 0.0;
  const ReferenceMap map = make(
      {{0, {1.0, 2.0}, {-50.0F}}, {0, {1.0, 2.0}, {-60.0F}}, {0, {1.001, 2.0}, {-70.0F}}}, options);
  ASSERT_EQ(map.points().size(), 2U);
  EXPECT_FLOAT_EQ(map.readings_of(0)[0].mean_dbm, -55.0F);
}

TEST(ReferenceMap, FiltersTheReadingsOfAPointAndSaysSo) {
  std::vector<Surveyed> survey(9, Surveyed{0, {3.0, 4.0}, {-55.0F, -70.0F}});
  survey[4].rssi_dbm[0] = -85.0F;
  const ReferenceMap map = make(survey, {});
  EXPECT_FLOAT_EQ(map.mean_dbm(0, 0), -55.0F);
  EXPECT_EQ(map.report().instances, 9U);
  EXPECT_EQ(map.report().readings, 18U);
  EXPECT_EQ(map.report().readings_replaced, 1U);
  EXPECT_NEAR(static_cast<double>(make(survey).mean_dbm(0, 0)), -55.0 - 30.0 / 9.0, 1e-5);
}

TEST(ReferenceMap, LeavesOutWhatAPointRarelyHeard) {
  ReferenceMap::Options options = kPlain;
  options.min_heard_ratio = 0.5;
  const ReferenceMap map = make({{0, {3.0, 4.0}, {-55.0F, -70.0F, -80.0F}},
                                 {0, {3.0, 4.0}, {-55.0F, -70.0F}},
                                 {0, {3.0, 4.0}, {-55.0F}}},
                                options);
  ASSERT_EQ(map.readings_of(0).size(), 2U);
  EXPECT_TRUE(std::isnan(map.mean_dbm(0, 2)));
  EXPECT_EQ(map.report().readings_rare, 1U);
}

TEST(ReferenceMap, IndexesPointsByFloorAndTransmitter) {
  const ReferenceMap map = make({{0, {0.0, 0.0}, {-50.0F, -60.0F}},
                                 {0, {5.0, 0.0}, {-65.0F, -60.0F}},
                                 {0, {9.0, 0.0}, {-40.0F}},
                                 {2, {0.0, 0.0}, {-70.0F, -71.0F}}});
  EXPECT_THAT(map.points_hearing(0, FloorId{0}), ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(map.points_hearing(1, FloorId{0}), ElementsAre(0U, 1U));
  EXPECT_THAT(map.points_hearing(1, FloorId{2}), ElementsAre(3U));
  EXPECT_THAT(map.points_hearing(1, FloorId{1}), IsEmpty());
  EXPECT_THAT(map.region_of(0, FloorId{0}), ElementsAre(0U, 2U));
  EXPECT_THAT(map.region_of(1, FloorId{0}), ElementsAre(1U));
  EXPECT_THAT(map.region_of(0, FloorId{2}), ElementsAre(3U));
}

TEST(ReferenceMap, MeasuresTheDistanceWorkedOutByHand) {
  // The point heard 1, 2, 3; the scan 2, 3, 4; -100 for what was not heard.
  const ReferenceMap map = make(
      {{0, {0.0, 0.0}, {-60.0F, -70.0F, -81.0F}}, {0, {5.0, 0.0}, {0.0F, 0.0F, 0.0F, -90.0F}}});
  const std::vector<float> scan = {0.0F, -67.0F, -85.0F, -95.0F};
  EXPECT_NEAR(distance(map, scan, 0), std::sqrt(1600.0 + 9.0 + 16.0 + 25.0), 1e-9);
  EXPECT_NEAR(distance(map, scan, 0, Compared::kQuery), std::sqrt(50.0), 1e-9);
  EXPECT_NEAR(distance(map, scan, 0, Compared::kCommonMean), std::sqrt(12.5), 1e-9);
  EXPECT_TRUE(std::isinf(distance(map, {-50.0F}, 1, Compared::kCommonMean)));
  EXPECT_EQ(distance(map, {-60.0F, -70.0F, -81.0F}, 0), 0.0);
}

TEST(ReferenceMap, LeavesStrangeTransmittersAndBrokenReadingsOut) {
  const ReferenceMap map = make({{0, {0.0, 0.0}, {-60.0F, -70.0F}}});
  Query query = query_of({-60.0F, std::numeric_limits<float>::quiet_NaN(), -50.0F});
  const ReferenceQuery heard = map.prepare(query.readings);
  ASSERT_EQ(heard.heard.size(), 1U);
  EXPECT_EQ(heard.heard[0].transmitter, 0U);
  EXPECT_NEAR(heard.known_share_ratio, 40.0 / 90.0, 1e-9);
  EXPECT_NEAR(map.distance_db(heard, 0, Compared::kUnion), 30.0, 1e-9);
}

TEST(ReferenceMap, AveragesATransmitterThatAScanNamesTwice) {
  const ReferenceMap map = make({{0, {0.0, 0.0}, {-60.0F}}});
  Query query = query_of({-62.0F});
  query.readings.push_back({TransmitterId::wifi(1), -65.0F, 0.0F});
  EXPECT_NEAR(map.distance_db(map.prepare(query.readings), 0, Compared::kUnion), 3.5, 1e-9);
}

TEST(ReferenceMap, DoesNotHoldSilenceAgainstAPhoneThatDoesNotListen) {
  site::RadioMapBuilder builder;
  builder.add(
      {}, {{TransmitterId::wifi(1), -60.0F, 0.0F}, {TransmitterId::bluetooth(1), -50.0F, 0.0F}});
  const site::RadioMapStorage storage = builder.build();
  const ReferenceMap map = *ReferenceMap::create(storage.view(), kPlain);
  EXPECT_NEAR(distance(map, {-63.0F}, 0), 3.0, 1e-9);
  Query both = query_of({-63.0F});
  both.readings.push_back({TransmitterId::bluetooth(9), -50.0F, 0.0F});
  EXPECT_NEAR(map.distance_db(map.prepare(both.readings), 0, Compared::kUnion),
              std::sqrt(9.0 + 2500.0), 1e-9);
  EXPECT_EQ(map.points()[0].strongest, 0U);  // The Wi-Fi, though Bluetooth is louder.
}

RC_GTEST_PROP(ReferenceMap, MeasuresAsFullVectorsDo, ()) {
  constexpr std::size_t kTransmitters = 7;
  const auto any_vector = [&] {
    std::vector<float> rssi_dbm;
    for (std::size_t i = 0; i < kTransmitters; ++i) {
      const bool heard = *rc::gen::inRange(0, 3) > 0;
      rssi_dbm.push_back(heard ? 0.5F * static_cast<float>(*rc::gen::inRange(-199, -40)) : 0.0F);
    }
    return rssi_dbm;
  };
  std::vector<Surveyed> survey = {{0, {-9.0, 0.0}, std::vector<float>(kTransmitters, -90.0F)}};
  for (int i = 0; i < 5; ++i) survey.push_back({0, {1.0 * i, 0.0}, any_vector()});
  const ReferenceMap map = make(survey);
  const std::vector<float> scan = any_vector();
  for (std::uint32_t i = 0; i < survey.size(); ++i) {
    double square = 0.0;
    for (std::size_t t = 0; t < kTransmitters; ++t) {
      const auto filled = [](float rssi_dbm) {
        return rssi_dbm == 0.0F ? -100.0 : static_cast<double>(rssi_dbm);
      };
      // A scan without any Wi-Fi holds nothing against the points.
      const bool silent = std::ranges::all_of(scan, [](float r) { return r == 0.0F; });
      if (silent) continue;
      square += std::pow(filled(scan[t]) - filled(survey[i].rssi_dbm[t]), 2.0);
    }
    RC_ASSERT(std::abs(distance(map, scan, i) - std::sqrt(square)) < 1e-9);
  }
}

TEST(ReferenceMap, PutsUpWithAnEmptyMapAndPlacesThatAreNone) {
  const ReferenceMap empty = make({});
  EXPECT_TRUE(empty.points().empty());
  EXPECT_TRUE(empty.floors().empty());
  EXPECT_TRUE(empty.prepare(query_of({-50.0F}).readings).heard.empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ReferenceMap map = make({{0, {nan, 0.0}, {-50.0F}},
                                 {0, {1.0, 1e30}, {-50.0F}},
                                 {0, {1.0, 2.0}, {-50.0F}},
                                 {0, {3.0, 2.0}, {}}});
  ASSERT_EQ(map.points().size(), 2U);
  EXPECT_EQ(map.report().instances_unplaced, 2U);
  EXPECT_EQ(map.points()[1].strongest, ReferenceMap::kNobody);
  EXPECT_NEAR(distance(map, {-70.0F}, 1), 30.0, 1e-9);
}

TEST(ReferenceMap, HoldsTwentyThousandPointsOfFiveHundredTransmitters) {
  core::Rng rng(77);
  std::vector<Surveyed> survey;
  site::RadioMapBuilder builder;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    site::FingerprintRecord record;
    record.floor = static_cast<std::uint16_t>(i / 5'000);
    record.x_m = static_cast<float>(i % 100);
    record.y_m = static_cast<float>(i % 5'000 / 100);
    std::vector<site::MapReading> readings;
    for (int k = 0; k < 30; ++k) {
      readings.push_back({TransmitterId::wifi(rng.below(500)),
                          static_cast<float>(-30.0 - 60.0 * rng.uniform()), 0.0F});
    }
    builder.add(record, std::move(readings));
  }
  const site::RadioMapStorage storage = builder.build();
  const ReferenceMap map = *ReferenceMap::create(storage.view(), {});
  ASSERT_EQ(map.points().size(), 20'000U);
  ASSERT_EQ(map.floors().size(), 4U);
  EXPECT_EQ(map.transmitters().size(), 500U);
  EXPECT_EQ(map.report().readings, storage.postings.size());
  Query same;
  for (const ReferenceMap::Reading& reading : map.readings_of(12'345)) {
    same.readings.push_back({map.transmitters()[reading.transmitter], reading.mean_dbm, 0.0F});
  }
  const ReferenceQuery heard = map.prepare(same.readings);
  EXPECT_EQ(map.distance_db(heard, 12'345, Compared::kUnion), 0.0);
  EXPECT_GT(map.distance_db(heard, 12'346, Compared::kUnion), 0.0);
}

TEST(ReferenceMap, RefusesOptionsOutOfRange) {
  using Options = ReferenceMap::Options;
  const site::RadioMapStorage storage = map_of({});
  EXPECT_TRUE(ReferenceMap::create(storage.view(), {}));
  for (const Options& options :
       {Options{.merge_radius_m = -0.1}, Options{.fill_dbm = -40.0F},
        Options{.filter = {.mad_factor = 0.0F}}, Options{.min_heard_ratio = 1.1}}) {
    EXPECT_FALSE(ReferenceMap::create(storage.view(), options));
  }
}

}  // namespace
}  // namespace waylode::radio
