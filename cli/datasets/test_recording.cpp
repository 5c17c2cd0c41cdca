// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/test_recording.hpp"

#include <algorithm>

#include "datasets/split.hpp"
#include "waylode/survey/surveyed_recording.hpp"

namespace waylode::cli {

namespace {

/// What is wrong with a log that could be read; empty when nothing is.
std::string damage_of(const log::LogReport& report) {
  std::string damage;
  if (report.rejected_total() > 0) {
    damage = std::to_string(report.rejected_total()) + " bad records left out (";
    for (const auto& [reason, count] : report.rejected) {
      if (damage.back() != '(') damage += ", ";
      damage += reason + ": " + std::to_string(count);
    }
    damage += ")";
  }
  if (report.truncated)
    damage += (damage.empty() ? "" : "; ") + ("truncated: " + *report.truncated);
  return damage;
}

}  // namespace

core::Result<log::Recording> load_noted(const std::filesystem::path& path,
                                        const core::LogSink& log) {
  auto recording = log::load_recording(path);
  if (!recording || !log) return recording;
  if (const std::string damage = damage_of(recording->report); !damage.empty()) {
    log(core::LogLevel::kWarning, "evaluate", path.string() + ": " + damage);
  }
  return recording;
}

core::Result<TestRecording> load_marked_log(const std::filesystem::path& path,
                                            const site::Site& site,
                                            std::optional<core::FloorId> default_floor,
                                            const core::LogSink& log) {
  auto recording = load_noted(path, log);
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

core::Result<std::vector<sample::Sample>> load_unlabelled_log(const std::filesystem::path& path,
                                                              const site::Site& site,
                                                              std::optional<core::FloorId> floor) {
  auto marked = load_marked_log(path, site, floor, {});
  if (!marked) return tl::unexpected(marked.error());
  std::erase_if(marked->samples, [](const sample::Sample& sample) {
    return std::holds_alternative<sample::WaypointSample>(sample);
  });
  return std::move(marked->samples);
}

core::Result<TestCase> make_log_test(const std::filesystem::path& path,
                                     const std::shared_ptr<const pipeline::Model>& model,
                                     const std::string& site_name, const core::LogSink& log) {
  const site::Site& site = *model->site();
  const auto recording = load_marked_log(path, site, std::nullopt, log);
  if (!recording) return tl::unexpected(recording.error());
  if (recording->truths.empty()) {
    return core::fail(core::ErrorCode::kLogLacksRecords,
                      "no mark that can be placed on a floor; a test needs marks", path.string());
  }
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
  TestCase test;
  test.name = recording_name(path);
  test.model = model;
  test.load = [path, site_kept = model->site()] {
    return load_marked_log(path, *site_kept, std::nullopt, {});
  };
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
