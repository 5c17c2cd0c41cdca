// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/pipeline/session.hpp"
#include "waylode/pipeline/testing/tiny_site.hpp"

/// What a session must take without harm: maps of next to nothing and phones that tell nonsense.
namespace waylode::pipeline {
namespace {

using core::FloorId;
using core::Vector2;
using core::Vector3;
using sample::Sample;
using testing::at_s;
using testing::instants;
using testing::scan_at;
using testing::tiny_walk;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The papers' methods and every part of theirs.
const std::vector<Method>& papers_methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> made;
    for (const char* name :
         {"wu2019", "zhou2016", "zhao2019", "zhong2017", "wu2019+fusion=unscented_when_large",
          "wu2019+fusion=pairs", "wu2019+fusion=dead_reckoning", "wknn+radio=region_wknn",
          "zhou2016+fusion=magnetic", "zhou2016+fusion=intervals_unfiltered",
          "zhou2016+fusion=raw_terms", "wknn+radio=window_knn", "zhao2019+fusion=feedback_literal",
          "zhao2019+radio=support_vectors", "zhao2019+radio=knn", "zhong2017+validity=dispersion",
          "zhong2017+validity=three_way+stride=table"}) {
      made.push_back(*find_method(name));
    }
    return made;
  }();
  return all;
}

Session session_of(const std::shared_ptr<const Model>& model, const Method& method) {
  SessionOptions options;
  if (method.needs_start()) options = testing::started_at({10.0, 5.0});
  auto session = Session::create(model, method, options);
  if (!session) throw std::logic_error(core::to_string(session.error()));
  return *std::move(session);
}

/// Replays and sees that no answer is nonsense. Returns how many instants had a belief.
std::size_t expect_sound(const std::shared_ptr<const Model>& model, const Method& method,
                         const std::vector<Sample>& samples,
                         const std::vector<core::DeviceTime>& at) {
  Session session = session_of(model, method);
  std::size_t beliefs = 0;
  for (const core::Fix& fix : replay(session, method, samples, at)) {
    if (!fix.belief) {
      EXPECT_EQ(fix.state, core::FixState::kUnknown) << method.name;
      continue;
    }
    ++beliefs;
    EXPECT_TRUE(fix.belief->position_m.allFinite()) << method.name;
    EXPECT_LT(fix.belief->position_m.norm(), 1e5) << method.name;
    EXPECT_TRUE(core::is_valid_covariance(fix.belief->covariance_m2)) << method.name;
    EXPECT_GE(fix.belief->floor_probability, 0.0) << method.name;
    EXPECT_LE(fix.belief->floor_probability, 1.0) << method.name;
    EXPECT_LT(fix.belief->floor.index, 2) << method.name;
  }
  return beliefs;
}

const std::shared_ptr<const Model>& surveyed_model() {
  static const auto model = testing::tiny_model(testing::Field::kSurveyed);
  return model;
}

/// A tiny site with other fingerprints.
std::shared_ptr<const Model> model_with(const site::RadioMapStorage& radio_map) {
  site::SiteParts parts = testing::tiny_parts(testing::Field::kSurveyed);
  parts.radio_map = radio_map;
  return testing::model_of(std::make_shared<const site::Site>(std::move(parts)));
}

site::FingerprintRecord record_at(float x_m, float y_m) {
  site::FingerprintRecord record;
  record.x_m = x_m;
  record.y_m = y_m;
  return record;
}

/// Half a minute of steps and scans of `readings`.
std::vector<Sample> walk_hearing(const std::vector<sample::WifiReading>& readings) {
  std::vector<Sample> samples = testing::bouncing(0.0, 20.0);
  for (double time_s = 1.0; time_s < 20.0; time_s += 1.5) {
    sample::WifiScan scan{at_s(time_s), readings};
    for (sample::WifiReading& reading : scan.readings) reading.last_seen = scan.time;
    samples.emplace_back(std::move(scan));
  }
  std::ranges::stable_sort(samples, {}, sample::time_of);
  return samples;
}

