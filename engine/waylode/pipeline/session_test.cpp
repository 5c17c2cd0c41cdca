// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/session.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using core::FloorId;
using core::Vector2;
using sample::Sample;
using testing::at_s;
using testing::instants;
using testing::scan_at;
using testing::started_at;
using testing::tiny_model;
using testing::tiny_walk;

/// One for all tests: regressions train when it is first asked for them.
const std::shared_ptr<const Model>& surveyed_model() {
  static const std::shared_ptr<const Model> model = tiny_model(testing::Field::kSurveyed);
  return model;
}

Session session_of(const Method& method, std::optional<FloorId> known_floor = std::nullopt) {
  SessionOptions options;
  if (method.needs_start()) options = started_at({10.0, 5.0});
  options.known_floor = known_floor;
  return *Session::create(surveyed_model(), method, options);
}

std::vector<core::Fix> replayed(const Method& method, const std::vector<Sample>& samples,
                                const std::vector<core::DeviceTime>& at) {
  Session session = session_of(method);
  return replay(session, method, samples, at);
}

/// Everything after `time` told otherwise: scans heard elsewhere, the phone turned and shaken.
std::vector<Sample> altered_after(std::vector<Sample> samples, core::DeviceTime time) {
  for (Sample& sample : samples) {
    if (sample::time_of(sample) <= time) continue;
    if (auto* scan = std::get_if<sample::WifiScan>(&sample)) {
      for (sample::WifiReading& reading : scan->readings) {
        reading.rssi_dbm = -130.0F - reading.rssi_dbm;
      }
    } else if (auto* force = std::get_if<sample::AccelerometerSample>(&sample)) {
      force->specific_force_mps2.z() = 2.0 * 9.81 - force->specific_force_mps2.z();
    } else if (auto* rotation = std::get_if<sample::RotationSample>(&sample)) {
      rotation->enu_from_device = core::Quaternion(0.6, 0.0, 0.0, 0.8);
    } else if (auto* field = std::get_if<sample::MagnetometerSample>(&sample)) {
      field->field_ut = core::Vector3(20.0, 0.0, -44.0);
    }
  }
  return samples;
}

sample::WifiScan foreign_scan(double time_s, std::size_t count) {
  sample::WifiScan scan;
  scan.time = at_s(time_s);
  for (std::uint64_t i = 0; i < count; ++i) {
    scan.readings.push_back({core::TransmitterId::wifi(0xABC0 + i), -60.0F, 2412, scan.time, ""});
  }
  return scan;
}

TEST(Session, RefusesDeadReckoningWithoutAStart) {
  const auto session = Session::create(tiny_model(), *find_method("pdr"), {});
  ASSERT_FALSE(session);
  EXPECT_EQ(session.error().code, core::ErrorCode::kInvalidArgument);
}

TEST(Session, RefusesMagneticMatchingOnASiteWithoutAMagneticMap) {
  const auto model = tiny_model();
  const auto session = Session::create(model, *find_method("zhou2016"), {});
  ASSERT_FALSE(session);
  EXPECT_EQ(session.error().code, core::ErrorCode::kMapMissing);
  EXPECT_EQ(session.error().place, "tiny");
  EXPECT_TRUE(Session::create(model, *find_method("zhou2016+magnetic=none"), {}));
}

TEST(Session, RefusesFloorsThatTheSiteDoesNotHave) {
  SessionOptions options = started_at({1.0, 1.0});
  options.start->floor = FloorId{2};
  const auto lost_start = Session::create(surveyed_model(), *find_method("pdr"), options);
  ASSERT_FALSE(lost_start);
  EXPECT_EQ(lost_start.error().code, core::ErrorCode::kInvalidArgument);
  for (const Method& method : methods()) {
    SessionOptions elsewhere = started_at({1.0, 1.0});
    elsewhere.known_floor = FloorId{2};
    const auto session = Session::create(surveyed_model(), method, elsewhere);
    ASSERT_FALSE(session) << method.name;
    EXPECT_EQ(session.error().code, core::ErrorCode::kInvalidArgument) << method.name;
  }
}

