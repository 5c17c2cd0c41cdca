// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/scan_assembler.hpp"

#include <algorithm>
#include <map>

namespace waylode::radio {
namespace {

core::DeviceTime median_time(std::vector<core::DeviceTime> times) {
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

/// When the Wi-Fi part of the scan was in the air.
core::DeviceTime measured_time(const std::vector<core::DeviceTime>& heard,
                               core::DeviceTime delivered, core::Duration fresh_age) {
  std::vector<core::DeviceTime> fresh;
  for (const core::DeviceTime time : heard) {
    if (delivered - time <= fresh_age) fresh.push_back(time);
  }
  if (!fresh.empty()) return median_time(std::move(fresh));
  return heard.empty() ? delivered : median_time(heard);
}

}  // namespace

core::Result<void> ScanAssembler::Options::validate() const {
  if (!(max_age_s > 0.0 && fresh_age_s > 0.0 && ble_window_s >= 0.0 && max_age_s <= 60.0 &&
        ble_window_s <= 60.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "ages must be positive and at most 60 s",
                      "scan_assembler");
  }
  return {};
}

void ScanAssembler::add(const sample::BleReading& reading) {
  if (options_.ble_window_s <= 0.0) return;
  advertisements_.push_back(reading);
  const core::Duration window = core::from_seconds(options_.ble_window_s);
  while (advertisements_.front().time < reading.time - window) advertisements_.pop_front();
}

bool ScanAssembler::is_hotspot(const sample::WifiReading& reading) const {
  return hotspots_ != nullptr && hotspots_->classify(reading.transmitter, reading.ssid).verdict ==
                                     HotspotClassifier::Verdict::kMobile;
}

Query ScanAssembler::assemble(const sample::WifiScan& scan) const {
  struct Heard {
    core::DeviceTime time;
    float rssi_dbm;
  };
  std::map<core::TransmitterId, Heard> newest;
  std::vector<core::DeviceTime> heard_times;
  const core::Duration max_age = core::from_seconds(options_.max_age_s);
  for (const sample::WifiReading& reading : scan.readings) {
    if (scan.time - reading.last_seen > max_age || is_hotspot(reading)) continue;
    heard_times.push_back(reading.last_seen);
    const auto [entry, added] =
        newest.try_emplace(reading.transmitter, Heard{reading.last_seen, reading.rssi_dbm});
    if (!added && reading.last_seen > entry->second.time) {
      entry->second = {reading.last_seen, reading.rssi_dbm};
    }
  }
  const core::Duration window = core::from_seconds(options_.ble_window_s);
  for (const sample::BleReading& reading : advertisements_) {
    if (reading.time > scan.time || scan.time - reading.time > window) continue;
    newest.insert_or_assign(reading.transmitter, Heard{reading.time, reading.rssi_dbm});
  }

  Query query{measured_time(heard_times, scan.time, core::from_seconds(options_.fresh_age_s)),
              scan.time,
              {}};
  query.readings.reserve(newest.size());
  for (const auto& [transmitter, heard] : newest) {
    query.readings.push_back({transmitter, heard.rssi_dbm,
                              static_cast<float>(core::to_seconds(scan.time - heard.time))});
  }
  return query;
}

Query ScanAssembler::assemble_bluetooth(core::DeviceTime time) const {
  Query query = assemble(sample::WifiScan{time, {}});
  std::vector<core::DeviceTime> heard;
  for (const QueryReading& reading : query.readings) {
    heard.push_back(time - core::from_seconds(static_cast<double>(reading.age_s)));
  }
  if (!heard.empty()) query.measured = median_time(std::move(heard));
  return query;
}

}  // namespace waylode::radio
