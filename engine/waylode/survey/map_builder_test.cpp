// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/map_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::survey {
namespace {

using core::device_time_from_seconds;
using core::FloorId;
using core::kPi;
using core::TransmitterId;
using core::Vector2;
using core::Vector3;

constexpr double kStepLength_m = 0.7;
constexpr double kCadence_hz = 2.0;

MapBuilder::Options options() {
  MapBuilder::Options options;
  options.scan = {.max_age_s = 6.0, .fresh_age_s = 3.0, .ble_window_s = 4.0};
  options.pdr.step = {.low_pass_hz = 3.0,
                      .min_peak_mps2 = 0.55,
                      .relative_peak_ratio = 0.4,
                      .shortest_interval_s = 0.28,
                      .longest_interval_s = 1.2};
  options.pdr.stride = {.constant_m = kStepLength_m,
                        .swing_gain = 0.0,
                        .cadence_gain_m_s = 0.0,
                        .shortest_m = 0.25,
                        .longest_m = 1.2};
  options.labels = {.widest_scale = 2.0,
                    .shortest_shaped_m = 1.5,
                    .fastest_mps = 2.5,
                    .longest_gap_s = 120.0,
                    .mark_sigma_m = 0.7,
                    .drift_sigma_ratio = 0.08};
  options.moving = {.loud_dbm = -62.0F, .farthest_m = 45.0};
  return options;
}

site::SiteParts two_floors() {
  site::SiteParts parts;
  parts.name = "house";
  parts.floors.resize(2);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "F2";
  return parts;
}

sample::WaypointSample mark(double time_s, const char* floor, double x_m, double y_m) {
  return {device_time_from_seconds(time_s), Vector2(x_m, y_m), std::nullopt, floor};
}

sample::WifiReading heard(std::uint64_t number, float rssi_dbm, double last_seen_s,
                          const char* ssid = "net") {
  return {TransmitterId::wifi(number), rssi_dbm, 2'437, device_time_from_seconds(last_seen_s),
          ssid};
}

sample::WifiScan scan(double time_s, std::vector<sample::WifiReading> readings) {
  return {device_time_from_seconds(time_s), std::move(readings)};
}

/// Without motion sensors a walk is straight and even: labels can be told by hand.
SurveyedRecording ten_seconds_east(std::vector<sample::Sample> scans, const char* floor = "F1") {
  SurveyedRecording recording;
  recording.name = "east";
  recording.samples.push_back(mark(0.0, floor, 2.0, 5.0));
  recording.samples.insert(recording.samples.end(), scans.begin(), scans.end());
  recording.samples.push_back(mark(10.0, floor, 12.0, 5.0));
  return recording;
}

TEST(MapBuilder, PutsFingerprintsWhereTheirSignalsWereHeard) {
  MapBuilder builder(two_floors(), options());
  builder.add(ten_seconds_east(
      {scan(4.0, {heard(1, -50.0F, 3.0), heard(2, -60.0F, 3.5), heard(3, -70.0F, 4.0)}),
       scan(8.0, {heard(1, -55.0F, 8.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  const auto& fingerprints = built->parts.radio_map.fingerprints;
  ASSERT_EQ(fingerprints.size(), 2U);
  EXPECT_NEAR(fingerprints[0].x_m, 5.5, 1e-5);  // Heard 3.5 s after the mark, delivered at 4 s.
  EXPECT_NEAR(fingerprints[0].y_m, 5.0, 1e-5);
  EXPECT_EQ(fingerprints[0].reading_count, 3U);
  EXPECT_EQ(fingerprints[0].floor, 0U);
  EXPECT_NEAR(fingerprints[1].x_m, 10.0, 1e-5);
  EXPECT_NEAR(fingerprints[1].position_sigma_m, 0.7, 1e-5);
  const auto postings = built->parts.radio_map.view().postings_of(TransmitterId::wifi(2));
  ASSERT_EQ(postings.size(), 1U);
  EXPECT_EQ(postings[0].rssi_dbm(), -60.0F);
  EXPECT_EQ(postings[0].age_tenth_s, 5U);
  EXPECT_EQ(built->quality.stretches, 1U);
  EXPECT_EQ(built->quality.stretches_straight, 1U);
  EXPECT_EQ(built->quality.floors.at(0).fingerprints, 2U);
  EXPECT_EQ(built->quality.floors.at(1).fingerprints, 0U);
}

TEST(MapBuilder, MapsTheFieldWhereItWasMeasured) {
  MapBuilder builder(two_floors(), options());
  const auto time = device_time_from_seconds(4.0);
  builder.add(ten_seconds_east(
      {sample::AccelerometerSample{time, Vector3(0.0, 0.0, pdr::kStandardGravity_mps2)},
       sample::MagnetometerSample{time, Vector3(15.0, 20.0, -42.0), 3},
       scan(4.0, {heard(1, -50.0F, 4.0)})},
      "F2"));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  ASSERT_EQ(built->parts.magnetic_map.points.size(), 1U);
  EXPECT_EQ(built->parts.magnetic_map.points[0],
            (site::MagneticPoint{6.0F, 5.0F, 25.0F, -42.0F, 0.0F, 1, 1}));
}

TEST(MapBuilder, DropsWhatWasHeardBeforeTheFirstMark) {
  MapBuilder builder(two_floors(), options());
  builder.add(ten_seconds_east({scan(1.0, {heard(1, -50.0F, -0.5), heard(2, -60.0F, 0.5)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_THAT(built->parts.radio_map.transmitters,
              testing::ElementsAre(TransmitterId::wifi(2).packed()));
}

TEST(MapBuilder, LeavesOutWhatAnEarlierRecordingTold) {
  MapBuilder builder(two_floors(), options());
  builder.add(ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0), heard(2, -60.0F, 4.0)})}));
  // The same reception told again, and a new one of the same transmitter.
  builder.add(ten_seconds_east({scan(6.0, {heard(1, -50.0F, 4.0), heard(2, -61.0F, 6.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->quality.readings_duplicate, 1U);
  ASSERT_EQ(built->parts.radio_map.fingerprints.size(), 2U);
  EXPECT_EQ(built->parts.radio_map.fingerprints[1].reading_count, 1U);
  EXPECT_EQ(built->parts.radio_map.fingerprints[0].recording, 0U);
  EXPECT_EQ(built->parts.radio_map.fingerprints[1].recording, 1U);
  EXPECT_EQ(built->quality.floors.at(0).recordings, 2U);
}

TEST(MapBuilder, KeepsWhatOneRecordingRepeats) {
  MapBuilder builder(two_floors(), options());
  builder.add(
      ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0)}), scan(6.0, {heard(1, -50.0F, 4.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->quality.readings_duplicate, 0U);
  EXPECT_EQ(built->parts.radio_map.fingerprints.size(), 2U);
}

TEST(MapBuilder, DropsWhatIsToldTwiceForTheSameTime) {
  MapBuilder builder(two_floors(), options());
  builder.add(ten_seconds_east({scan(4.0, {heard(1, -50.0F, 3.0)}),
                                scan(4.0, {heard(1, -50.0F, 3.5), heard(2, -60.0F, 4.0)}),
                                scan(6.0, {heard(1, -50.0F, 6.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->quality.readings_duplicate, 1U);
  EXPECT_EQ(built->parts.radio_map.fingerprints.size(), 3U);
  EXPECT_EQ(built->parts.radio_map.view().postings_of(TransmitterId::wifi(1)).size(), 2U);
}

TEST(MapBuilder, RespectsThoseWhoAskNotToBeMapped) {
  MapBuilder builder(two_floors(), options());
  builder.add(
      ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0, "home_nomap"), heard(2, -60.0F, 4.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->quality.readings_unmappable, 1U);
  EXPECT_THAT(built->parts.radio_map.transmitters,
              testing::ElementsAre(TransmitterId::wifi(2).packed()));
}

TEST(MapBuilder, LeavesMovingTransmittersOut) {
  MapBuilder builder(two_floors(), options());
  SurveyedRecording recording;
  recording.samples = {
      mark(0.0, "F1", 0.0, 0.0), scan(1.0, {heard(1, -50.0F, 1.0), heard(2, -60.0F, 1.0)}),
      scan(29.0,
           {heard(1, -50.0F, 29.0), heard(2, -80.0F, 29.0), heard(3, -80.0F, 29.0, "iPhone")}),
      mark(30.0, "F1", 60.0, 0.0)};
  builder.add(recording);
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->quality.transmitters_moving, 2U);
  EXPECT_THAT(built->parts.radio_map.transmitters,
              testing::ElementsAre(TransmitterId::wifi(2).packed()));
}

TEST(MapBuilder, CountsScansOutsideTheMarksAndRejectedStretches) {
  MapBuilder builder(two_floors(), options());
  SurveyedRecording recording;
  recording.samples = {mark(0.0, "F1", 0.0, 0.0),   scan(5.0, {heard(1, -50.0F, 5.0)}),
                       mark(10.0, "F1", 10.0, 0.0), scan(11.0, {heard(1, -51.0F, 11.0)}),
                       mark(12.0, "F1", 50.0, 0.0), scan(15.0, {heard(1, -52.0F, 15.0)})};
  builder.add(recording);
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->quality.stretches, 2U);
  EXPECT_EQ(built->quality.stretches_rejected, 1U);
  EXPECT_EQ(built->quality.scans_unlabelled, 2U);
  EXPECT_EQ(built->parts.radio_map.fingerprints.size(), 1U);
  EXPECT_NEAR(built->quality.floors.at(0).surveyed_m, 10.0, 1e-9);
}

TEST(MapBuilder, JoinsBluetoothHeardMeanwhile) {
  MapBuilder builder(two_floors(), options());
  builder.add(ten_seconds_east(
      {sample::BleReading{
           device_time_from_seconds(3.0), TransmitterId::bluetooth(7), -70.0F, {}, {}},
       scan(4.0, {heard(1, -50.0F, 4.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_EQ(built->parts.radio_map.view().postings_of(TransmitterId::bluetooth(7)).size(), 1U);
}

TEST(MapBuilder, TakesRowsOfTables) {
  MapBuilder builder(two_floors(), options());
  sample::FingerprintRow row;
  row.position_m = Vector2(3.0, 4.0);
  row.readings = {heard(1, -50.0F, 0.0)};
  builder.add(row, FloorId{1});
  builder.add(row, FloorId{2});
  const auto built = builder.build();
  ASSERT_TRUE(built);
  ASSERT_EQ(built->parts.radio_map.fingerprints.size(), 1U);
  EXPECT_EQ(built->parts.radio_map.fingerprints[0].floor, 1U);
  EXPECT_EQ(built->parts.radio_map.fingerprints[0].x_m, 3.0F);
  EXPECT_EQ(built->quality.notes.size(), 1U);  // Of the floor that the site lacks.
}

TEST(MapBuilder, RefusesASurveyThatGivesNothing) {
  const auto code_of = [](const std::vector<SurveyedRecording>& recordings) {
    MapBuilder builder(two_floors(), options());
    for (const SurveyedRecording& recording : recordings) builder.add(recording);
    const auto built = builder.build();
    EXPECT_EQ(built ? "" : built.error().place, "house");
    return built ? std::optional<core::ErrorCode>() : built.error().code;
  };
  EXPECT_EQ(code_of({}), core::ErrorCode::kSurveyInsufficient);
  EXPECT_EQ(code_of({ten_seconds_east({})}), core::ErrorCode::kSurveyInsufficient);
  EXPECT_EQ(code_of({ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0)})}, "F7")}),
            core::ErrorCode::kSurveyInsufficient);
  EXPECT_EQ(code_of({ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0, "AndroidAP")})})}),
            core::ErrorCode::kSurveyInsufficient);
}

TEST(MapBuilder, NotesRecordingsThatGiveNothing) {
  MapBuilder builder(two_floors(), options());
  builder.add(ten_seconds_east({}));
  SurveyedRecording lost = ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0)})}, "F7");
  lost.name = "lost";
  builder.add(lost);
  builder.add(ten_seconds_east({scan(4.0, {heard(1, -50.0F, 4.0)})}));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_THAT(built->quality.notes,
              testing::ElementsAre(testing::StartsWith("east: "), testing::StartsWith("lost: ")));
}

/// Steps at `heading_rad` by the phone, and a mark every eight seconds along a line turned by
/// `turn_rad` against it; the marks say `scale` times the distance of the steps.
SurveyedRecording straight_walk(double heading_rad, double turn_rad, double scale,
                                const char* floor) {
  constexpr double kLeg_s = 8.0;
  constexpr int kLegs = 12;
  SurveyedRecording recording;
  recording.name = "straight";
  const double true_rad = heading_rad + turn_rad;
  const double speed_mps = scale * kStepLength_m * kCadence_hz;
  const core::Quaternion attitude(Eigen::AngleAxisd(heading_rad - kPi / 2.0, Vector3::UnitZ()));
  for (int i = 0; i <= static_cast<int>(50.0 * kLeg_s * kLegs); ++i) {
    const double time_s = 0.02 * i;
    const auto time = device_time_from_seconds(time_s);
    if (i % static_cast<int>(50.0 * kLeg_s) == 0) {
      const double distance_m = speed_mps * time_s;
      recording.samples.push_back(
          mark(time_s, floor, distance_m * std::cos(true_rad), distance_m * std::sin(true_rad)));
      recording.samples.push_back(scan(time_s, {heard(1, -70.0F, time_s)}));
    }
    recording.samples.push_back(sample::RotationSample{time, attitude});
    recording.samples.push_back(sample::GyroscopeSample{time, Vector3::Zero()});
    const double bounce_mps2 = 2.5 * std::sin(2.0 * kPi * kCadence_hz * time_s);
    recording.samples.push_back(sample::AccelerometerSample{
        time, Vector3(0.0, 0.0, pdr::kStandardGravity_mps2 + bounce_mps2)});
  }
  return recording;
}

TEST(MapBuilder, LearnsHowFarTheCompassIsOffThePlan) {
  for (const double turn_deg : {10.0, -75.0, 170.0}) {
    const double turn_rad = core::radians_from_degrees(turn_deg);
    MapBuilder builder(two_floors(), options());
    builder.add(straight_walk(0.5, turn_rad, 1.1, "F1"));
    const auto built = builder.build();
    ASSERT_TRUE(built);
    const auto& floors = built->parts.floors;
    EXPECT_NEAR(core::wrap_angle(floors[0].heading_offset_rad - turn_rad), 0.0, 0.01) << turn_deg;
    // A floor without walks of its own takes the site's.
    EXPECT_NEAR(core::wrap_angle(floors[1].heading_offset_rad - turn_rad), 0.0, 0.01) << turn_deg;
    EXPECT_EQ(built->quality.floors.at(0).heading_offset_rad, floors[0].heading_offset_rad);
    EXPECT_EQ(built->quality.stretches_straight, 0U);
    EXPECT_NEAR(built->quality.floors.at(0).step_scale, 1.1, 0.03);
  }
}

TEST(MapBuilder, LearnsTheOffsetInTheFrameThatFloorsShare) {
  // The drawing of F1 is turned a quarter: its x points to the site's north. F2's is not.
  site::SiteParts parts = two_floors();
  parts.floors[0].site_from_floor.linear << 0.0, -1.0, 1.0, 0.0;
  MapBuilder builder(std::move(parts), options());
  builder.add(straight_walk(0.5, 0.2, 1.0, "F1"));
  const auto built = builder.build();
  ASSERT_TRUE(built);
  EXPECT_NEAR(built->parts.floors[0].heading_offset_rad, 0.2 + kPi / 2.0, 0.01);
  EXPECT_NEAR(built->parts.floors[1].heading_offset_rad, 0.2 + kPi / 2.0, 0.01);
}

TEST(MapBuilder, RefusesTheOptionsOfAnyPart) {
  EXPECT_TRUE(MapBuilder::Options{}.validate());
  const auto refused = [](auto&& spoil) {
    MapBuilder::Options options;
    spoil(options);
    return !options.validate();
  };
  EXPECT_TRUE(refused([](auto& o) { o.scan.max_age_s = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.pdr.step_heading_sigma_rad = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.labels.fastest_mps = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.moving.farthest_m = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.magnetic.spacing_m = 0.0; }));
}

}  // namespace
}  // namespace waylode::survey
