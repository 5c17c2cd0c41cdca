// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/sim/ascii_building.hpp"
#include "waylode/sim/simulate.hpp"

namespace waylode {
namespace {

/// 35 m east, a corner to the left, 14 m north.
constexpr const char* kCorridor =
    "floor F1 level 0 elevation_m 0\n"
    "########################################\n"
    "#####################################3.#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#####################################..#\n"
    "#......................................#\n"
    "#.1..................................2.#\n"
    "########################################\n";

constexpr double kBounceConstant = 0.42;  // m per (m/s2)^(1/4)

struct Case {
  std::uint64_t seed;
  double speed_mps;
};

sim::SimulatedRecording walk_the_corridor(const Case& scene) {
  sim::Scenario scenario;
  scenario.name = "corridor";
  scenario.seed = scene.seed;
  scenario.building = *sim::parse_ascii_building(kCorridor, "corridor");
  sim::Walker walker;
  walker.name = "walker";
  walker.route = {"1", "2", "3"};
  walker.gait.speed_mps = scene.speed_mps;
  walker.gait.bounce_constant = kBounceConstant;
  walker.phone.imu_rate_hz = 50.0;
  scenario.walkers = {walker};
  auto simulation = sim::simulate(scenario);
  EXPECT_TRUE(simulation) << (simulation ? "" : to_string(simulation.error()));
  return std::move(simulation->recordings.at(0));
}

/// The simulator's law, its constant raised by what two first-order stages take from the swing.
pdr::DeadReckoning::Options options_for(const sim::SimulatedRecording& recording) {
  pdr::DeadReckoning::Options options;
  options.step = {.low_pass_hz = 3.0,
                  .min_peak_mps2 = 0.55,
                  .relative_peak_ratio = 0.4,
                  .shortest_interval_s = 0.28,
                  .longest_interval_s = 1.2};
  const double walking_s =
      core::to_seconds(recording.steps.back().time - recording.steps.front().time);
  const double cadence_hz = static_cast<double>(recording.steps.size() - 1) / walking_s;
  const double swing_ratio = 1.0 / (1.0 + std::pow(cadence_hz / options.step.low_pass_hz, 2));
  options.stride = {.constant_m = 0.0,
                    .swing_gain = kBounceConstant / std::pow(swing_ratio, 0.25),
                    .cadence_gain_m_s = 0.0,
                    .shortest_m = 0.25,
                    .longest_m = 1.2};
  return options;
}

double mean_heading(std::span<const observation::MotionDelta> deltas) {
  std::vector<double> headings_rad;
  for (const auto& delta : deltas) headings_rad.push_back(delta.heading_rad);
  return core::circular_mean(headings_rad)->mean_rad;
}

class DeadReckoningOnSimulatedWalks : public testing::TestWithParam<Case> {};

TEST_P(DeadReckoningOnSimulatedWalks, CountsMeasuresAndTurnsLikeTheWalker) {
  const sim::SimulatedRecording recording = walk_the_corridor(GetParam());
  pdr::DeadReckoning reckoning(options_for(recording));
  std::vector<observation::MotionDelta> deltas;
  for (const sample::Sample& sample : recording.samples) {
    if (const auto delta = reckoning.add(sample)) deltas.push_back(*delta);
  }
  const auto true_count = static_cast<double>(recording.steps.size());
  ASSERT_GT(true_count, 50.0);
  EXPECT_NEAR(static_cast<double>(deltas.size()), true_count, 0.05 * true_count);

  double true_length_m = 0.0;
  for (const auto& step : recording.steps) true_length_m += step.length_m;
  double length_m = 0.0;
  for (const auto& delta : deltas) length_m += delta.length_m;
  EXPECT_NEAR(length_m, true_length_m, 0.1 * true_length_m);

  constexpr std::size_t kSteps = 15;
  ASSERT_GT(deltas.size(), 2 * kSteps);
  const double turn_rad = core::wrap_angle(mean_heading(std::span(deltas).last(kSteps)) -
                                           mean_heading(std::span(deltas).first(kSteps)));
  EXPECT_NEAR(core::degrees_from_radians(turn_rad), 90.0, 10.0);
}

INSTANTIATE_TEST_SUITE_P(Walkers, DeadReckoningOnSimulatedWalks,
                         testing::Values(Case{11, 1.0}, Case{12, 1.25}, Case{13, 1.5}));

}  // namespace
}  // namespace waylode
