// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "scenario_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "waylode/sim/ascii_building.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::test {
namespace {

/// The value, or the end of the test.
template <typename T>
T or_throw(core::Result<T> result) {
  if (!result) throw std::runtime_error(core::to_string(result.error()));
  return *std::move(result);
}

sim::Scenario scenario_of(std::string_view drawing, const std::vector<Route>& routes) {
  sim::Scenario scenario;
  scenario.name = "drawn";
  scenario.seed = 23;
  scenario.building = or_throw(sim::parse_ascii_building(drawing, "drawing"));
  double start_s = 0.0;
  for (const Route& route : routes) {
    sim::Walker walker;
    walker.name = route.name;
    walker.is_survey = route.is_survey;
    walker.route = route.places;
    walker.gait.speed_mps = 1.2;
    walker.start_s = start_s;
    start_s += 200.0;
    scenario.walkers.push_back(walker);
  }
  return scenario;
}

double first_scan_s(const sim::SimulatedRecording& walk) {
  for (const sample::Sample& sample : walk.samples) {
    if (const auto* scan = std::get_if<sample::WifiScan>(&sample)) {
      if (scan->readings.size() >= 3) return core::to_seconds(scan->time.time_since_epoch());
    }
  }
  throw std::runtime_error("a walk without Wi-Fi");
}

}  // namespace

World make_world(std::string_view drawing, const std::vector<Route>& routes) {
  sim::Simulation simulation = or_throw(sim::simulate(scenario_of(drawing, routes)));
  site::SiteParts parts;
  parts.name = "drawn";
  for (const site::FloorDraft& draft : simulation.building.floors) {
    parts.floors.push_back(draft.floor);
  }
  const pipeline::Options options;
  survey::MapBuilder builder(std::move(parts), options.survey_options());
  World world;
  for (sim::SimulatedRecording& recording : simulation.recordings) {
    if (recording.is_survey) {
      builder.add(survey::SurveyedRecording{recording.walker, recording.samples, std::nullopt});
    } else {
      world.walks.push_back(std::move(recording));
    }
  }
  auto site = std::make_shared<const site::Site>(or_throw(builder.build()).parts);
  world.model = or_throw(pipeline::Model::create(std::move(site), options));
  return world;
}

std::vector<TruthAndFix> run_method(const World& world, const sim::SimulatedRecording& walk,
                                    std::string_view method_name) {
  const pipeline::Method method = or_throw(pipeline::find_method(method_name));
  const double from_s = first_scan_s(walk);
  std::vector<TruthAndFix> result;
  std::vector<core::DeviceTime> instants;
  for (std::size_t i = 0; i < walk.truth.size(); i += 10) {
    if (core::to_seconds(walk.truth[i].time.time_since_epoch()) < from_s) continue;
    result.push_back({walk.truth[i], {}});
    instants.push_back(walk.truth[i].time);
  }
  pipeline::SessionOptions options;
  options.start = pipeline::StartPose{walk.truth.front().time, walk.truth.front().floor,
                                      walk.truth.front().position_m, 1.0};
  auto session = or_throw(pipeline::Session::create(world.model, method, options));
  const auto fixes = pipeline::replay(session, method, walk.samples, instants);
  for (std::size_t i = 0; i < fixes.size(); ++i) result[i].fix = fixes[i];
  return result;
}

double median_error_m(std::span<const TruthAndFix> fixes) {
  std::vector<double> errors_m;
  for (const TruthAndFix& one : fixes) {
    EXPECT_TRUE(one.fix.belief);
    if (!one.fix.belief) continue;
    errors_m.push_back((one.fix.belief->position_m - one.truth.position_m).norm());
  }
  if (errors_m.empty()) throw std::runtime_error("no fix");
  const auto middle = errors_m.begin() + static_cast<std::ptrdiff_t>(errors_m.size() / 2);
  std::ranges::nth_element(errors_m, middle);
  return *middle;
}

double floor_hit_ratio(std::span<const TruthAndFix> fixes) {
  const auto hits = std::ranges::count_if(fixes, [](const TruthAndFix& one) {
    return one.fix.belief && one.fix.belief->floor == one.truth.floor;
  });
  return static_cast<double>(hits) / static_cast<double>(fixes.size());
}

}  // namespace waylode::test