TEST(Session, NeverMakesUpAPositionWithoutWifi) {
  const auto samples = testing::bouncing(0.0, 10.0);
  for (const Method& method : methods()) {
    if (method.needs_start()) continue;
    for (const core::Fix& fix : replayed(method, samples, instants(0.0, 12.0, 1.5))) {
      EXPECT_EQ(fix.belief, std::nullopt) << method.name;
      EXPECT_EQ(fix.state, core::FixState::kUnknown) << method.name;
      EXPECT_EQ(fix.provenance.last_scan, std::nullopt) << method.name;
    }
  }
}

TEST(Session, NeverMakesUpAPositionFromTransmittersItDoesNotKnow) {
  for (const Method& method : methods()) {
    if (method.needs_start()) continue;
    EXPECT_EQ(replayed(method, {foreign_scan(1.0, 10)}, {at_s(1.0)}).front().belief, std::nullopt)
        << method.name;
  }
}

TEST(Session, IsOutsideOnceNothingHeardIsKnown) {
  for (const Method& method : methods()) {
    if (method.needs_start()) continue;
    Session session = session_of(method, FloorId{0});
    for (int i = 0; i < 10; ++i) session.push(scan_at(2.0 * i, FloorId{0}, {14.0, 6.0}));
    EXPECT_NE(session.fix_at(at_s(18.0)).state, core::FixState::kOutside) << method.name;
    session.push(foreign_scan(20.0, 2));  // Too few to say anything.
    EXPECT_NE(session.fix_at(at_s(20.0)).state, core::FixState::kOutside) << method.name;
    session.push(foreign_scan(22.0, 3));
    const core::Fix fix = session.fix_at(at_s(22.0));
    EXPECT_EQ(fix.state, core::FixState::kOutside) << method.name;
    EXPECT_TRUE(fix.belief) << method.name;
    EXPECT_EQ(fix.provenance.last_scan, at_s(18.0)) << method.name;
    session.push(scan_at(24.0, FloorId{0}, {14.0, 6.0}));
    EXPECT_NE(session.fix_at(at_s(24.0)).state, core::FixState::kOutside) << method.name;
  }
}

TEST(Session, FindsTheFingerprintThatWasHeard) {
  const Method method = *find_method("wknn");
  Session session = session_of(method);
  session.push(scan_at(3.0, FloorId{1}, {14.0, 6.0}));
  const core::Fix fix = session.fix_at(at_s(4.0));
  ASSERT_TRUE(fix.belief);
  EXPECT_EQ(fix.belief->floor, FloorId{1});
  EXPECT_LT((fix.belief->position_m - Vector2(14.0, 6.0)).norm(), 1e-6);
  EXPECT_LT((fix.belief->covariance_m2 - 9.0 * core::Matrix2::Identity()).norm(), 1e-6);
  EXPECT_EQ(fix.time, at_s(4.0));
  EXPECT_EQ(fix.provenance.method, "wknn");
  EXPECT_EQ(fix.provenance.map_version, 0U);
  EXPECT_EQ(fix.provenance.last_scan, at_s(3.0));
}

TEST(Session, StaysOnTheFloorItWasTold) {
  for (const Method& method : methods()) {
    if (method.needs_start()) continue;
    Session session = session_of(method, FloorId{1});
    for (int i = 0; i < 5; ++i) session.push(scan_at(1.0 + i, FloorId{0}, {14.0, 6.0}));
    const core::Fix fix = session.fix_at(at_s(5.0));
    if (!fix.belief) continue;
    EXPECT_EQ(fix.belief->floor, FloorId{1}) << method.name;
    EXPECT_EQ(fix.belief->floor_probability, 1.0) << method.name;
  }
}

TEST(Session, DeadReckonsFromItsStartWithoutListening) {
  const Method method = *find_method("pdr");
  Session session = session_of(method);
  session.push(scan_at(0.5, FloorId{1}, {38.0, 1.0}));
  const core::Fix still = session.fix_at(at_s(0.5));
  ASSERT_TRUE(still.belief);
  EXPECT_EQ(still.belief->floor, FloorId{0});
  EXPECT_LT((still.belief->position_m - Vector2(10.0, 5.0)).norm(), 1e-12);
  for (const Sample& sample : testing::bouncing(1.0, 11.0)) session.push(sample);
  // Some twenty steps towards the north-east.
  const Vector2 walked_m = session.fix_at(at_s(11.0)).belief->position_m - Vector2(10.0, 5.0);
  EXPECT_GT(walked_m.norm(), 6.0);
  EXPECT_LT(walked_m.norm(), 22.0);
  EXPECT_NEAR(std::atan2(walked_m.y(), walked_m.x()), std::acos(-1.0) / 4.0, 0.05);
}

