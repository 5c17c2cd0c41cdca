// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/pipeline/session.hpp"
#include "waylode/sim/simulate.hpp"

namespace waylode::test {

/// Who walks where; names of places as in the drawing.
struct Route {
  std::string name;
  bool is_survey = false;
  std::vector<std::string> places;
};

/// A drawn building, surveyed and made ready for positioning, and the people to be found in it.
struct World {
  std::shared_ptr<const pipeline::Model> model;
  std::vector<sim::SimulatedRecording> walks;  ///< Those that are not surveys.
};

/// Simulates all routes, builds the radio map from the surveys. Fails the test on any error.
World make_world(std::string_view drawing, const std::vector<Route>& routes);

/// A fix and where the person was then.
struct TruthAndFix {
  sim::TruthState truth;
  core::Fix fix;
};

/// The walk run through a method, asked once a second from its first usable scan on.
std::vector<TruthAndFix> run_method(const World& world, const sim::SimulatedRecording& walk,
                                    std::string_view method);

/// Half of the fixes are nearer to the truth than this, floors left aside. Every fix has a belief.
double median_error_m(std::span<const TruthAndFix> fixes);
double floor_hit_ratio(std::span<const TruthAndFix> fixes);

}  // namespace waylode::test
