// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/test_recording.hpp"

#include <algorithm>

#include "waylode/log/log_reader.hpp"
#include "waylode/survey/surveyed_recording.hpp"

namespace waylode::cli {

core::Result<TestRecording> load_marked_log(const std::filesystem::path& path,
                                            const site::Site& site,
                                            std::optional<core::FloorId> default_floor) {
  auto recording = log::load_recording(path);
  if (!recording) return tl::unexpected(recording.error());
  TestRecording test;
  test.samples = std::move(recording->samples);
  for (const survey::PlacedWaypoint& mark :
       survey::place_waypoints(site, test.samples, default_floor)) {
    test.truths.push_back({mark.time, mark.floor, mark.position_m, true});
  }
  if (!test.truths.empty()) {
    survey::drop_readings_before(test.samples, test.truths.front().time);
  }
  return test;
}

core::Result<TestCase> name_by_floor(TestCase test, const std::filesystem::path& path,
                                     const std::string& site_name) {
  const auto recording = test.load();
  if (!recording) return tl::unexpected(recording.error());
  if (recording->truths.empty()) {
    return core::fail(core::ErrorCode::kLogLacksRecords,
                      "no mark that can be placed on a floor; a test needs marks", path.string());
  }
  const site::Site& site = *test.model->site();
  const core::FloorId first = recording->truths.front().floor;
  for (const eval::TruthPoint& truth : recording->truths) {
    if (is_mapped(site, truth.floor)) continue;
    return core::fail(core::ErrorCode::kMapMissing,
                      "its floor " + site.floor(truth.floor).name +
                          " has no radio map; put a recording of that floor into train",
                      path.string());
  }
  const bool one_floor = std::ranges::all_of(
      recording->truths, [&](const eval::TruthPoint& truth) { return truth.floor == first; });
  if (one_floor) test.floor = first;
  test.group = site_name + "/" + site.floor(first).name;
  return test;
}

bool is_mapped(const site::Site& site, core::FloorId floor) {
  return std::ranges::any_of(
      site.radio_map().fingerprints,
      [&](const site::FingerprintRecord& record) { return record.floor == floor.index; });
}

}  // namespace waylode::cli
