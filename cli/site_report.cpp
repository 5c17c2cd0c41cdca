// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "site_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "waylode/site/connectors.hpp"

namespace waylode::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// What the radio map knows of each floor.
struct FloorMap {
  std::uint64_t fingerprints = 0;
  std::uint64_t transmitters = 0;
};

/// One line per way off a floor: kind, name, place, levels.
std::string connectors_to_text(const site::Site& site) {
  std::string text;
  for (const site::Floor& floor : site.floors()) {
    for (const site::Connector& connector : floor.plan.connectors) {
      text += fmt::format(
          "{:<16}{:<12}{:<16}{:>8.1f}{:>8.1f}   {}\n", floor.name, site::name_of(connector.kind),
          connector.name, connector.position_m.x(), connector.position_m.y(),
          connector.levels.empty() ? "-" : fmt::format("{}", fmt::join(connector.levels, ", ")));
    }
  }
  if (text.empty()) return text;
  return fmt::format("\n{:<16}{:<12}{:<16}{:>8}{:>8}   {}\n", "floor", "connector", "name", "x m",
                     "y m", "to levels") +
         text;
}

Json connectors_to_json(const site::Plan& plan) {
  Json list = Json::array();
  for (const site::Connector& connector : plan.connectors) {
    list.push_back({{"kind", site::name_of(connector.kind)},
                    {"name", connector.name},
                    {"x_m", connector.position_m.x()},
                    {"y_m", connector.position_m.y()},
                    {"levels", connector.levels}});
  }
  return list;
}

std::vector<FloorMap> floor_maps(const site::Site& site) {
  const site::RadioMap& map = site.radio_map();
  std::vector<FloorMap> floors(site.floors().size());
  for (const site::FingerprintRecord& record : map.fingerprints) {
    ++floors[record.floor].fingerprints;
  }
  for (std::size_t i = 0; i < map.transmitters.size(); ++i) {
    std::vector<bool> heard(floors.size());
    for (std::uint32_t p = map.posting_begin[i]; p < map.posting_begin[i + 1]; ++p) {
      heard[map.fingerprints[map.postings[p].fingerprint].floor] = true;
    }
    for (std::size_t floor = 0; floor < floors.size(); ++floor) {
      if (heard[floor]) ++floors[floor].transmitters;
    }
  }
  return floors;
}

}  // namespace

std::string version_text(std::uint64_t version) { return fmt::format("{:016x}", version); }

std::string quality_to_text(const survey::QualityReport& report) {
  std::string text = fmt::format("{:<16}{:>8}{:>14}{:>14}{:>10}{:>12}{:>10}\n", "floor", "walks",
                                 "fingerprints", "transmitters", "median", "surveyed m", "covered");
  for (const survey::FloorQuality& floor : report.floors) {
    text += fmt::format("{:<16}{:>8}{:>14}{:>14}{:>10.1f}{:>12.0f}{:>8.0f} %\n", floor.floor,
                        floor.recordings, floor.fingerprints, floor.transmitters,
                        floor.median_transmitters_per_fingerprint, floor.surveyed_m,
                        100.0 * floor.covered_ratio);
  }
  text += fmt::format(
      "stretches between marks {}: {} in a straight line (steps did not fit), {} rejected\n",
      report.stretches, report.stretches_straight, report.stretches_rejected);
  text += fmt::format(
      "left out: {} scans without a place, {} readings told before, {} readings that ask not to be "
      "mapped, {} moving transmitters\n",
      report.scans_unlabelled, report.readings_duplicate, report.readings_unmappable,
      report.transmitters_moving);
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  return text;
}

std::string quality_to_json(const std::string& site, const std::string& version,
                            const survey::QualityReport& report) {
  Json floors = Json::array();
  for (const survey::FloorQuality& floor : report.floors) {
    floors.push_back(
        {{"floor", floor.floor},
         {"recordings", floor.recordings},
         {"fingerprints", floor.fingerprints},
         {"transmitters", floor.transmitters},
         {"median_transmitters_per_fingerprint", floor.median_transmitters_per_fingerprint},
         {"surveyed_m", floor.surveyed_m},
         {"covered_ratio", floor.covered_ratio},
         {"heading_offset_rad", floor.heading_offset_rad},
         {"step_scale", floor.step_scale}});
  }
  return dump({{"site", site},
               {"version", version},
               {"floors", floors},
               {"stretches", report.stretches},
               {"stretches_straight", report.stretches_straight},
               {"stretches_rejected", report.stretches_rejected},
               {"scans_unlabelled", report.scans_unlabelled},
               {"readings_duplicate", report.readings_duplicate},
               {"readings_unmappable", report.readings_unmappable},
               {"transmitters_moving", report.transmitters_moving},
               {"notes", report.notes}});
}

std::string site_to_text(const site::Site& site) {
  std::string text =
      fmt::format("site     {}\nversion  {}\n", site.name(), version_text(site.version()));
  const auto& origin = site.origin();
  text +=
      origin ? fmt::format("origin   {:.6f}, {:.6f}\n", origin->latitude_deg, origin->longitude_deg)
             : "origin   - (not georeferenced)\n";
  text += fmt::format("\n{:<16}{:>6}{:>12}{:>8}{:>8}{:>8}{:>14}{:>14}\n", "floor", "level",
                      "size m", "walls", "doors", "rooms", "fingerprints", "transmitters");
  const std::vector<FloorMap> maps = floor_maps(site);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const site::Floor& floor = site.floors()[i];
    const core::Vector2 size_m = floor.bounds.size_m();
    text += fmt::format("{:<16}{:>6}{:>12}{:>8}{:>8}{:>8}{:>14}{:>14}\n", floor.name, floor.level,
                        fmt::format("{:.0f} x {:.0f}", size_m.x(), size_m.y()),
                        floor.plan.walls.size(), floor.plan.doors.size(), floor.plan.rooms.size(),
                        maps[i].fingerprints, maps[i].transmitters);
  }
  text += connectors_to_text(site);
  if (site.radio_map().empty()) text += "\nno radio map: build the site from surveyed logs\n";
  return text;
}

std::string site_to_json(const site::Site& site) {
  Json floors = Json::array();
  const std::vector<FloorMap> maps = floor_maps(site);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const site::Floor& floor = site.floors()[i];
    floors.push_back({{"floor", floor.name},
                      {"level", floor.level},
                      {"elevation_m", floor.elevation_m},
                      {"width_m", floor.bounds.size_m().x()},
                      {"height_m", floor.bounds.size_m().y()},
                      {"walls", floor.plan.walls.size()},
                      {"rooms", floor.plan.rooms.size()},
                      {"doors", floor.plan.doors.size()},
                      {"connectors", connectors_to_json(floor.plan)},
                      {"heading_offset_rad", floor.heading_offset_rad},
                      {"fingerprints", maps[i].fingerprints},
                      {"transmitters", maps[i].transmitters}});
  }
  Json origin = nullptr;
  if (site.origin()) {
    origin = {{"latitude_deg", site.origin()->latitude_deg},
              {"longitude_deg", site.origin()->longitude_deg}};
  }
  return dump({{"site", site.name()},
               {"version", version_text(site.version())},
               {"origin", origin},
               {"floors", floors},
               {"fingerprints", site.radio_map().fingerprints.size()},
               {"transmitters", site.radio_map().transmitters.size()}});
}

}  // namespace waylode::cli