sample::WifiReading reading_of(std::uint64_t transmitter, float rssi_dbm) {
  return {core::TransmitterId::wifi(transmitter), rssi_dbm, 2412, at_s(0.0), ""};
}

TEST(HostileSession, GetsAlongWithASingleFingerprint) {
  site::RadioMapBuilder builder;
  builder.add(record_at(14.0F, 6.0F), testing::readings_at({0}, {14.0, 6.0}));
  const auto model = model_with(builder.build());  // Every K is larger than the map.
  const auto at = instants(0.0, 31.0, 0.7);
  for (const Method& method : papers_methods()) {
    EXPECT_GT(expect_sound(model, method, tiny_walk(11), at), 0U) << method.name;
  }
}

TEST(HostileSession, GetsAlongWithASingleAccessPoint) {
  site::RadioMapBuilder builder;
  for (int i = 0; i <= 20; ++i) {
    const double x_m = 2.0 * i;
    const auto rssi_dbm = static_cast<float>(-40.0 - 2.0 * std::abs(x_m - 11.0));
    builder.add(record_at(static_cast<float>(x_m), 5.0F),
                std::vector<site::MapReading>{{core::TransmitterId::wifi(0x77), rssi_dbm, 0.0F}});
  }
  const auto model = model_with(builder.build());
  const auto at = instants(0.0, 21.0, 0.7);
  for (const float rssi_dbm : {-40.0F, -61.0F, -120.0F}) {
    const auto samples = walk_hearing({reading_of(0x77, rssi_dbm)});
    for (const Method& method : papers_methods()) expect_sound(model, method, samples, at);
  }
}

TEST(HostileSession, GetsAlongWithFingerprintsThatAllSayTheSame) {
  site::RadioMapBuilder builder;
  for (int i = 0; i <= 20; ++i) {
    builder.add(record_at(2.0F * static_cast<float>(i), 5.0F),
                testing::readings_at({0}, {14.0, 6.0}));
  }
  const auto model = model_with(builder.build());
  const auto at = instants(0.0, 31.0, 0.7);
  for (const Method& method : papers_methods()) {
    EXPECT_GT(expect_sound(model, method, tiny_walk(12), at), 0U) << method.name;
  }
}

TEST(HostileSession, KnowsNothingWhenScansAreEmpty) {
  const auto at = instants(0.0, 21.0, 0.7);
  for (const Method& method : papers_methods()) {
    const std::size_t beliefs = expect_sound(surveyed_model(), method, walk_hearing({}), at);
    EXPECT_EQ(beliefs, method.needs_start() ? at.size() : 0U) << method.name;
  }
}

TEST(HostileSession, GetsAlongWithReadingsThatAreNoNumbers) {
  const auto at = instants(0.0, 31.0, 0.7);
  for (const float rssi_dbm : {kNan, kInfinity, -kInfinity, 0.0F, 1e30F, -1e30F}) {
    std::vector<Sample> samples = tiny_walk(13);
    for (Sample& sample : samples) {
      auto* scan = std::get_if<sample::WifiScan>(&sample);
      if (scan == nullptr) continue;
      for (std::size_t i = 0; i < scan->readings.size(); i += 3) {
        scan->readings[i].rssi_dbm = rssi_dbm;
      }
    }
    for (const Method& method : papers_methods()) {
      SCOPED_TRACE(std::to_string(rssi_dbm));
      expect_sound(surveyed_model(), method, samples, at);
    }
  }
}

/// Breaks every `every`th sample of the sensors.
std::vector<Sample> with_broken_sensors(std::vector<Sample> samples, std::size_t every,
                                        double value) {
  const Vector3 broken = Vector3::Constant(value);
  for (std::size_t i = 0; i < samples.size(); i += every) {
    if (auto* force = std::get_if<sample::AccelerometerSample>(&samples[i])) {
      force->specific_force_mps2 = broken;
    } else if (auto* rate = std::get_if<sample::GyroscopeSample>(&samples[i])) {
      rate->angular_rate_radps = broken;
    } else if (auto* field = std::get_if<sample::MagnetometerSample>(&samples[i])) {
      field->field_ut = broken;
    } else if (auto* rotation = std::get_if<sample::RotationSample>(&samples[i])) {
      rotation->enu_from_device = core::Quaternion(value, value, value, value);
    }
  }
  return samples;
}

