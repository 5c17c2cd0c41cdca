// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/sim/building.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim {

/// One person, one phone, one recording.
struct Walker {
  std::string name;  ///< Unique; everything random about the walker is drawn from it.
  bool is_survey = false;
  std::vector<std::string> route;  ///< Names of places, see Building::find_point. At least two.
  GaitOptions gait;
  PhoneOptions phone;
  /// Whole seconds into the scenario when the recording starts. Weather and drift depend on it.
  double start_s = 0.0;
  bool tap_waypoints = true;  ///< A WaypointSample where the route passes a named place.
  /// Also a WaypointSample every so often; 0 for none.
  double truth_interval_s = 0.0;
};

/// A building, its physics and who walks there. Equal scenarios give equal samples.
struct Scenario {
  std::string name;
  std::uint64_t seed = 1;
  Building building;
  RadioOptions radio;
  MagneticOptions magnetic;
  AirOptions air;
  std::vector<Walker> walkers;
};

/// Ranges of every option, names unique, routes known. kScenarioInvalid.
core::Result<void> validate(const Scenario& scenario);

/// The scenario file's text (docs/simulator.md). Plans and drawings it names are looked up in
/// `folder`. Unknown keys are errors. kScenarioInvalid with "place:line".
core::Result<Scenario> parse_scenario(std::string_view toml, std::string_view place,
                                      const std::filesystem::path& folder);
core::Result<Scenario> load_scenario(const std::filesystem::path& path);

}  // namespace waylode::sim
