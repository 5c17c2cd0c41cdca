// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/uji_dataset.hpp"

#include <algorithm>
#include <map>

#include "waylode/log/fingerprint_table.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::cli {
namespace {

std::string floor_name(const sample::FingerprintRow& row) { return row.building + "/" + row.floor; }

site::SiteParts parts_of(const std::vector<sample::FingerprintRow>& rows) {
  std::map<std::string, site::Floor> floors;
  for (const sample::FingerprintRow& row : rows) {
    const auto [entry, added] = floors.try_emplace(floor_name(row));
    site::Floor& floor = entry->second;
    if (added) {
      floor.name = entry->first;
      floor.level = site::level_of_floor_name(row.floor);
      floor.bounds = {row.position_m, row.position_m};
    }
    floor.bounds.min_m = floor.bounds.min_m.cwiseMin(row.position_m);
    floor.bounds.max_m = floor.bounds.max_m.cwiseMax(row.position_m);
  }
  site::SiteParts parts;
  parts.name = "uji";
  for (auto& [name, floor] : floors) parts.floors.push_back(std::move(floor));
  return parts;
}

/// A row as a recording: one scan, one truth, at time zero.
TestRecording recording_of(const sample::FingerprintRow& row, core::FloorId floor) {
  sample::WifiScan scan{core::DeviceTime{}, row.readings};
  for (sample::WifiReading& reading : scan.readings) reading.last_seen = scan.time;
  return {{std::move(scan)}, {{core::DeviceTime{}, floor, row.position_m, true}}};
}

}  // namespace

core::Result<Dataset> load_uji_dataset(const std::filesystem::path& training,
                                       const std::filesystem::path& validation,
                                       const DatasetContext& context) {
  auto rows = log::read_uji_table(training);
  if (!rows) return tl::unexpected(rows.error());
  auto tests = log::read_uji_table(validation);
  if (!tests) return tl::unexpected(tests.error());

  survey::MapBuilder builder(parts_of(*rows), context.options.survey_options());
  const site::Site frames(parts_of(*rows));
  for (const sample::FingerprintRow& row : *rows) {
    builder.add(row, *frames.find_floor(floor_name(row)));
  }
  auto surveyed = builder.build();
  if (!surveyed) return tl::unexpected(surveyed.error());
  auto model = pipeline::Model::create(std::make_shared<site::Site>(std::move(surveyed->parts)),
                                       context.options);
  if (!model) return tl::unexpected(model.error());

  Dataset dataset{"uji", false, {}, {}};
  for (std::size_t i = 0; i < tests->size(); ++i) {
    sample::FingerprintRow& row = (*tests)[i];
    const auto floor = frames.find_floor(floor_name(row));
    if (!floor) {
      return core::fail(core::ErrorCode::kMapMissing,
                        "row " + std::to_string(i + 1) + " is on floor " + floor_name(row) +
                            ", which the training table lacks; leave the row out",
                        validation.string());
    }
    TestCase test{std::to_string(i + 1), "uji/" + floor_name(row), false, *model, floor, true, {}};
    test.load = [row = std::move(row), floor]() -> core::Result<TestRecording> {
      return recording_of(row, *floor);
    };
    dataset.tests.push_back(std::move(test));
  }
  return dataset;
}

}  // namespace waylode::cli
