// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "waylode/core/rng.hpp"
#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval::testing {
namespace {

constexpr double kStride_s = 4.0;

struct DemoMethod {
  const char* name;
  double sigma_m;
  double stated_sigma_m;
  double wrong_floor_ratio;
  double absent_ratio;
};
constexpr DemoMethod kMethods[] = {{"wknn", 4.0, 3.0, 0.06, 0.0},
                                   {"fused", 2.6, 2.8, 0.02, 0.03},
                                   {"smoothed", 1.7, 1.2, 0.0, 0.0}};

site::Ring rectangle(double x_m, double y_m, double width_m, double height_m) {
  return {{x_m, y_m}, {x_m + width_m, y_m}, {x_m + width_m, y_m + height_m}, {x_m, y_m + height_m}};
}

/// A block of 70 m x 40 m with a ring corridor around shops and a courtyard.
site::Plan demo_plan() {
  site::Plan plan;
  plan.walkable.push_back({rectangle(0, 0, 70, 40), {rectangle(28, 15, 14, 10)}});
  for (const double y_m : {5.0, 27.0}) {
    for (int i = 0; i < 6; ++i) {
      const double x_m = 5.0 + 10.0 * i;
      plan.obstacles.push_back({rectangle(x_m, y_m, 8, 8), {}});
      plan.rooms.push_back({"shop", {rectangle(x_m, y_m, 8, 8), {}}});
    }
  }
  plan.walls = {
      {{28, 15}, {42, 15}}, {{42, 15}, {42, 25}}, {{42, 25}, {28, 25}}, {{28, 25}, {28, 15}}};
  return plan;
}

std::shared_ptr<const site::Site> demo_site() {
  site::SiteParts parts;
  parts.name = "block";
  parts.floors.resize(2);
  for (int level = 0; level < 2; ++level) {
    site::Floor& floor = parts.floors[static_cast<std::size_t>(level)];
    floor.name = level == 0 ? "F1" : "F2";
    floor.level = level;
    floor.bounds.max_m = {70.0, 40.0};
    floor.plan = demo_plan();
  }
  return std::make_shared<const site::Site>(std::move(parts));
}

/// Counter-clockwise around one row of shops, outside and through the middle.
core::Vector2 corridor_position_m(double distance_m) {
  const double around_m = std::fmod(distance_m, 150.0);
  if (around_m < 64.0) return {3.0 + around_m, 3.0};
  if (around_m < 75.0) return {67.0, 3.0 + (around_m - 64.0)};
  if (around_m < 139.0) return {67.0 - (around_m - 75.0), 14.0};
  return {3.0, 14.0 - (around_m - 139.0)};
}

std::vector<TruthPoint> demo_walk(core::Rng& rng, bool changes_floor) {
  const auto floor = static_cast<std::uint16_t>(rng.below(2));
  const double start_m = rng.uniform(0.0, 150.0);
  std::vector<TruthPoint> truths;
  for (int i = 0; i < 10; ++i) {
    const bool upstairs = changes_floor && i >= 6;
    const core::FloorId here{static_cast<std::uint16_t>(upstairs ? 1 - floor : floor)};
    truths.push_back(truth_at(kStride_s * i, here, corridor_position_m(start_m + 5.5 * i)));
  }
  truths[0].scored = rng.uniform() < 0.5;
  return truths;
}

core::Fix demo_fix(const DemoMethod& method, const TruthPoint& truth, double trace_factor,
                   core::Rng& rng) {
  const double settling =
      1.0 + 1.5 * std::exp(-core::to_seconds(truth.time.time_since_epoch()) / 8.0);
  const double sigma_m = method.sigma_m * settling * trace_factor;
  const core::Vector2 error_m(rng.normal(0.0, 0.8 * sigma_m), rng.normal(0.0, 0.5 * sigma_m));
  core::Fix fix = fix_at(0.0, truth.floor, truth.position_m + error_m);
  fix.time = truth.time;
  fix.belief->covariance_m2 << 0.64, 0.1, 0.1, 0.25;
  fix.belief->covariance_m2 *= std::pow(method.stated_sigma_m * settling, 2);
  if (rng.uniform() < method.wrong_floor_ratio) fix.belief->floor.index ^= 1U;
  if (rng.uniform() < 0.1) fix.state = core::FixState::kLowConfidence;
  if (rng.uniform() < method.absent_ratio) fix = core::Fix{truth.time, {}, {}, {}};
  return fix;
}

}  // namespace

std::vector<EvaluatedTrack> demo_tracks(std::size_t recording_count) {
  core::Rng rng(20'240'311);
  const std::shared_ptr<const site::Site> site = demo_site();
  std::vector<EvaluatedTrack> tracks;
  for (std::size_t i = 0; i < recording_count; ++i) {
    const std::vector<TruthPoint> truths = demo_walk(rng, i % 9 == 4);
    const double trace_factor = rng.uniform(0.5, 1.8);
    for (const DemoMethod& method : kMethods) {
      EvaluatedTrack track;
      track.name = "walk " + std::to_string(i + 1);
      track.group = "block/" + site->floor(truths.front().floor).name;
      track.method = method.name;
      track.covered = i % 3 == 0;
      track.site = site;
      track.truths = truths;
      for (const TruthPoint& truth : truths) {
        track.fixes.push_back(demo_fix(method, truth, trace_factor, rng));
      }
      track.walked_s = core::to_seconds(truths.back().time - truths.front().time);
      track.cpu_s = track.walked_s * 2e-4 * method.sigma_m;
      tracks.push_back(std::move(track));
    }
  }
  return tracks;
}

}  // namespace waylode::eval::testing
