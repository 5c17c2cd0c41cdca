// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/radio/hotspot_classifier.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::radio {

/// A scan ready for matching: the newest usable reading per transmitter, Wi-Fi and Bluetooth.
struct Query {
  core::DeviceTime measured;  ///< Median time at which the fresh Wi-Fi readings were heard.
  core::DeviceTime delivered;
  std::vector<QueryReading> readings;  ///< By transmitter.
};

/// Turns deliveries into queries: dates readings by when they were heard, leaves out what the phone
/// repeats from its cache, and adds the Bluetooth advertisements of the last seconds. Serves the
/// survey and the live phone alike, so that both sides of a comparison are made the same way.
class ScanAssembler {
 public:
  struct Options {
    double max_age_s = 6.0;    ///< Older Wi-Fi readings are left out.
    double fresh_age_s = 3.0;  ///< Readings that date the scan (all of them if none is that fresh).
    double ble_window_s = 4.0;  ///< Advertisements this recent join; 0 leaves Bluetooth out.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// With `hotspots`, transmitters that it calls mobile are left out. It must outlive this.
  explicit ScanAssembler(const Options& options, const HotspotClassifier* hotspots = nullptr)
      : options_(options), hotspots_(hotspots) {}

  void add(const sample::BleReading& reading);
  /// A query without readings when nothing in the scan is usable.
  Query assemble(const sample::WifiScan& scan) const;
  /// From Bluetooth alone, for a phone whose Wi-Fi is silent or throttled.
  Query assemble_bluetooth(core::DeviceTime time) const;

 private:
  bool is_hotspot(const sample::WifiReading& reading) const;

  Options options_;
  const HotspotClassifier* hotspots_;
  std::deque<sample::BleReading> advertisements_;
};

}  // namespace waylode::radio
