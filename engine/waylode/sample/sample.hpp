// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"

/// Plain values as they left the phone. Device frame: x right, y to the top edge, z out of the
/// screen (Android). `time` is the instant of capture where the log tells it, else of arrival.
namespace waylode::sample {

using core::DeviceTime;
using core::GeoPoint;
using core::TransmitterId;
using core::Vector2;
using core::Vector3;

struct AccelerometerSample {
  DeviceTime time;
  Vector3 specific_force_mps2 =
      Vector3::Zero();  ///< Gravity included: +9.81 on z when lying face up.
  bool operator==(const AccelerometerSample&) const = default;
};

struct GyroscopeSample {
  DeviceTime time;
  Vector3 angular_rate_radps = Vector3::Zero();
  bool operator==(const GyroscopeSample&) const = default;
};

struct MagnetometerSample {
  DeviceTime time;
  Vector3 field_ut = Vector3::Zero();  ///< Calibrated by the phone.
  std::int8_t accuracy = -1;           ///< Android 0 (unreliable) to 3; -1 not told.
  bool operator==(const MagnetometerSample&) const = default;
};

/// Raw readings beside the phone's estimate of its own bias; calibrated = raw - bias.
struct UncalibratedAccelerometerSample {
  DeviceTime time;
  Vector3 specific_force_mps2 = Vector3::Zero();
  Vector3 bias_mps2 = Vector3::Zero();
  bool operator==(const UncalibratedAccelerometerSample&) const = default;
};

struct UncalibratedGyroscopeSample {
  DeviceTime time;
  Vector3 angular_rate_radps = Vector3::Zero();
  Vector3 bias_radps = Vector3::Zero();
  bool operator==(const UncalibratedGyroscopeSample&) const = default;
};

struct UncalibratedMagnetometerSample {
  DeviceTime time;
  Vector3 field_ut = Vector3::Zero();
  Vector3 bias_ut = Vector3::Zero();
  bool operator==(const UncalibratedMagnetometerSample&) const = default;
};

/// The phone's own attitude: rotates device-frame vectors into (magnetic east, magnetic north, up).
struct RotationSample {
  DeviceTime time;
  core::Quaternion enu_from_device = core::Quaternion::Identity();
  bool operator==(const RotationSample& other) const {
    return time == other.time && enu_from_device.coeffs() == other.enu_from_device.coeffs();
  }
};

struct BarometerSample {
  DeviceTime time;
  double pressure_hpa = 0.0;
  bool operator==(const BarometerSample&) const = default;
};

struct WifiReading {
  TransmitterId transmitter;
  float rssi_dbm = 0.0F;
  std::int32_t frequency_mhz = 0;  ///< 0 not told.
  DeviceTime last_seen;            ///< When this transmitter was really heard; not after the scan.
  std::string ssid;
  bool operator==(const WifiReading&) const = default;
};

/// One delivery by the phone. Phones repeat readings from a cache: see `last_seen`.
struct WifiScan {
  DeviceTime time;  ///< Delivery.
  std::vector<WifiReading> readings;
  bool operator==(const WifiScan&) const = default;
};

struct BleReading {
  DeviceTime time;
  TransmitterId transmitter;
  float rssi_dbm = 0.0F;
  std::optional<float> tx_power_dbm;
  std::string beacon;  ///< iBeacon "uuid/major/minor", Eddystone instance, or empty.
  bool operator==(const BleReading&) const = default;
};

struct GnssSample {
  DeviceTime time;
  GeoPoint position;
  double accuracy_m = 0.0;
  bool operator==(const GnssSample&) const = default;
};

/// Truth: where the surveyor said to be. Exactly one of the positions is set.
struct WaypointSample {
  DeviceTime time;
  std::optional<Vector2> position_m;  ///< Floor frame.
  std::optional<GeoPoint> geo_position;
  std::string floor;  ///< The floor's name as the log tells it; empty when the log's header has it.
  bool operator==(const WaypointSample&) const = default;
};

using Sample = std::variant<AccelerometerSample, GyroscopeSample, MagnetometerSample,
                            UncalibratedAccelerometerSample, UncalibratedGyroscopeSample,
                            UncalibratedMagnetometerSample, RotationSample, BarometerSample,
                            WifiScan, BleReading, GnssSample, WaypointSample>;

inline DeviceTime time_of(const Sample& sample) {
  return std::visit([](const auto& value) { return value.time; }, sample);
}

/// Short lower-case name of the alternative: "accelerometer", "wifi_scan", ...
const char* kind_of(const Sample& sample);

/// What a recording says about itself; whatever it does not say is empty.
struct RecordingInfo {
  std::string device_brand;
  std::string device_model;
  std::string site;
  std::string floor;
  std::optional<core::UtcTime> start_utc;
  bool operator==(const RecordingInfo&) const = default;
};

/// One row of a fingerprint table (UJIIndoorLoc): a place and what was heard there.
struct FingerprintRow {
  std::string building;
  std::string floor;
  Vector2 position_m = Vector2::Zero();
  std::vector<WifiReading> readings;  ///< Heard ones only.
  bool operator==(const FingerprintRow&) const = default;
};

}  // namespace waylode::sample
