// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <tuple>
#include <utility>

#include "waylode/core/file.hpp"
#include "waylode/sim/ascii_building.hpp"
#include "waylode/sim/detail/option_fields.hpp"
#include "waylode/sim/detail/toml_table.hpp"
#include "waylode/sim/scenario.hpp"

namespace waylode::sim {

namespace {

using detail::Complaint;
using detail::TomlTable;

/// What [building] says; exactly one of the three sources is given.
struct BuildingSource {
  std::string name = "building";
  double cell_m = 1.0;
  double access_point_spacing_m = 0.0;
  std::string drawing;
  std::string drawing_file;
  std::vector<std::string> plans;
  unsigned line = 1;
  unsigned drawing_line = 1;
};

BuildingSource read_building_table(TomlTable& root, Complaint& complaint) {
  BuildingSource source;
  root.require("building");
  const toml::table* table = root.table("building");
  if (table == nullptr) return source;
  TomlTable fields(*table, "[building]", complaint);
  fields("name", source.name);
  fields("cell_m", source.cell_m, 0.2, 10.0);
  fields("access_point_spacing_m", source.access_point_spacing_m, 2.0, 200.0);
  fields("drawing", source.drawing);
  fields("drawing_file", source.drawing_file);
  fields("plans", source.plans);
  source.line = fields.line();
  // The text of a multi-line string starts on the line after its quotes.
  source.drawing_line = fields.line_of("drawing") + 1;
  const int given =
      int(!source.drawing.empty()) + int(!source.drawing_file.empty()) + int(!source.plans.empty());
  if (given != 1) {
    complaint.say(source.line, "[building] needs one of 'drawing', 'drawing_file' and 'plans'");
  }
  fields.finish();
  return source;
}

core::Result<Building> read_plans(const BuildingSource& source,
                                  const std::filesystem::path& folder) {
  std::vector<site::FloorDraft> floors;
  for (const std::string& file : source.plans) {
    const std::filesystem::path path = folder / file;
    auto text = core::read_file(path);
    if (!text) return tl::unexpected(std::move(text.error()));
    auto draft = site::parse_plan(*text, path.string());
    if (!draft) return tl::unexpected(std::move(draft.error()));
    floors.push_back(std::move(*draft));
  }
  return building_from_plans(source.name, std::move(floors));
}

core::Result<Building> make_building(const BuildingSource& source, const std::string& place,
                                     const std::filesystem::path& folder) {
  if (!source.plans.empty()) return read_plans(source, folder);
  AsciiBuildingOptions options{source.cell_m, static_cast<int>(source.drawing_line)};
  if (!source.drawing.empty()) return parse_ascii_building(source.drawing, place, options);
  const std::filesystem::path path = folder / source.drawing_file;
  auto text = core::read_file(path);
  if (!text) return tl::unexpected(std::move(text.error()));
  options.first_line = 1;
  return parse_ascii_building(*text, path.string(), options);
}

/// Reads "floor", "x_m", "y_m" of a thing that stands somewhere; nullopt after a complaint.
std::optional<std::pair<core::FloorId, core::Vector2>> read_place(TomlTable& fields,
                                                                  std::string_view floor_key,
                                                                  const Building& building,
                                                                  Complaint& complaint) {
  std::string floor_name;
  double x_m = 0.0;
  double y_m = 0.0;
  constexpr double kFar_m = 1e5;
  for (const std::string_view key : {floor_key, std::string_view("x_m"), std::string_view("y_m")}) {
    fields.require(key);
  }
  fields(floor_key, floor_name);
  fields("x_m", x_m, -kFar_m, kFar_m);
  fields("y_m", y_m, -kFar_m, kFar_m);
  const auto floor = building.find_floor(floor_name);
  if (!floor) {
    complaint.say(fields.line_of(floor_key),
                  detail::concat({"the building has no floor '", floor_name, "'"}));
    return std::nullopt;
  }
  return std::pair(*floor, core::Vector2(x_m, y_m));
}

void read_points(TomlTable& root, Building& building, Complaint& complaint) {
  for (const toml::table* table : root.tables("point")) {
    TomlTable fields(*table, "[[point]]", complaint);
    NamedPoint point;
    fields.require("name");
    fields("name", point.name);
    if (const auto place = read_place(fields, "floor", building, complaint)) {
      std::tie(point.floor, point.position_m) = *place;
      for (const NamedPoint& other : building.points) {
        if (other.floor == point.floor && other.name == point.name) {
          complaint.say(fields.line(), detail::concat({"the floor has a place '", point.name,
                                                       "' already; rename it"}));
        }
      }
      building.points.push_back(point);
    }
    fields.finish();
  }
}

void read_transmitters(TomlTable& root, Building& building, Complaint& complaint) {
  for (const toml::table* table : root.tables("transmitter")) {
    TomlTable fields(*table, "[[transmitter]]", complaint);
    Transmitter transmitter;
    std::string kind = "wifi";
    fields.require("name");
    fields("name", transmitter.name);
    fields("kind", kind);
    if (kind == "bluetooth") {
      transmitter.kind = Transmitter::Kind::kBluetooth;
    } else if (kind != "wifi") {
      complaint.say(fields.line_of("kind"), "'kind' must be \"wifi\" or \"bluetooth\"");
    }
    if (const auto place = read_place(fields, "floor", building, complaint)) {
      std::tie(transmitter.floor, transmitter.position_m) = *place;
      building.transmitters.push_back(transmitter);
    }
    fields.finish();
  }
}

void read_stairs(TomlTable& root, Building& building, Complaint& complaint) {
  for (const toml::table* table : root.tables("stairs")) {
    TomlTable fields(*table, "[[stairs]]", complaint);
    Stairwell stairs;
    fields("radius_m", stairs.radius_m, 0.1, 10.0);
    if (const auto place = read_place(fields, "lower_floor", building, complaint)) {
      std::tie(stairs.lower, stairs.centre_m) = *place;
      if (stairs.lower.index + std::size_t{1} >= building.floors.size()) {
        complaint.say(fields.line(), "there is no floor above 'lower_floor' to lead to");
      }
      building.stairwells.push_back(stairs);
    }
    fields.finish();
  }
}

template <typename Visit>
void read_options(TomlTable& parent, std::string_view key, Complaint& complaint, Visit&& visit) {
  const toml::table* table = parent.table(key);
  if (table == nullptr) return;
  TomlTable fields(*table, detail::concat({"[", key, "]"}), complaint);
  visit(fields);
  fields.finish();
}

void read_habits(TomlTable& parent, GaitOptions& gait, PhoneOptions& phone, Complaint& complaint) {
  read_options(parent, "gait", complaint, [&](TomlTable& f) { detail::visit_gait(gait, f); });
  read_options(parent, "phone", complaint, [&](TomlTable& f) { detail::visit_phone(phone, f); });
}

void read_walkers(TomlTable& root, Scenario& scenario, Complaint& complaint) {
  Walker common;
  read_habits(root, common.gait, common.phone, complaint);
  root.require("walker");
  for (const toml::table* table : root.tables("walker")) {
    TomlTable fields(*table, "[[walker]]", complaint);
    Walker walker = common;
    fields.require("name");
    fields.require("route");
    fields("name", walker.name);
    fields("survey", walker.is_survey);
    fields("route", walker.route);
    fields("start_s", walker.start_s, 0.0, 1e7);
    fields("tap_waypoints", walker.tap_waypoints);
    fields("truth_interval_s", walker.truth_interval_s, 0.0, 3600.0);
    read_habits(fields, walker.gait, walker.phone, complaint);
    fields.finish();
    for (const std::string& place : walker.route) {
      const auto point = scenario.building.find_point(place);
      if (!point) complaint.say(fields.line_of("route"), point.error().message);
    }
    scenario.walkers.push_back(std::move(walker));
  }
}

}  // namespace

core::Result<Scenario> parse_scenario(std::string_view toml_text, std::string_view place,
                                      const std::filesystem::path& folder) {
  Complaint complaint(place);
  const toml::parse_result parsed = toml::parse(toml_text, place);
  if (!parsed) {
    complaint.say(parsed.error().source(), std::string(parsed.error().description()));
    return tl::unexpected(complaint.take());
  }
  Scenario scenario;
  TomlTable root(parsed.table(), "the scenario", complaint);
  double seed = 1.0;
  constexpr double kLargestSeed = 9007199254740992.0;
  root("name", scenario.name);
  root("seed", seed, 0.0, kLargestSeed);
  scenario.seed = static_cast<std::uint64_t>(seed);
  const BuildingSource source = read_building_table(root, complaint);
  if (!complaint.is_empty()) return tl::unexpected(complaint.take());
  auto building = make_building(source, complaint.place(), folder);
  if (!building) return tl::unexpected(std::move(building.error()));
  scenario.building = std::move(*building);
  scenario.building.name = source.name;
  if (source.access_point_spacing_m > 0.0) {
    add_seeded_access_points(scenario.building, source.access_point_spacing_m, scenario.seed);
  }
  read_points(root, scenario.building, complaint);
  read_transmitters(root, scenario.building, complaint);
  read_stairs(root, scenario.building, complaint);
  read_options(root, "radio", complaint,
               [&](TomlTable& f) { detail::visit_radio(scenario.radio, f); });
  read_options(root, "magnetic", complaint,
               [&](TomlTable& f) { detail::visit_magnetic(scenario.magnetic, f); });
  read_options(root, "air", complaint, [&](TomlTable& f) { detail::visit_air(scenario.air, f); });
  read_walkers(root, scenario, complaint);
  root.finish();
  if (!complaint.is_empty()) return tl::unexpected(complaint.take());
  if (auto valid = validate(scenario); !valid) {
    valid.error().message += detail::concat({" (", valid.error().place, ")"});
    valid.error().place = std::string(place);
    return tl::unexpected(std::move(valid.error()));
  }
  return scenario;
}

core::Result<Scenario> load_scenario(const std::filesystem::path& path) {
  auto text = core::read_file(path);
  if (!text) return tl::unexpected(std::move(text.error()));
  return parse_scenario(*text, path.string(), path.parent_path());
}

}  // namespace waylode::sim
