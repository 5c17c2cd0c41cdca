// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/getsensordata_records.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "waylode/log/detail/beacon.hpp"
#include "waylode/log/detail/fields.hpp"
#include "waylode/log/detail/limits.hpp"

namespace waylode::log::detail {
namespace {

using namespace std::string_view_literals;

constexpr std::array kTypes = {"ACCE"sv, "GYRO"sv, "MAGN"sv, "PRES"sv, "LIGH"sv, "PROX"sv, "HUMI"sv,
                               "TEMP"sv, "AHRS"sv, "GNSS"sv, "WIFI"sv, "BLUE"sv, "BLE4"sv, "SOUN"sv,
                               "RFID"sv, "IMUX"sv, "IMUL"sv, "IMUI"sv, "POSI"sv};
constexpr std::size_t kTypeLength = 4;
constexpr std::size_t kMaxFloorName = 64;
constexpr std::size_t kMaxInstanceName = 64;

/// The format's own description ends some records with a separator, the logs mostly do not.
std::string_view without_end_separator(std::string_view line) {
  if (line.ends_with(';')) line.remove_suffix(1);
  return line;
}

/// `TYPE;app;sensor;value...;accuracy`
template <std::size_t kValues>
Complaint parse_sensor(std::string_view line, std::array<double, kValues>& values,
                       std::int8_t& accuracy) {
  const Fields fields = split_fields(without_end_separator(line), ';');
  if (fields.count != kValues + 4) return kFieldCount;
  const auto told = parse_integer<std::int8_t>(fields[kValues + 3]);
  if (!parse_numbers(fields, 3, values) || !told) return kNotANumber;
  if (*told < -1 || *told > 3) return kOutOfRange;
  accuracy = *told;
  return nullptr;
}

Complaint parse_vector(std::string_view line, double limit, core::Vector3& vector,
                       std::int8_t& accuracy) {
  std::array<double, 3> values{};
  if (Complaint complaint = parse_sensor(line, values, accuracy)) return complaint;
  if (!all_within(values, limit)) return kOutOfRange;
  vector = {values[0], values[1], values[2]};
  return nullptr;
}

/// `BLE4;app;iBeacon;MAC;RSSI;power;major;minor;UUID`
Complaint parse_ibeacon(const Fields& fields, sample::BleReading& reading) {
  if (fields.count != 9) return kFieldCount;
  const auto tx_power_dbm = parse_number(fields[5]);
  if (!tx_power_dbm) return kNotANumber;
  if (!is_tx_power(*tx_power_dbm)) return kOutOfRange;
  auto beacon = ibeacon_name(fields[8], fields[6], fields[7]);
  if (!beacon) return kBadBeacon;
  reading.tx_power_dbm = told_tx_power_dbm(*tx_power_dbm);
  reading.beacon = std::move(*beacon);
  return nullptr;
}

/// `BLE4;app;Eddystone;MAC;RSSI;instance;telemetry...`
Complaint parse_eddystone(const Fields& fields, sample::BleReading& reading) {
  if (fields.count < 6) return kFieldCount;
  const std::string_view instance = fields[5];
  const bool is_printable =
      std::all_of(instance.begin(), instance.end(), [](char c) { return c > ' ' && c < '\x7F'; });
  if (instance.size() > kMaxInstanceName || !is_printable) return kBadBeacon;
  reading.tx_power_dbm = std::nullopt;
  reading.beacon = instance;
  return nullptr;
}

}  // namespace

Complaint parse_acce(std::string_view line, sample::AccelerometerSample& sample) {
  std::int8_t accuracy = -1;
  return parse_vector(line, kMaxSpecificForce_mps2, sample.specific_force_mps2, accuracy);
}

Complaint parse_gyro(std::string_view line, sample::GyroscopeSample& sample) {
  std::int8_t accuracy = -1;
  return parse_vector(line, kMaxAngularRate_radps, sample.angular_rate_radps, accuracy);
}

Complaint parse_magn(std::string_view line, sample::MagnetometerSample& sample) {
  return parse_vector(line, kMaxField_ut, sample.field_ut, sample.accuracy);
}

Complaint parse_ahrs(std::string_view line, sample::RotationSample& sample) {
  std::array<double, 6> values{};  // pitch, roll, yaw, then the vector part
  std::int8_t accuracy = -1;
  if (Complaint complaint = parse_sensor(line, values, accuracy)) return complaint;
  const auto rotation = rotation_from_vector_part(values[3], values[4], values[5]);
  if (!rotation) return kOutOfRange;
  sample.enu_from_device = *rotation;
  return nullptr;
}

Complaint parse_pres(std::string_view line, sample::BarometerSample& sample) {
  std::array<double, 1> pressure_hpa{};
  std::int8_t accuracy = -1;
  if (Complaint complaint = parse_sensor(line, pressure_hpa, accuracy)) return complaint;
  if (!is_pressure(pressure_hpa[0])) return kOutOfRange;
  sample.pressure_hpa = pressure_hpa[0];
  return nullptr;
}

Complaint parse_gnss(std::string_view line, sample::GnssSample& sample) {
  const Fields fields = split_fields(without_end_separator(line), ';');
  if (fields.count != 11) return kFieldCount;
  std::array<double, 5> values{};  // latitude, longitude, altitude, bearing, accuracy
  if (!parse_numbers(fields, 3, values)) return kNotANumber;
  if (!is_geo_point(values[0], values[1]) || values[4] < 0.0 || values[4] > kMaxGnssAccuracy_m) {
    return kOutOfRange;
  }
  sample.position = {values[0], values[1]};
  sample.accuracy_m = values[4];
  return nullptr;
}

Complaint parse_posi(std::string_view line, sample::WaypointSample& sample) {
  const Fields fields = split_fields(without_end_separator(line), ';');
  if (fields.count != 7) return kFieldCount;
  std::array<double, 2> position_deg{};
  if (!parse_numbers(fields, 3, position_deg)) return kNotANumber;
  if (!is_geo_point(position_deg[0], position_deg[1])) return kOutOfRange;
  if (fields[5].empty() || fields[5].size() > kMaxFloorName) return kOutOfRange;
  sample.geo_position = core::GeoPoint{position_deg[0], position_deg[1]};
  sample.floor = fields[5];
  return nullptr;
}

Complaint parse_ble4(std::string_view line, sample::BleReading& reading) {
  const Fields fields = split_fields(line, ';');
  if (fields.count < 5) return kFieldCount;
  const auto address48 = core::parse_mac(fields[3]);
  if (!address48) return kBadAddress;
  const auto rssi_dbm = parse_number(fields[4]);
  if (!rssi_dbm) return kNotANumber;
  if (!is_rssi(*rssi_dbm)) return kOutOfRange;
  reading.transmitter = core::TransmitterId::bluetooth(*address48);
  reading.rssi_dbm = static_cast<float>(*rssi_dbm);
  if (fields[2] == "iBeacon") return parse_ibeacon(fields, reading);
  if (fields[2] == "Eddystone") return parse_eddystone(fields, reading);
  return kBadBeacon;
}

Complaint parse_wifi(std::string_view line, sample::WifiReading& reading) {
  line = without_end_separator(line);
  if (std::count(line.begin(), line.end(), ';') < 5) return kFieldCount;
  std::string_view rssi;
  std::string_view address;
  std::string_view frequency = "0";
  if (!pop_field(line, ';', rssi) || !pop_field(line, ';', address)) return kFieldCount;
  auto address48 = core::parse_mac(address);
  if (!address48) {
    frequency = address;
    if (!pop_field(line, ';', address)) return kFieldCount;
    address48 = core::parse_mac(address);
    if (!address48) return kBadAddress;
  }
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = line.find(';');
    if (end == std::string_view::npos) return kFieldCount;
    line.remove_prefix(end + 1);
  }
  const auto rssi_dbm = parse_number(rssi);
  const auto frequency_mhz = parse_integer<std::int32_t>(frequency);
  if (!rssi_dbm || !frequency_mhz) return kNotANumber;
  if (!is_rssi(*rssi_dbm) || *frequency_mhz < 0 || *frequency_mhz > kMaxFrequency_mhz) {
    return kOutOfRange;
  }
  reading.transmitter = core::TransmitterId::wifi(*address48);
  reading.rssi_dbm = static_cast<float>(*rssi_dbm);
  reading.frequency_mhz = *frequency_mhz;
  reading.ssid = line;
  return nullptr;
}

bool is_getsensordata_type(std::string_view type) {
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

std::optional<core::Duration> parse_seconds(std::string_view text) {
  const auto seconds = parse_number(text);
  if (!seconds || *seconds < 0.0 || *seconds > kMaxTime_s) return std::nullopt;
  return core::from_seconds(*seconds);
}

std::size_t find_run_on_getsensordata_record(std::string_view line) {
  std::size_t separator = line.find(';');
  while (separator != std::string_view::npos) {
    const bool has_room = separator > kTypeLength && separator + 1 < line.size();
    const char next = has_room ? line[separator + 1] : '\0';
    if (next >= '0' && next <= '9' &&
        is_getsensordata_type(line.substr(separator - kTypeLength, kTypeLength))) {
      return separator - kTypeLength;
    }
    separator = line.find(';', separator + 1);
  }
  return std::string_view::npos;
}

bool is_whole_getsensordata_line(std::string_view line) {
  const bool ends_in_what_matters = line.starts_with("WIFI;") || line.starts_with("BLE4;");
  return !ends_in_what_matters || line.ends_with(';');
}

}  // namespace waylode::log::detail
