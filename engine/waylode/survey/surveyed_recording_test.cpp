// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/surveyed_recording.hpp"

#include <gtest/gtest.h>

namespace waylode::survey {
namespace {

using core::device_time_from_ms;
using core::FloorId;
using core::TransmitterId;
using core::Vector2;

sample::WifiReading heard(std::uint64_t number, std::int64_t last_seen_ms) {
  sample::WifiReading reading;
  reading.transmitter = TransmitterId::wifi(number);
  reading.rssi_dbm = -60.0F;
  reading.last_seen = device_time_from_ms(last_seen_ms);
  return reading;
}

TEST(DropReadingsBefore, TakesAwayWhatBelongsToAnEarlierWalk) {
  std::vector<sample::Sample> samples = {
      sample::WifiScan{device_time_from_ms(5'000), {heard(1, 2'999), heard(2, 2'000)}},
      sample::BleReading{device_time_from_ms(1'000), TransmitterId::bluetooth(1), -70.0F, {}, {}},
      sample::WifiScan{device_time_from_ms(7'000),
                       {heard(1, 2'999), heard(2, 3'000), heard(3, 6'000)}}};
  EXPECT_EQ(drop_readings_before(samples, device_time_from_ms(3'000)), 3U);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_TRUE(std::get<sample::WifiScan>(samples[0]).readings.empty());
  const auto& left = std::get<sample::WifiScan>(samples[2]).readings;
  ASSERT_EQ(left.size(), 2U);
  EXPECT_EQ(left[0].transmitter, TransmitterId::wifi(2));
  EXPECT_EQ(left[1].transmitter, TransmitterId::wifi(3));
}

/// Two floors; the second one's frame lies 100 m east of the first one's.
site::Site two_floors(std::optional<core::GeoPoint> origin) {
  site::SiteParts parts;
  parts.origin = origin;
  parts.floors.resize(2);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "F2";
  parts.floors[1].site_from_floor.translation_m = Vector2(100.0, 0.0);
  return site::Site(std::move(parts));
}

sample::WaypointSample mark(std::int64_t time_ms, const char* floor,
                            std::optional<Vector2> position_m,
                            std::optional<core::GeoPoint> geo_position = std::nullopt) {
  return {device_time_from_ms(time_ms), position_m, geo_position, floor};
}

TEST(PlaceWaypoints, TakesTheMarksFloorOrElseTheDefault) {
  const site::Site site = two_floors(std::nullopt);
  const std::vector<sample::Sample> samples = {
      mark(1'000, "F2", Vector2(1.0, 2.0)), mark(2'000, "", Vector2(3.0, 4.0)),
      mark(3'000, "F9", Vector2(5.0, 6.0)),
      sample::BarometerSample{device_time_from_ms(4'000), 1000.0}};
  const auto with_default = place_waypoints(site, samples, FloorId{0});
  ASSERT_EQ(with_default.size(), 2U);
  EXPECT_EQ(with_default[0].time, device_time_from_ms(1'000));
  EXPECT_EQ(with_default[0].floor, FloorId{1});
  EXPECT_EQ(with_default[0].position_m, Vector2(1.0, 2.0));
  EXPECT_EQ(with_default[1].floor, FloorId{0});
  EXPECT_EQ(with_default[1].position_m, Vector2(3.0, 4.0));
  EXPECT_EQ(place_waypoints(site, samples, std::nullopt).size(), 1U);
}

TEST(PlaceWaypoints, PutsGeographicMarksIntoTheFloorsFrame) {
  const core::GeoPoint origin{0.0, 20.0};
  const site::Site site = two_floors(origin);
  const std::vector<sample::Sample> samples = {mark(1'000, "F2", std::nullopt, origin)};
  const auto placed = place_waypoints(site, samples, std::nullopt);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_LT((placed[0].position_m - Vector2(-100.0, 0.0)).norm(), 1e-6);
}

TEST(PlaceWaypoints, PassesOverGeographicMarksWhereTheSiteHasNoGeoreference) {
  const site::Site site = two_floors(std::nullopt);
  const std::vector<sample::Sample> samples = {
      mark(1'000, "F2", std::nullopt, core::GeoPoint{0.0, 20.0}), mark(2'000, "F2", std::nullopt)};
  EXPECT_TRUE(place_waypoints(site, samples, std::nullopt).empty());
}

}  // namespace
}  // namespace waylode::survey
