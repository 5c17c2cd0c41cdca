// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/map_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "waylode/core/angle.hpp"
#include "waylode/survey/quality.hpp"

namespace waylode::survey {
namespace {

std::vector<observation::MotionDelta> steps_of(const SurveyedRecording& recording,
                                               const pdr::DeadReckoning::Options& options) {
  pdr::DeadReckoning reckoning(options);
  std::vector<observation::MotionDelta> steps;
  for (const sample::Sample& sample : recording.samples) {
    if (const auto step = reckoning.add(sample)) steps.push_back(*step);
  }
  return steps;
}

}  // namespace

core::Result<void> MapBuilder::Options::validate() const {
  for (const core::Result<void>& part : {scan.validate(), pdr.validate(), labels.validate(),
                                         moving.validate(), magnetic.validate()}) {
    if (!part) return part;
  }
  return {};
}

MapBuilder::MapBuilder(site::SiteParts parts, const Options& options)
    : parts_(std::move(parts)),
      site_(std::make_shared<site::Site>(
          site::SiteParts{parts_.name, parts_.origin, parts_.floors, {}})),
      options_(options),
      moving_(options.moving, options.moving_evidence),
      magnetic_(options.magnetic),
      stretches_(parts_.floors.size()),
      recordings_on_floor_(parts_.floors.size()) {}

void MapBuilder::add(const SurveyedRecording& recording) {
  const std::vector<PlacedWaypoint> waypoints =
      place_waypoints(*site_, recording.samples, recording.default_floor);
  if (waypoints.size() < 2) {
    quality_.notes.push_back(recording.name + ": fewer than two marks on a known floor; not used");
    return;
  }
  SurveyedRecording own = recording;
  drop_readings_before(own.samples, waypoints.front().time);
  const LabelledPath path(options_.labels, waypoints, steps_of(own, options_.pdr));
  note_stretches(path);
  magnetic_.add(own.samples, path);

  const std::size_t instances_before = instances_.size();
  std::set<std::pair<core::TransmitterId, core::DeviceTime>> heard;
  std::set<std::pair<core::TransmitterId, core::DeviceTime>> delivered;
  moving_.begin_walk();
  radio::ScanAssembler assembler(options_.scan);
  for (sample::Sample& sample : own.samples) {
    if (const auto* advertisement = std::get_if<sample::BleReading>(&sample)) {
      assembler.add(*advertisement);
    } else if (auto* scan = std::get_if<sample::WifiScan>(&sample)) {
      quality_.readings_unmappable += std::erase_if(
          scan->readings, [](const auto& reading) { return asks_not_to_be_mapped(reading.ssid); });
      quality_.readings_duplicate += std::erase_if(scan->readings, [&](const auto& reading) {
        return heard_before_.contains({reading.transmitter, reading.last_seen}) ||
               delivered.contains({reading.transmitter, scan->time});
      });
      for (const auto& reading : scan->readings) {
        delivered.emplace(reading.transmitter, scan->time);
        heard.emplace(reading.transmitter, reading.last_seen);
      }
      add_scan(assembler.assemble(*scan), *scan, path);
    }
  }
  heard_before_.merge(heard);
  ++recording_count_;
  if (instances_.size() == instances_before) {
    quality_.notes.push_back(recording.name + ": no usable Wi-Fi between its marks");
  }
}

void MapBuilder::add(const sample::FingerprintRow& row, core::FloorId floor) {
  if (floor.index >= parts_.floors.size()) {
    quality_.notes.push_back("a row of floor '" + row.floor + "': not a floor of this site");
    return;
  }
  Instance instance;
  instance.record.floor = floor.index;
  instance.record.x_m = static_cast<float>(row.position_m.x());
  instance.record.y_m = static_cast<float>(row.position_m.y());
  instance.record.position_sigma_m = static_cast<float>(options_.labels.mark_sigma_m);
  instance.record.recording = recording_count_++;
  for (const sample::WifiReading& reading : row.readings) {
    instance.readings.push_back({reading.transmitter, reading.rssi_dbm, 0.0F});
  }
  recordings_on_floor_[floor.index].insert(instance.record.recording);
  if (!instance.readings.empty()) instances_.push_back(std::move(instance));
}

void MapBuilder::add_scan(const radio::Query& query, const sample::WifiScan& scan,
                          const LabelledPath& path) {
  if (query.readings.empty()) return;
  const std::optional<Label> label = path.at(query.measured);
  if (!label) {
    ++quality_.scans_unlabelled;
    return;
  }
  Instance instance;
  instance.record.floor = label->floor.index;
  instance.record.x_m = static_cast<float>(label->position_m.x());
  instance.record.y_m = static_cast<float>(label->position_m.y());
  instance.record.position_sigma_m = static_cast<float>(label->sigma_m);
  instance.record.recording = recording_count_;
  for (const radio::QueryReading& reading : query.readings) {
    instance.readings.push_back({reading.transmitter, reading.rssi_dbm, reading.age_s});
  }
  moving_.pass(label->floor, label->position_m);
  for (const sample::WifiReading& reading : scan.readings) {
    if (const auto place = path.at(reading.last_seen)) {
      moving_.hear(reading.transmitter, reading.ssid, reading.rssi_dbm, place->floor,
                   place->position_m);
    }
  }
  recordings_on_floor_[label->floor.index].insert(recording_count_);
  instances_.push_back(std::move(instance));
}

void MapBuilder::note_stretches(const LabelledPath& path) {
  for (const LabelledPath::Stretch& stretch : path.stretches()) {
    ++quality_.stretches;
    if (stretch.rejected) {
      ++quality_.stretches_rejected;
      continue;
    }
    if (!stretch.shaped) ++quality_.stretches_straight;
    stretches_[stretch.floor.index].push_back(stretch);
  }
}

void MapBuilder::learn_headings() {
  // Marks are on the floor frame; headings are on the site frame, which all floors share.
  std::vector<std::vector<LabelledPath::Stretch>> on_site = stretches_;
  std::vector<LabelledPath::Stretch> all;
  for (std::size_t i = 0; i < parts_.floors.size(); ++i) {
    const core::Vector2 axis = parts_.floors[i].site_from_floor.linear.col(0);
    for (LabelledPath::Stretch& stretch : on_site[i]) {
      stretch.turn_rad = core::wrap_angle(stretch.turn_rad + std::atan2(axis.y(), axis.x()));
      all.push_back(stretch);
    }
  }
  const double of_site_rad = heading_offset(all).value_or(0.0);
  for (std::size_t i = 0; i < parts_.floors.size(); ++i) {
    parts_.floors[i].heading_offset_rad = heading_offset(on_site[i]).value_or(of_site_rad);
  }
}

core::Result<SurveyedSite> MapBuilder::build() {
  SurveyedSite result{parts_, quality_};
  result.parts.radio_map = freeze_radio_map(result.quality);
  if (result.parts.radio_map.fingerprints.empty()) {
    std::string why = "no recording was given";
    if (!quality_.notes.empty()) why = quality_.notes.front();
    if (!instances_.empty()) why = "all transmitters heard move about";
    return core::fail(core::ErrorCode::kSurveyInsufficient,
                      "no fingerprint could be made (" + why +
                          "); survey with Wi-Fi on and mark at least two places per walk",
                      parts_.name);
  }
  result.parts.magnetic_map = magnetic_.build();
  learn_headings();
  result.parts.floors = parts_.floors;
  result.quality.floors = floor_quality(result.parts, stretches_, recordings_on_floor_);
  return result;
}

site::RadioMapStorage MapBuilder::freeze_radio_map(QualityReport& quality) const {
  site::RadioMapBuilder builder;
  std::map<core::TransmitterId, bool> moving;
  for (const Instance& instance : instances_) {
    std::vector<site::MapReading> readings;
    for (const site::MapReading& reading : instance.readings) {
      const auto [known, is_new] = moving.try_emplace(reading.transmitter, false);
      if (is_new) known->second = moving_.is_moving(reading.transmitter);
      if (!known->second) readings.push_back(reading);
    }
    if (!readings.empty()) builder.add(instance.record, std::move(readings));
  }
  quality.transmitters_moving = static_cast<std::uint64_t>(
      std::ranges::count_if(moving, [](const auto& entry) { return entry.second; }));
  return builder.build();
}

}  // namespace waylode::survey