TEST(Session, DoesNotLookAtTheSurveyorsMarks) {
  const auto samples = tiny_walk(8);
  std::vector<Sample> marked;
  for (const Sample& sample : samples) {
    marked.push_back(sample);
    if (!std::holds_alternative<sample::WifiScan>(sample)) continue;
    sample::WaypointSample mark;
    mark.time = sample::time_of(sample);
    mark.position_m = Vector2(1.0, 1.0);
    mark.floor = "F2";
    marked.emplace_back(mark);
  }
  for (const Method& method : methods()) {
    const auto at = instants(0.0, 30.0, 0.7);
    EXPECT_EQ(replayed(method, marked, at), replayed(method, samples, at)) << method.name;
  }
}

TEST(Session, GoesOnAfterBeingMoved) {
  const Method method = *find_method("fused");
  const auto samples = tiny_walk(9);
  const auto at = instants(30.0, 30.0, 1.0);
  Session first = session_of(method);
  const std::size_t half = samples.size() / 2;
  for (std::size_t i = 0; i < half; ++i) first.push(samples[i]);
  Session second = std::move(first);
  for (std::size_t i = half; i < samples.size(); ++i) second.push(samples[i]);
  EXPECT_EQ(second.fix_at(at[0]), replayed(method, samples, at).front());
}

TEST(Replay, EqualsPushingSampleBySample) {
  const auto samples = tiny_walk(1);
  const auto at = instants(0.0, 31.0, 0.37);
  for (const Method& method : methods()) {
    const auto fixes = replayed(method, samples, at);
    ASSERT_EQ(fixes.size(), at.size());
    Session session = session_of(method);
    std::size_t next = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto until =
          method.whole_track()
              ? samples.size()
              : static_cast<std::size_t>(
                    std::ranges::upper_bound(samples, at[i] + method.lag, {}, sample::time_of) -
                    samples.begin());
      while (next < until) session.push(samples[next++]);
      EXPECT_EQ(session.fix_at(at[i]), fixes[i]) << method.name << " " << i;
    }
  }
}

TEST(Replay, GivesTheSameFixesEveryTime) {
  const auto at = instants(0.0, 30.0, 0.5);
  for (const Method& method : methods()) {
    EXPECT_EQ(replayed(method, tiny_walk(2), at), replayed(method, tiny_walk(2), at))
        << method.name;
  }
}

TEST(Replay, LooksNoFartherAheadThanTheMethodSays) {
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    const auto samples = tiny_walk(seed);
    for (const Method& method : methods()) {
      if (method.whole_track()) continue;
      for (const double time_s : {3.1, 9.0, 14.62}) {
        const auto at = instants(0.0, time_s, 0.31);
        const auto otherwise = altered_after(samples, at_s(time_s) + method.lag);
        EXPECT_EQ(replayed(method, otherwise, at), replayed(method, samples, at))
            << method.name << " " << time_s;
      }
    }
  }
}

TEST(Replay, ChangesFixesWhenTheirOwnSamplesChange) {
  // The control of the test above: what may be known does count.
  const auto samples = tiny_walk(3);
  const auto at = instants(15.0, 15.0, 1.0);
  const auto past = altered_after(samples, at_s(10.0));
  const auto soon = altered_after(samples, at_s(15.0));
  for (const Method& method : methods()) {
    EXPECT_NE(replayed(method, past, at), replayed(method, samples, at)) << method.name;
    const bool sees_ahead = method.whole_track() || method.lag > core::Duration{};
    EXPECT_EQ(replayed(method, soon, at) != replayed(method, samples, at), sees_ahead)
        << method.name;
  }
}

TEST(Replay, AnswersEveryInstantEvenWithoutSamples) {
  for (const Method& method : methods()) {
    EXPECT_EQ(replayed(method, {}, instants(0.0, 2.0, 1.0)).size(), 3U) << method.name;
  }
}

}  // namespace
}  // namespace waylode::pipeline
