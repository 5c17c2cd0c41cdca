// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/ilc_records.hpp"

#include <array>
#include <cstdint>
#include <span>

#include "waylode/log/detail/beacon.hpp"
#include "waylode/log/detail/fields.hpp"
#include "waylode/log/detail/limits.hpp"

namespace waylode::log::detail {
namespace {

constexpr std::size_t kTimeDigits = 13;
constexpr std::string_view kRecordMark = "\tTYPE_";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t count_digits_before(std::string_view text, std::size_t end) {
  std::size_t count = 0;
  while (count < end && is_digit(text[end - 1 - count])) ++count;
  return count;
}

/// `time type value... accuracy`, all values within +-limit.
template <std::size_t kValues>
Complaint parse_sensor(std::string_view line, double limit, std::array<double, kValues>& values,
                       std::int8_t& accuracy) {
  const Fields fields = split_fields(line, '\t');
  if (fields.count != kValues + 3) return kFieldCount;
  const std::optional<std::int8_t> told = parse_integer<std::int8_t>(fields[kValues + 2]);
  if (!parse_numbers(fields, 2, values) || !told) return kNotANumber;
  if (*told < -1 || *told > 3 || !all_within(values, limit)) return kOutOfRange;
  accuracy = *told;
  return nullptr;
}

Complaint parse_vector(std::string_view line, double limit, core::Vector3& vector,
                       std::int8_t& accuracy) {
  std::array<double, 3> values{};
  if (Complaint complaint = parse_sensor(line, limit, values, accuracy)) return complaint;
  vector = {values[0], values[1], values[2]};
  return nullptr;
}

Complaint parse_vector_and_bias(std::string_view line, double limit, core::Vector3& vector,
                                core::Vector3& bias) {
  std::array<double, 6> values{};
  std::int8_t accuracy = -1;
  if (Complaint complaint = parse_sensor(line, limit, values, accuracy)) return complaint;
  vector = {values[0], values[1], values[2]};
  bias = {values[3], values[4], values[5]};
  return nullptr;
}

}  // namespace

std::optional<core::DeviceTime> parse_ilc_time(std::string_view text) {
  const std::optional<std::int64_t> time_ms = parse_integer<std::int64_t>(text);
  if (!time_ms || *time_ms < 0 || *time_ms > kMaxTime_ms) return std::nullopt;
  return core::device_time_from_ms(*time_ms);
}

Complaint parse_ilc_accelerometer(std::string_view line, sample::AccelerometerSample& sample) {
  std::int8_t accuracy = -1;
  return parse_vector(line, kMaxSpecificForce_mps2, sample.specific_force_mps2, accuracy);
}

Complaint parse_ilc_gyroscope(std::string_view line, sample::GyroscopeSample& sample) {
  std::int8_t accuracy = -1;
  return parse_vector(line, kMaxAngularRate_radps, sample.angular_rate_radps, accuracy);
}

Complaint parse_ilc_magnetometer(std::string_view line, sample::MagnetometerSample& sample) {
  return parse_vector(line, kMaxField_ut, sample.field_ut, sample.accuracy);
}

Complaint parse_ilc_rotation(std::string_view line, sample::RotationSample& sample) {
  core::Vector3 vector_part;
  std::int8_t accuracy = -1;
  if (Complaint complaint = parse_vector(line, 2.0, vector_part, accuracy)) return complaint;
  const auto rotation =
      rotation_from_vector_part(vector_part.x(), vector_part.y(), vector_part.z());
  if (!rotation) return kOutOfRange;
  sample.enu_from_device = *rotation;
  return nullptr;
}

Complaint parse_ilc_uncalibrated_accelerometer(std::string_view line,
                                               sample::UncalibratedAccelerometerSample& sample) {
  return parse_vector_and_bias(line, kMaxSpecificForce_mps2, sample.specific_force_mps2,
                               sample.bias_mps2);
}

Complaint parse_ilc_uncalibrated_gyroscope(std::string_view line,
                                           sample::UncalibratedGyroscopeSample& sample) {
  return parse_vector_and_bias(line, kMaxAngularRate_radps, sample.angular_rate_radps,
                               sample.bias_radps);
}

Complaint parse_ilc_uncalibrated_magnetometer(std::string_view line,
                                              sample::UncalibratedMagnetometerSample& sample) {
  return parse_vector_and_bias(line, kMaxField_ut, sample.field_ut, sample.bias_ut);
}

Complaint parse_ilc_waypoint(std::string_view line, sample::WaypointSample& sample) {
  const Fields fields = split_fields(line, '\t');
  if (fields.count != 4) return kFieldCount;
  std::array<double, 2> position_m{};
  if (!parse_numbers(fields, 2, position_m)) return kNotANumber;
  if (!all_within(position_m, kMaxCoordinate_m)) return kOutOfRange;
  sample.position_m = core::Vector2(position_m[0], position_m[1]);
  return nullptr;
}

Complaint parse_ilc_wifi(std::string_view line, core::DeviceTime delivery,
                         sample::WifiReading& reading) {
  std::string_view last_seen;
  std::string_view frequency;
  std::string_view rssi;
  std::string_view address;
  if (!pop_field(line, '\t', last_seen) || !pop_field(line, '\t', frequency) ||
      !pop_field(line, '\t', rssi) || !pop_field(line, '\t', address)) {
    return kFieldCount;
  }
  const std::size_t type_end = line.find('\t', line.find('\t') + 1);
  if (type_end == std::string_view::npos) return kFieldCount;

  const auto address48 = core::parse_mac(address);
  if (!address48) return kBadAddress;
  const auto rssi_dbm = parse_number(rssi);
  const auto frequency_mhz = parse_integer<std::int32_t>(frequency);
  const auto seen = parse_ilc_time(last_seen);
  if (!rssi_dbm || !frequency_mhz || !seen) return kNotANumber;
  if (!is_rssi(*rssi_dbm) || *frequency_mhz < 0 || *frequency_mhz > kMaxFrequency_mhz) {
    return kOutOfRange;
  }
  if (*seen > delivery) return kSeenAfterDelivery;
  reading = {core::TransmitterId::wifi(*address48), static_cast<float>(*rssi_dbm), *frequency_mhz,
             *seen, std::string(line.substr(type_end + 1))};
  return nullptr;
}

Complaint parse_ilc_beacon(std::string_view line, sample::BleReading& reading) {
  const Fields fields = split_fields(line, '\t');
  if (fields.count != 9 && fields.count != 10) return kFieldCount;
  const auto address48 = core::parse_mac(fields[8]);
  if (!address48) return kBadAddress;
  const auto tx_power_dbm = parse_number(fields[5]);
  const auto rssi_dbm = parse_number(fields[6]);
  if (!tx_power_dbm || !rssi_dbm) return kNotANumber;
  if (!is_tx_power(*tx_power_dbm) || !is_rssi(*rssi_dbm)) return kOutOfRange;
  const auto beacon = ibeacon_name(fields[2], fields[3], fields[4]);
  if (!beacon) return kBadBeacon;
  reading.transmitter = core::TransmitterId::bluetooth(*address48);
  reading.rssi_dbm = static_cast<float>(*rssi_dbm);
  reading.tx_power_dbm = told_tx_power_dbm(*tx_power_dbm);
  reading.beacon = *beacon;
  return nullptr;
}

std::size_t find_run_on_ilc_record(std::string_view line) {
  std::size_t mark = line.find(kRecordMark);
  if (!line.starts_with('#') && mark != std::string_view::npos) {
    mark = line.find(kRecordMark, mark + kRecordMark.size());
  }
  if (mark == std::string_view::npos || count_digits_before(line, mark) < kTimeDigits) {
    return std::string_view::npos;
  }
  return mark - kTimeDigits;
}

bool is_whole_ilc_line(std::string_view line) {
  const Fields fields = split_fields(line, '\t');
  if (fields.count < 3) return false;
  const std::string_view last = line.substr(line.rfind('\t') + 1);
  const bool is_full_time = last.size() == fields[0].size();
  if (fields[1] == "TYPE_WIFI" || fields[1] == "TYPE_BEACON") return is_full_time;
  return fields[1] != "TYPE_WAYPOINT";
}

}  // namespace waylode::log::detail