TEST(HostileSession, GetsAlongWithSensorsThatTellNoNumbers) {
  const auto at = instants(0.0, 31.0, 0.7);
  for (const double value : {static_cast<double>(kNan), static_cast<double>(kInfinity), 0.0}) {
    for (const std::size_t every : {1U, 7U}) {
      const auto samples = with_broken_sensors(tiny_walk(14), every, value);
      for (const Method& method : papers_methods()) {
        SCOPED_TRACE(std::to_string(value) + " " + std::to_string(every));
        EXPECT_GT(expect_sound(surveyed_model(), method, samples, at), 0U) << method.name;
      }
    }
  }
}

TEST(HostileSession, GetsAlongWithGaps) {
  // A minute, an hour and a day of silence.
  std::vector<Sample> samples = tiny_walk(15);
  const std::vector<Sample> again = samples;
  double begin_s = 0.0;
  for (const double gap_s : {60.0, 3600.0, 86'400.0}) {
    begin_s += 30.0 + gap_s;
    for (Sample sample : again) {
      std::visit([&](auto& one) { one.time += core::from_seconds(begin_s); }, sample);
      if (auto* scan = std::get_if<sample::WifiScan>(&sample)) {
        for (sample::WifiReading& reading : scan->readings) reading.last_seen = scan->time;
      }
      samples.push_back(std::move(sample));
    }
  }
  std::vector<core::DeviceTime> at = instants(0.0, 120.0, 1.7);
  for (const core::DeviceTime time : instants(3000.0, begin_s + 40.0, 97.0)) at.push_back(time);
  for (const Method& method : papers_methods()) {
    EXPECT_GT(expect_sound(surveyed_model(), method, samples, at), 0U) << method.name;
  }
}

TEST(HostileSession, GetsAlongWithDuplicateTimes) {
  // Every sample twice, and all of a second at its beginning.
  std::vector<Sample> samples;
  for (Sample sample : tiny_walk(16)) {
    samples.push_back(sample);
    samples.push_back(sample);
  }
  std::vector<Sample> rounded = samples;
  for (Sample& sample : rounded) {
    std::visit(
        [](auto& one) {
          one.time = at_s(std::floor(core::to_seconds(one.time - core::DeviceTime())));
        },
        sample);
  }
  const auto at = instants(0.0, 31.0, 0.7);
  for (const Method& method : papers_methods()) {
    EXPECT_GT(expect_sound(surveyed_model(), method, samples, at), 0U) << method.name;
    EXPECT_GT(expect_sound(surveyed_model(), method, rounded, at), 0U) << method.name;
  }
}

TEST(HostileSession, GetsAlongWithEverythingAtOnce) {
  const auto at = instants(0.0, 31.0, 0.9);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    core::Rng rng(seed);
    std::vector<Sample> samples;
    for (Sample sample : tiny_walk(100 + seed)) {
      if (rng.uniform(0.0, 1.0) < 0.1) continue;  // Lost.
      if (rng.uniform(0.0, 1.0) < 0.05) samples.push_back(sample);
      auto* scan = std::get_if<sample::WifiScan>(&sample);
      if (scan != nullptr && rng.uniform(0.0, 1.0) < 0.5) {
        scan->readings.resize(scan->readings.size() / 2);
        if (!scan->readings.empty()) scan->readings.front().rssi_dbm = kNan;
      }
      samples.push_back(std::move(sample));
    }
    samples = with_broken_sensors(samples, 23, kNan);
    for (const Method& method : papers_methods()) {
      SCOPED_TRACE(seed);
      expect_sound(surveyed_model(), method, samples, at);
    }
  }
}

}  // namespace
}  // namespace waylode::pipeline
