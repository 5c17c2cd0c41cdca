// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "waylode/core/angle.hpp"
#include "waylode/sim/detail/magnetic_world.hpp"
#include "waylode/sim/detail/nav_grid.hpp"
#include "waylode/sim/detail/phone.hpp"
#include "waylode/sim/detail/radio_world.hpp"
#include "waylode/sim/detail/random_field.hpp"
#include "waylode/sim/detail/receiver.hpp"
#include "waylode/sim/detail/route.hpp"
#include "waylode/sim/detail/seeds.hpp"
#include "waylode/sim/detail/walk.hpp"

namespace waylode::sim {

namespace {

using detail::derive_seed;

detail::SmoothNoise make_weather(std::uint64_t seed) {
  constexpr double kWeather_s = 600.0;
  core::Rng rng(derive_seed(seed, "weather"));
  return {rng, kWeather_s};
}

/// Everything that all walkers share.
struct World {
  explicit World(const Scenario& scenario)
      : radio(scenario.building, scenario.radio, derive_seed(scenario.seed, "radio")),
        magnetic(scenario.building, scenario.magnetic, derive_seed(scenario.seed, "magnetic")),
        weather(make_weather(scenario.seed)) {
    for (const site::FloorDraft& draft : scenario.building.floors) grids.emplace_back(draft.floor);
  }

  detail::RadioWorld radio;
  detail::MagneticWorld magnetic;
  detail::SmoothNoise weather;
  std::vector<detail::NavGrid> grids;
};

/// A phone has been up for a while when a recording starts.
core::DeviceTime draw_epoch(core::Rng rng) {
  constexpr std::uint64_t kLongestUp_ms = 500'000'000;
  return core::device_time_from_ms(1'000 + static_cast<std::int64_t>(rng.below(kLongestUp_ms)));
}

void add_truth(const detail::Walk& walk, core::DeviceTime epoch, SimulatedRecording& recording) {
  constexpr double kTruthInterval_s = 0.1;
  const auto count = static_cast<int>(std::floor(walk.duration_s() / kTruthInterval_s));
  for (int i = 0; i <= count; ++i) {
    const detail::BodyState body = walk.at(i * kTruthInterval_s);
    recording.truth.push_back({epoch + core::from_seconds(i * kTruthInterval_s), body.floor,
                               body.position_m, core::wrap_angle(body.heading_rad),
                               body.speed_mps});
  }
  for (const detail::Walk::Step& step : walk.steps()) {
    recording.steps.push_back(
        {epoch + core::from_seconds(step.end_s), step.length_m, step.is_effective});
  }
}

void add_waypoints(const detail::Walk& walk, const Walker& walker, const Building& building,
                   core::DeviceTime epoch, SimulatedRecording& recording) {
  std::vector<double> times_s;
  if (walker.tap_waypoints) times_s = walk.tap_times_s();
  if (walker.truth_interval_s > 0.0) {
    for (double t_s = 0.0; t_s <= walk.duration_s(); t_s += walker.truth_interval_s) {
      times_s.push_back(t_s);
    }
  }
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  for (const double t_s : times_s) {
    const detail::BodyState body = walk.at(t_s);
    recording.samples.push_back(sample::WaypointSample{epoch + core::from_seconds(t_s),
                                                       body.position_m, std::nullopt,
                                                       building.floor(body.floor).name});
  }
}

core::Result<SimulatedRecording> simulate_walker(const Scenario& scenario, const World& world,
                                                 const Walker& walker) {
  const std::uint64_t seed = derive_seed(scenario.seed, "walker/" + walker.name);
  const auto rng_for = [seed](const char* part) { return core::Rng(derive_seed(seed, part)); };
  core::Rng route_rng = rng_for("route");
  auto strokes =
      detail::plan_route(scenario.building, world.grids, walker.route, walker.gait, route_rng);
  if (!strokes) {
    strokes.error().place = "walker '" + walker.name + "'";
    return tl::unexpected(std::move(strokes.error()));
  }
  core::Rng person_rng = rng_for("person");
  core::Rng gait_rng = rng_for("gait");
  const detail::Person person = detail::draw_person(walker.gait, person_rng);
  const detail::Walk walk(scenario.building, std::move(*strokes), person, walker.gait, gait_rng);

  SimulatedRecording recording;
  recording.walker = walker.name;
  recording.is_survey = walker.is_survey;
  recording.info.device_brand = "waylode";
  recording.info.device_model = walker.phone.model;
  recording.info.site = scenario.building.name;
  const core::DeviceTime epoch = draw_epoch(rng_for("uptime"));
  core::Rng motion_rng = rng_for("motion");
  detail::sense_motion(walk, world.magnetic, scenario.magnetic, walker.phone, epoch, motion_rng,
                       recording.samples);
  core::Rng air_rng = rng_for("air");
  detail::sense_air(walk, scenario.air, world.weather, walker.start_s, walker.phone, epoch, air_rng,
                    recording.samples);
  const auto drift_seed =
      walker.is_survey ? std::nullopt : std::optional(derive_seed(scenario.seed, "drift"));
  detail::Receiver wifi(world.radio, scenario.radio, walker.phone, drift_seed, rng_for("wifi"));
  wifi.sense_wifi(walk, epoch, recording.samples);
  detail::Receiver ble(world.radio, scenario.radio, walker.phone, drift_seed, rng_for("ble"));
  ble.sense_bluetooth(walk, epoch, recording.samples);
  add_waypoints(walk, walker, scenario.building, epoch, recording);
  add_truth(walk, epoch, recording);
  std::stable_sort(recording.samples.begin(), recording.samples.end(),
                   [](const sample::Sample& a, const sample::Sample& b) {
                     return sample::time_of(a) < sample::time_of(b);
                   });
  return recording;
}

}  // namespace

core::Result<Simulation> simulate(const Scenario& scenario, const core::ProgressSink& progress) {
  if (auto valid = validate(scenario); !valid) return tl::unexpected(std::move(valid.error()));
  const World world(scenario);
  Simulation simulation;
  simulation.building = scenario.building;
  for (const Walker& walker : scenario.walkers) {
    auto recording = simulate_walker(scenario, world, walker);
    if (!recording) return tl::unexpected(std::move(recording.error()));
    simulation.recordings.push_back(std::move(*recording));
    if (progress) progress(simulation.recordings.size(), scenario.walkers.size());
  }
  return simulation;
}

}  // namespace waylode::sim
