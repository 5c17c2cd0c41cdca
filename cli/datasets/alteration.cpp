// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/alteration.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace waylode::cli {
namespace {

constexpr core::Duration kScanTakes = std::chrono::seconds(5);
constexpr core::Duration kBluetoothWindow = std::chrono::seconds(2);

void drop_cached(sample::WifiScan& scan) {
  if (scan.readings.empty()) return;
  const core::DeviceTime newest =
      std::ranges::max_element(scan.readings, {}, &sample::WifiReading::last_seen)->last_seen;
  std::erase_if(scan.readings, [&](const sample::WifiReading& reading) {
    return newest - reading.last_seen > kScanTakes;
  });
}

/// Says sample by sample what a phone with throttled scans would still have heard.
class Throttle {
 public:
  Throttle(double period_s, bool thin_bluetooth)
      : period_(core::from_seconds(period_s)), thin_bluetooth_(thin_bluetooth) {}

  bool keeps(const sample::Sample& sample) {
    if (const auto* scan = std::get_if<sample::WifiScan>(&sample)) {
      return !scan->readings.empty() && opens(scan->time, next_scan_);
    }
    if (const auto* reading = std::get_if<sample::BleReading>(&sample)) {
      return !thin_bluetooth_ || hears_beacon(reading->time);
    }
    return true;
  }

 private:
  bool opens(core::DeviceTime time, core::DeviceTime& next) const {
    if (time < next) return false;
    next = time + period_;
    return true;
  }

  bool hears_beacon(core::DeviceTime time) {
    if (opens(time, next_window_)) window_end_ = time + kBluetoothWindow;
    return time < window_end_;
  }

  core::Duration period_;
  bool thin_bluetooth_;
  core::DeviceTime next_scan_ = core::DeviceTime::min();
  core::DeviceTime next_window_ = core::DeviceTime::min();
  core::DeviceTime window_end_ = core::DeviceTime::min();
};

}  // namespace

void thin_scans(std::vector<sample::Sample>& samples, double period_s, bool thin_bluetooth) {
  if (!std::isfinite(period_s) || period_s <= 0.0) return;
  Throttle throttle(period_s, thin_bluetooth);
  std::vector<sample::Sample> kept;
  kept.reserve(samples.size());
  for (sample::Sample& sample : samples) {
    if (!throttle.keeps(sample)) continue;
    if (auto* scan = std::get_if<sample::WifiScan>(&sample)) drop_cached(*scan);
    kept.push_back(std::move(sample));
  }
  samples = std::move(kept);
}

void shift_rssi(std::vector<sample::Sample>& samples, double offset_db) {
  const auto offset = static_cast<float>(offset_db);
  for (sample::Sample& sample : samples) {
    if (auto* scan = std::get_if<sample::WifiScan>(&sample)) {
      for (sample::WifiReading& reading : scan->readings) reading.rssi_dbm += offset;
    } else if (auto* reading = std::get_if<sample::BleReading>(&sample)) {
      reading->rssi_dbm += offset;
    }
  }
}

void alter(std::vector<sample::Sample>& samples, const Alteration& alteration) {
  thin_scans(samples, alteration.scan_period_s, alteration.thin_bluetooth);
  if (alteration.device_offset_db != 0.0) shift_rssi(samples, alteration.device_offset_db);
}

}  // namespace waylode::cli
