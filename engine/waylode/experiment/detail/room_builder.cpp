// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/detail/room_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "waylode/core/rng.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/radio_map.hpp"

namespace waylode::experiment::detail {

namespace {

using core::Vector2;

constexpr core::FloorId kFloor{0};

/// One instance of the map: the mean over scans of what at least half of them heard.
std::vector<site::MapReading> mean_readings(std::span<const sample::FingerprintRow> scans) {
  struct Sum {
    double rssi_dbm = 0.0;
    std::size_t count = 0;
  };
  std::map<core::TransmitterId, Sum> sums;
  for (const sample::FingerprintRow& scan : scans) {
    for (const sample::WifiReading& reading : scan.readings) {
      Sum& sum = sums[reading.transmitter];
      sum.rssi_dbm += static_cast<double>(reading.rssi_dbm);
      ++sum.count;
    }
  }
  std::vector<site::MapReading> readings;
  for (const auto& [transmitter, sum] : sums) {
    if (2 * sum.count < scans.size()) continue;
    const double mean_dbm = sum.rssi_dbm / static_cast<double>(sum.count);
    readings.push_back({transmitter, static_cast<float>(mean_dbm), 0.0F});
  }
  return readings;
}

void survey_grid(const RoomPlan& plan, const sim::World& world, PaperRoom& room,
                 site::RadioMapBuilder& builder) {
  std::uint32_t recording = 0;
  for (const Vector2& point_m : plan.grid_m) {
    const std::size_t count = plan.instances_per_point * plan.scans_per_instance;
    std::vector<sample::FingerprintRow> rows =
        world.survey_scans(kFloor, point_m, count, plan.facing);
    for (std::size_t i = 0; i < plan.instances_per_point; ++i) {
      site::FingerprintRecord record;
      record.x_m = static_cast<float>(point_m.x());
      record.y_m = static_cast<float>(point_m.y());
      record.position_sigma_m = 0.05F;
      record.recording = recording++;
      builder.add(record, mean_readings(std::span(rows).subspan(i * plan.scans_per_instance,
                                                                plan.scans_per_instance)));
    }
    std::move(rows.begin(), rows.end(), std::back_inserter(room.survey));
  }
}

std::vector<Vector2> points_along(const std::vector<Vector2>& line_m, double spacing_m) {
  std::vector<Vector2> points;
  double left_m = 0.0;  // To the next point.
  for (std::size_t i = 1; i < line_m.size(); ++i) {
    const Vector2 along = line_m[i] - line_m[i - 1];
    const double length_m = along.norm();
    constexpr double kRounding_m = 1e-9;
    for (; left_m <= length_m + kRounding_m; left_m += spacing_m) {
      points.push_back(line_m[i - 1] + along * (left_m / length_m));
    }
    left_m -= length_m;
  }
  return points;
}

std::vector<MagneticMapPoint> survey_field(const RoomPlan& plan, const sim::World& world,
                                           std::uint64_t seed) {
  core::Rng rng(seed ^ 0x4D61'676E'6574'6963ULL);
  std::vector<MagneticMapPoint> map;
  for (const Vector2& point_m : points_along(plan.magnetic_line_m, plan.magnetic_spacing_m)) {
    const core::Vector3 field_ut = world.field_ut(kFloor, point_m, sim::kHandHeight_m);
    const double horizontal_ut =
        field_ut.head<2>().norm() + rng.normal(0.0, plan.magnetic_noise_ut);
    const double vertical_ut = field_ut.z() + rng.normal(0.0, plan.magnetic_noise_ut);
    map.push_back({point_m, horizontal_ut, vertical_ut});
  }
  return map;
}

/// The base map as a site keeps it, every point as it was measured.
site::MagneticMapStorage magnetic_storage(const std::vector<MagneticMapPoint>& points) {
  site::MagneticMapStorage storage;
  for (const MagneticMapPoint& point : points) {
    site::MagneticPoint stored;
    stored.x_m = static_cast<float>(point.position_m.x());
    stored.y_m = static_cast<float>(point.position_m.y());
    stored.horizontal_ut = static_cast<float>(std::max(0.0, point.horizontal_ut));
    stored.vertical_ut = static_cast<float>(point.vertical_ut);
    stored.floor = kFloor.index;
    stored.count = 1;
    storage.points.push_back(stored);
  }
  return storage;
}

double first_heading_rad(const RoomPlan& plan) {
  const Vector2 along = plan.route_m[1] - plan.route_m[0];
  return std::atan2(along.y(), along.x());
}

}  // namespace

core::Result<sim::Building> make_building(const RoomPlan& plan) {
  core::Bounds2 bounds{plan.outline_m.front(), plan.outline_m.front()};
  for (const Vector2& corner_m : plan.outline_m) {
    bounds.min_m = bounds.min_m.cwiseMin(corner_m);
    bounds.max_m = bounds.max_m.cwiseMax(corner_m);
  }
  site::FloorDraft draft = site::bare_floor("F1", bounds);
  draft.floor.plan.walkable.push_back({plan.outline_m, {}});
  for (std::size_t i = 0; i < plan.outline_m.size(); ++i) {
    draft.floor.plan.walls.push_back(
        {plan.outline_m[i], plan.outline_m[(i + 1) % plan.outline_m.size()]});
  }
  auto building = sim::building_from_plans(plan.name, {std::move(draft)});
  if (!building) return building;
  for (std::size_t i = 0; i < plan.access_points_m.size(); ++i) {
    building->transmitters.push_back({sim::Transmitter::Kind::kWifi, "AP" + std::to_string(i + 1),
                                      kFloor, plan.access_points_m[i]});
  }
  for (std::size_t i = 0; i < plan.route_m.size(); ++i) {
    building->points.push_back({std::to_string(i), kFloor, plan.route_m[i]});
  }
  return building;
}

std::vector<std::string> route_names(const RoomPlan& plan) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plan.route_m.size(); ++i) names.push_back(std::to_string(i));
  return names;
}

core::Result<PaperRoom> build_room(const RoomPlan& plan, const sim::Scenario& scenario) {
  auto world = sim::World::make(scenario);
  if (!world) return tl::unexpected(std::move(world.error()));
  auto simulation = sim::simulate(scenario);
  if (!simulation) return tl::unexpected(std::move(simulation.error()));
  PaperRoom room{scenario,
                 site::Site({}),
                 plan.grid_m,
                 {},
                 plan.instances_per_point,
                 plan.scans_per_instance,
                 survey_field(plan, *world, scenario.seed),
                 plan.magnetic_line_m,
                 std::move(simulation->recordings.front()),
                 {},
                 plan.route_m};
  site::RadioMapBuilder builder;
  survey_grid(plan, *world, room, builder);
  site::SiteParts parts{
      plan.name, std::nullopt, {scenario.building.floors[0].floor}, builder.build()};
  parts.magnetic_map = magnetic_storage(room.magnetic_map);
  room.site = site::Site(std::move(parts));
  room.start_scans = world->standing_scans({kFloor, plan.route_m.front(), first_heading_rad(plan)},
                                           plan.start_scans, plan.start_interval_s, "start");
  return room;
}

}  // namespace waylode::experiment::detail
