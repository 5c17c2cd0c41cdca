// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/sim/simulate.hpp"
#include "waylode/site/site.hpp"

namespace waylode::experiment {

/// A point of a magnetic base map: the two components that do not depend on the heading.
struct MagneticMapPoint {
  core::Vector2 position_m;
  double horizontal_ut = 0.0;
  double vertical_ut = 0.0;  ///< Upwards.
};

/// A room of a paper, surveyed, and one walk of somebody unknown through it. Floor frame: metres, x
/// east, y north; the field's horizontal part points north. One floor, FloorId 0.
struct PaperRoom {
  sim::Scenario scenario;  ///< What all below was made from; sim::World::make gives the physics.
  /// The floor's outline and the radio map: several instances per reference point, each with a
  /// recording number of its own and each the mean of `scans_per_instance` scans of `survey`.
  site::Site site;
  std::vector<core::Vector2> reference_points_m;
  /// Every scan of the survey, reference point by reference point.
  std::vector<sample::FingerprintRow> survey;
  std::size_t instances_per_point = 0;
  std::size_t scans_per_instance = 0;
  std::vector<MagneticMapPoint> magnetic_map;  ///< Along `magnetic_line_m`, in order.
  std::vector<core::Vector2> magnetic_line_m;  ///< Vertices.
  sim::SimulatedRecording walk;                ///< Samples, truth at 10 Hz, steps.
  /// Scans taken standing at the start before the walk; their times are not those of the walk.
  std::vector<sample::WifiScan> start_scans;
  std::vector<core::Vector2> route_m;  ///< Vertices; the first is the start.
};

/// Car park of 16 m x 15.8 m, 3 routers, 1 m grid, a scan a second. [Wu2019] section 4
enum class WuPreset : std::uint8_t {
  kI,  ///< Quiet radio.
  kA,  ///< Ordinary radio.
  kC,  ///< As kA, but every scan the mean of a hundred.
  kD,  ///< Harsh radio.
};
core::Result<PaperRoom> wu_room(WuPreset preset, std::uint64_t seed);

/// Corridor of 30 m x 3 m, 4 ceiling access points, out and back. [Zhou2016] section 3
enum class ZhouPreset : std::uint8_t {
  kA,  ///< Ordinary; magnetic map of 0.2 m.
  kH,  ///< Back on another lane, magnetic map of 1 m, a phone with 3 uT of bias.
};
core::Result<PaperRoom> zhou_corridor(ZhouPreset preset, std::uint64_t seed);

/// Three sides of a square corridor of 10 m x 10 m, 1 m grid. [Zhao2019] section 3
enum class ZhaoPreset : std::uint8_t {
  kNormal,
  kHarsh,           ///< Fewer access points, flatter and noisier radio.
  kHarshSlowScans,  ///< The same with a scan every 3 s instead of every 0.5 s.
};
core::Result<PaperRoom> zhao_square(ZhaoPreset preset, std::uint64_t seed);

/// A walk of 50 m for the effective displacement, and one to calibrate the same person and phone
/// by. [Zhong2017] section 3
struct PaperWalk {
  sim::Scenario scenario;
  double height_m = 0.0;  ///< Of the person.
  sim::SimulatedRecording calibration;
  double calibration_length_m = 0.0;
  std::size_t calibration_steps = 0;
  sim::SimulatedRecording walk;  ///< Steps in place are there with is_effective false.
  double length_m = 0.0;         ///< Really walked: corners are rounded.
  std::vector<core::Vector2> route_m;
};
enum class ZhongKind : std::uint8_t {
  kStraight,
  kTurns,      ///< Two right-angled turns.
  kTurnsBack,  ///< The same way walked from its end to its start.
  kPhoto,      ///< The same with 3 stops to take photos.
  kCrowd,      ///< The same with 4 dodges.
};
core::Result<PaperWalk> zhong_walk(ZhongKind kind, std::uint64_t seed);

}  // namespace waylode::experiment
