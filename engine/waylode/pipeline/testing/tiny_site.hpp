// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/fused_fixture.hpp"
#include "waylode/magnetic/features.hpp"
#include "waylode/pipeline/session.hpp"

/// Two floors of 40 m x 10 m with five access points each and a fingerprint on every second metre,
/// with a magnetic map or without: small enough to know every answer.
namespace waylode::pipeline::testing {

using fusion::testing::at_s;

/// What is heard at a place: 25 dB less per tenfold distance, 30 dB less through the slab, no
/// noise.
inline std::vector<site::MapReading> readings_at(core::FloorId floor,
                                                 const core::Vector2& position_m) {
  constexpr std::array<double, 5> kAccessPointX_m = {2.0, 11.0, 20.0, 27.0, 38.0};
  std::vector<site::MapReading> readings;
  for (std::uint16_t level = 0; level < 2; ++level) {
    for (std::size_t i = 0; i < kAccessPointX_m.size(); ++i) {
      const core::Vector2 access_point_m(kAccessPointX_m[i], i % 2 == 0 ? 1.0 : 9.0);
      const double distance_m = std::max(1.0, (position_m - access_point_m).norm());
      const double rssi_dbm =
          -40.0 - 25.0 * std::log10(distance_m) - (level == floor.index ? 0.0 : 30.0);
      if (rssi_dbm < -92.0) continue;
      readings.push_back(
          {core::TransmitterId::wifi(0x10 * (level + 1U) + i), static_cast<float>(rssi_dbm), 0.0F});
    }
  }
  return readings;
}

inline site::SiteParts tiny_floors() {
  site::SiteParts parts;
  parts.name = "tiny";
  parts.floors.resize(2);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "F2";
  parts.floors[1].level = 1;
  for (site::Floor& floor : parts.floors) floor.bounds.max_m = {40.0, 10.0};
  return parts;
}

/// Level field of a place: bumps of a few metres, another pattern on each floor.
inline magnetic::LevelField field_at(core::FloorId floor, const core::Vector2& position_m) {
  const double shift = 1.3 * floor.index;
  return {
      25.0 + 6.0 * std::sin(0.9 * position_m.x() + shift) + 3.0 * std::sin(1.7 * position_m.y()),
      -40.0 + 6.0 * std::cos(1.3 * position_m.x() - shift) +
          4.0 * std::cos(1.1 * position_m.y() + 0.7 * position_m.x())};
}

inline site::MagneticMapStorage tiny_field() {
  site::MagneticMapBuilder builder{site::MagneticMapBuilder::Options()};
  for (std::uint16_t floor = 0; floor < 2; ++floor) {
    for (int column = 0; column < 80; ++column) {
      for (int row = 0; row < 20; ++row) {
        const core::Vector2 place_m(0.25 + 0.5 * column, 0.25 + 0.5 * row);
        const magnetic::LevelField field = field_at({floor}, place_m);
        builder.add({floor}, place_m, field.horizontal_ut, field.vertical_ut);
      }
    }
  }
  return builder.build();
}

enum class Field : std::uint8_t { kUnknown, kSurveyed };

inline site::SiteParts tiny_parts(Field field) {
  site::SiteParts parts = tiny_floors();
  if (field == Field::kSurveyed) parts.magnetic_map = tiny_field();
  site::RadioMapBuilder builder;
  for (std::uint16_t floor = 0; floor < 2; ++floor) {
    for (int x_m = 0; x_m <= 40; x_m += 2) {
      for (int y_m = 0; y_m <= 10; y_m += 2) {
        site::FingerprintRecord record;
        record.x_m = static_cast<float>(x_m);
        record.y_m = static_cast<float>(y_m);
        record.floor = floor;
        builder.add(record, readings_at({floor}, {x_m, y_m}));
      }
    }
  }
  parts.radio_map = builder.build();
  return parts;
}

inline std::shared_ptr<const site::Site> tiny_site(Field field = Field::kUnknown) {
  return std::make_shared<const site::Site>(tiny_parts(field));
}

/// The upper floor lies in the site turned by +90 degrees and then moved by (10, 0); headings on
/// the site are 0.3 rad more than the phone's.
inline std::shared_ptr<const site::Site> turned_site() {
  site::SiteParts parts = tiny_parts(Field::kSurveyed);
  parts.floors[1].site_from_floor.linear << 0.0, -1.0, 1.0, 0.0;
  parts.floors[1].site_from_floor.translation_m = {10.0, 0.0};
  parts.floors[1].heading_offset_rad = 0.3;
  return std::make_shared<const site::Site>(std::move(parts));
}

/// What matters for the tiny site, said here: the nearest fingerprint alone, 3 m of error.
inline Options tiny_options() {
  Options options;
  options.wknn.neighbours = 1;
  options.wknn.floor_neighbours = 1;
  options.wknn.base_sigma_m = 3.0;
  options.wknn.min_readings = 3;
  options.wknn.few_readings = options.wknn.floor_few_readings = 0.0;
  options.fused = fusion::testing::fused_options();
  options.fused.planar.radio_degrees_of_freedom = 4.0;
  options.fused.planar.lost_weight_ratio = 0.25;
  options.smoothing_rounds = 3;
  return options;
}

inline std::shared_ptr<const Model> model_of(std::shared_ptr<const site::Site> site,
                                             const Options& options = tiny_options()) {
  auto model = Model::create(std::move(site), options);
  if (!model) throw std::logic_error(core::to_string(model.error()));
  return *model;
}

inline std::shared_ptr<const Model> tiny_model(Field field = Field::kUnknown) {
  return model_of(tiny_site(field));
}

inline sample::WifiScan scan_at(double time_s, core::FloorId floor,
                                const core::Vector2& position_m) {
  sample::WifiScan scan;
  scan.time = at_s(time_s);
  for (const site::MapReading& reading : readings_at(floor, position_m)) {
    scan.readings.push_back({reading.transmitter, reading.rssi_dbm, 2412, scan.time, ""});
  }
  return scan;
}

/// A bounce of two steps a second, the phone level and pointing north-east all the time.
inline std::vector<sample::Sample> bouncing(double from_s, double to_s) {
  const double eighth_rad = std::acos(-1.0) / 8.0;
  const core::Quaternion north_east(std::cos(-eighth_rad), 0.0, 0.0, std::sin(-eighth_rad));
  std::vector<sample::Sample> samples;
  for (int i = static_cast<int>(from_s * 50.0); i < static_cast<int>(to_s * 50.0); ++i) {
    const double time_s = 0.02 * i;
    const double bounce_mps2 = 3.0 * std::sin(4.0 * std::acos(-1.0) * time_s);
    samples.emplace_back(sample::AccelerometerSample{at_s(time_s), {0.0, 0.0, 9.81 + bounce_mps2}});
    samples.emplace_back(sample::GyroscopeSample{at_s(time_s), core::Vector3::Zero()});
    samples.emplace_back(sample::RotationSample{at_s(time_s), north_east});
    samples.emplace_back(sample::MagnetometerSample{
        at_s(time_s), north_east.conjugate() * core::Vector3(0.0, 20.0, -44.0), 3});
  }
  return samples;
}

/// Half a minute of steps with a scan every two seconds at places drawn with `seed`.
inline std::vector<sample::Sample> tiny_walk(std::uint64_t seed) {
  core::Rng rng(seed);
  std::vector<sample::Sample> samples = bouncing(0.0, 30.0);
  for (double time_s = 1.0; time_s < 30.0; time_s += 2.0) {
    const core::Vector2 place_m(rng.uniform(0.0, 40.0), rng.uniform(0.0, 10.0));
    const auto floor = static_cast<std::uint16_t>(time_s < 20.0 ? 0 : 1);
    samples.emplace_back(scan_at(time_s, {floor}, place_m));
  }
  std::ranges::stable_sort(samples, {}, sample::time_of);
  return samples;
}

inline std::vector<core::DeviceTime> instants(double from_s, double to_s, double every_s) {
  std::vector<core::DeviceTime> result;
  for (int i = 0; from_s + every_s * i <= to_s; ++i) result.push_back(at_s(from_s + every_s * i));
  return result;
}

inline SessionOptions started_at(const core::Vector2& position_m) {
  SessionOptions options;
  options.start = StartPose{at_s(0.0), core::FloorId{0}, position_m, 1.0};
  return options;
}

}  // namespace waylode::pipeline::testing
