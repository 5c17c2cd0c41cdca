// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/sample_codec.hpp"

#include <google/protobuf/descriptor.pb.h>

#include <array>
#include <utility>

#include "waylode_log.pb.h"

namespace waylode::log::detail {
namespace {

using core::DeviceTime;
using core::TransmitterId;
using core::Vector3;
using google::protobuf::Descriptor;

constexpr std::array<const char*, kSampleKindCount> kTopics = {"/accelerometer",
                                                               "/gyroscope",
                                                               "/magnetometer",
                                                               "/accelerometer_uncalibrated",
                                                               "/gyroscope_uncalibrated",
                                                               "/magnetometer_uncalibrated",
                                                               "/rotation",
                                                               "/barometer",
                                                               "/wifi_scan",
                                                               "/ble",
                                                               "/gnss",
                                                               "/waypoint"};

const Descriptor& descriptor_of_kind(std::size_t kind) {
  const std::array<const Descriptor*, kSampleKindCount> descriptors = {
      v1::Accelerometer::descriptor(),
      v1::Gyroscope::descriptor(),
      v1::Magnetometer::descriptor(),
      v1::UncalibratedAccelerometer::descriptor(),
      v1::UncalibratedGyroscope::descriptor(),
      v1::UncalibratedMagnetometer::descriptor(),
      v1::Rotation::descriptor(),
      v1::Barometer::descriptor(),
      v1::WifiScan::descriptor(),
      v1::BleReading::descriptor(),
      v1::Gnss::descriptor(),
      v1::Waypoint::descriptor()};
  return *descriptors.at(kind);
}

template <typename Time>
std::int64_t count_ns(Time time) {
  return time.time_since_epoch().count();
}
DeviceTime from_ns(std::int64_t time_ns) { return DeviceTime(core::Duration(time_ns)); }

// Each pair below maps one kind to its message and back.

v1::Accelerometer to_message(const sample::AccelerometerSample& value) {
  v1::Accelerometer message;
  message.set_specific_force_x_mps2(value.specific_force_mps2.x());
  message.set_specific_force_y_mps2(value.specific_force_mps2.y());
  message.set_specific_force_z_mps2(value.specific_force_mps2.z());
  return message;
}
sample::AccelerometerSample from_message(const v1::Accelerometer& message) {
  return {{},
          {message.specific_force_x_mps2(), message.specific_force_y_mps2(),
           message.specific_force_z_mps2()}};
}

v1::Gyroscope to_message(const sample::GyroscopeSample& value) {
  v1::Gyroscope message;
  message.set_angular_rate_x_radps(value.angular_rate_radps.x());
  message.set_angular_rate_y_radps(value.angular_rate_radps.y());
  message.set_angular_rate_z_radps(value.angular_rate_radps.z());
  return message;
}
sample::GyroscopeSample from_message(const v1::Gyroscope& message) {
  return {{},
          {message.angular_rate_x_radps(), message.angular_rate_y_radps(),
           message.angular_rate_z_radps()}};
}

v1::Magnetometer to_message(const sample::MagnetometerSample& value) {
  v1::Magnetometer message;
  message.set_field_x_ut(value.field_ut.x());
  message.set_field_y_ut(value.field_ut.y());
  message.set_field_z_ut(value.field_ut.z());
  if (value.accuracy >= 0) message.set_accuracy(value.accuracy);
  return message;
}
sample::MagnetometerSample from_message(const v1::Magnetometer& message) {
  // What does not fit an int8 is out of range too; keep it so for the check that follows.
  constexpr std::int8_t kOutOfRange = 127;
  std::int8_t accuracy = -1;
  if (message.has_accuracy()) {
    const bool known = message.accuracy() >= 0 && message.accuracy() <= 3;
    accuracy = known ? static_cast<std::int8_t>(message.accuracy()) : kOutOfRange;
  }
  return {{}, {message.field_x_ut(), message.field_y_ut(), message.field_z_ut()}, accuracy};
}

v1::UncalibratedAccelerometer to_message(const sample::UncalibratedAccelerometerSample& value) {
  v1::UncalibratedAccelerometer message;
  message.set_specific_force_x_mps2(value.specific_force_mps2.x());
  message.set_specific_force_y_mps2(value.specific_force_mps2.y());
  message.set_specific_force_z_mps2(value.specific_force_mps2.z());
  message.set_bias_x_mps2(value.bias_mps2.x());
  message.set_bias_y_mps2(value.bias_mps2.y());
  message.set_bias_z_mps2(value.bias_mps2.z());
  return message;
}
sample::UncalibratedAccelerometerSample from_message(const v1::UncalibratedAccelerometer& message) {
  return {{},
          {message.specific_force_x_mps2(), message.specific_force_y_mps2(),
           message.specific_force_z_mps2()},
          {message.bias_x_mps2(), message.bias_y_mps2(), message.bias_z_mps2()}};
}

v1::UncalibratedGyroscope to_message(const sample::UncalibratedGyroscopeSample& value) {
  v1::UncalibratedGyroscope message;
  message.set_angular_rate_x_radps(value.angular_rate_radps.x());
  message.set_angular_rate_y_radps(value.angular_rate_radps.y());
  message.set_angular_rate_z_radps(value.angular_rate_radps.z());
  message.set_bias_x_radps(value.bias_radps.x());
  message.set_bias_y_radps(value.bias_radps.y());
  message.set_bias_z_radps(value.bias_radps.z());
  return message;
}
sample::UncalibratedGyroscopeSample from_message(const v1::UncalibratedGyroscope& message) {
  return {{},
          {message.angular_rate_x_radps(), message.angular_rate_y_radps(),
           message.angular_rate_z_radps()},
          {message.bias_x_radps(), message.bias_y_radps(), message.bias_z_radps()}};
}

v1::UncalibratedMagnetometer to_message(const sample::UncalibratedMagnetometerSample& value) {
  v1::UncalibratedMagnetometer message;
  message.set_field_x_ut(value.field_ut.x());
  message.set_field_y_ut(value.field_ut.y());
  message.set_field_z_ut(value.field_ut.z());
  message.set_bias_x_ut(value.bias_ut.x());
  message.set_bias_y_ut(value.bias_ut.y());
  message.set_bias_z_ut(value.bias_ut.z());
  return message;
}
sample::UncalibratedMagnetometerSample from_message(const v1::UncalibratedMagnetometer& message) {
  return {{},
          {message.field_x_ut(), message.field_y_ut(), message.field_z_ut()},
          {message.bias_x_ut(), message.bias_y_ut(), message.bias_z_ut()}};
}

v1::Rotation to_message(const sample::RotationSample& value) {
  v1::Rotation message;
  message.set_enu_from_device_w(value.enu_from_device.w());
  message.set_enu_from_device_x(value.enu_from_device.x());
  message.set_enu_from_device_y(value.enu_from_device.y());
  message.set_enu_from_device_z(value.enu_from_device.z());
  return message;
}
sample::RotationSample from_message(const v1::Rotation& message) {
  return {{},
          {message.enu_from_device_w(), message.enu_from_device_x(), message.enu_from_device_y(),
           message.enu_from_device_z()}};
}

v1::Barometer to_message(const sample::BarometerSample& value) {
  v1::Barometer message;
  message.set_pressure_hpa(value.pressure_hpa);
  return message;
}
sample::BarometerSample from_message(const v1::Barometer& message) {
  return {{}, message.pressure_hpa()};
}

v1::WifiScan to_message(const sample::WifiScan& scan) {
  v1::WifiScan message;
  for (const sample::WifiReading& reading : scan.readings) {
    v1::WifiScan::Reading& row = *message.add_readings();
    row.set_transmitter(reading.transmitter.packed());
    row.set_rssi_dbm(reading.rssi_dbm);
    row.set_frequency_mhz(reading.frequency_mhz);
    row.set_last_seen_ns(count_ns(reading.last_seen));
    row.set_ssid(reading.ssid);
  }
  return message;
}
sample::WifiScan from_message(const v1::WifiScan& message) {
  sample::WifiScan scan;
  scan.readings.reserve(static_cast<std::size_t>(message.readings_size()));
  for (const v1::WifiScan::Reading& row : message.readings()) {
    scan.readings.push_back({TransmitterId::from_packed(row.transmitter()), row.rssi_dbm(),
                             row.frequency_mhz(), from_ns(row.last_seen_ns()), row.ssid()});
  }
  return scan;
}

v1::BleReading to_message(const sample::BleReading& value) {
  v1::BleReading message;
  message.set_transmitter(value.transmitter.packed());
  message.set_rssi_dbm(value.rssi_dbm);
  if (value.tx_power_dbm) message.set_tx_power_dbm(*value.tx_power_dbm);
  message.set_beacon(value.beacon);
  return message;
}
sample::BleReading from_message(const v1::BleReading& message) {
  sample::BleReading value;
  value.transmitter = TransmitterId::from_packed(message.transmitter());
  value.rssi_dbm = message.rssi_dbm();
  if (message.has_tx_power_dbm()) value.tx_power_dbm = message.tx_power_dbm();
  value.beacon = message.beacon();
  return value;
}

v1::Gnss to_message(const sample::GnssSample& value) {
  v1::Gnss message;
  message.set_latitude_deg(value.position.latitude_deg);
  message.set_longitude_deg(value.position.longitude_deg);
  message.set_accuracy_m(value.accuracy_m);
  return message;
}
sample::GnssSample from_message(const v1::Gnss& message) {
  return {{}, {message.latitude_deg(), message.longitude_deg()}, message.accuracy_m()};
}

v1::Waypoint to_message(const sample::WaypointSample& value) {
  v1::Waypoint message;
  if (value.position_m) {
    message.mutable_floor_position()->set_x_m(value.position_m->x());
    message.mutable_floor_position()->set_y_m(value.position_m->y());
  } else if (value.geo_position) {
    message.mutable_geo_position()->set_latitude_deg(value.geo_position->latitude_deg);
    message.mutable_geo_position()->set_longitude_deg(value.geo_position->longitude_deg);
  }
  message.set_floor(value.floor);
  return message;
}
sample::WaypointSample from_message(const v1::Waypoint& message) {
  sample::WaypointSample value;
  if (message.has_floor_position()) {
    const auto& position = message.floor_position();
    value.position_m = core::Vector2(position.x_m(), position.y_m());
  } else if (message.has_geo_position()) {
    const auto& position = message.geo_position();
    value.geo_position = core::GeoPoint{position.latitude_deg(), position.longitude_deg()};
  }
  value.floor = message.floor();
  return value;
}

template <typename Message>
std::optional<Message> parse(std::string_view bytes) {
  Message message;
  const bool whole = message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
  return whole ? std::optional(std::move(message)) : std::nullopt;
}

template <typename Value>
std::optional<sample::Sample> decode_as(std::string_view bytes) {
  using Message = decltype(to_message(std::declval<const Value&>()));
  const std::optional<Message> message = parse<Message>(bytes);
  if (!message) return std::nullopt;
  Value value = from_message(*message);
  value.time = from_ns(message->device_time_ns());
  return value;
}

template <std::size_t... Kinds>
std::optional<sample::Sample> decode_kind(std::size_t kind, std::string_view bytes,
                                          std::index_sequence<Kinds...> /*kinds*/) {
  using Decode = std::optional<sample::Sample> (*)(std::string_view);
  constexpr std::array<Decode, sizeof...(Kinds)> kDecoders = {
      &decode_as<std::variant_alternative_t<Kinds, sample::Sample>>...};
  return kDecoders.at(kind)(bytes);
}

}  // namespace

const char* topic_of_kind(std::size_t kind) { return kTopics.at(kind); }

std::string schema_name_of_kind(std::size_t kind) { return descriptor_of_kind(kind).full_name(); }

std::optional<std::size_t> kind_of_schema_name(std::string_view name) {
  for (std::size_t kind = 0; kind < kSampleKindCount; ++kind) {
    if (descriptor_of_kind(kind).full_name() == name) return kind;
  }
  return std::nullopt;
}

std::string schema_of_kind(std::size_t kind) {
  const Descriptor& descriptor = descriptor_of_kind(kind);
  google::protobuf::FileDescriptorSet set;
  google::protobuf::FileDescriptorProto& file = *set.add_file();
  file.set_name("waylode/log/v1/" + descriptor.name() + ".proto");
  file.set_package(descriptor.file()->package());
  file.set_syntax("proto3");
  descriptor.CopyTo(file.add_message_type());
  return set.SerializeAsString();
}

void encode_sample(const sample::Sample& sample, std::string& bytes) {
  std::visit(
      [&bytes](const auto& value) {
        auto message = to_message(value);
        message.set_device_time_ns(count_ns(value.time));
        message.AppendToString(&bytes);
      },
      sample);
}

tl::expected<sample::Sample, const char*> decode_sample(std::size_t kind, std::string_view bytes) {
  // Protobuf prints a line for text that is not UTF-8; a bad message is the caller's to count.
  const google::protobuf::LogSilencer silence;
  std::optional<sample::Sample> sample =
      decode_kind(kind, bytes, std::make_index_sequence<kSampleKindCount>{});
  if (!sample) return tl::unexpected<const char*>("bad_message");
  if (const char* fault = fault_of(*sample)) return tl::unexpected<const char*>(fault);
  return std::move(*sample);
}

}  // namespace waylode::log::detail
