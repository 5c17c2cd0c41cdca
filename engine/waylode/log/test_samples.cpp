// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/test_samples.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>

namespace waylode::log::test {
namespace {

using core::DeviceTime;
using core::Duration;
using core::Rng;
using core::TransmitterId;
using core::Vector2;
using core::Vector3;

DeviceTime at_ns(std::int64_t time_ns) { return DeviceTime(Duration(time_ns)); }

DeviceTime random_time(Rng& rng) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  switch (rng.below(8)) {
    case 0:
      return DeviceTime::min();
    case 1:
      return DeviceTime::max();
    case 2:
      return at_ns(0);
    default:
      return at_ns(static_cast<std::int64_t>(rng.below(2 * kHour_ns)) - kHour_ns);
  }
}

/// Any number within [-limit, limit]: everyday, extreme, or any pattern of bits.
double random_number(Rng& rng, double limit) {
  switch (rng.below(8)) {
    case 0:
      return 0.0;
    case 1:
      return std::numeric_limits<double>::denorm_min();
    case 2:
      return -limit;
    case 3: {
      const double any =
          std::bit_cast<double>(rng.below(std::numeric_limits<std::uint64_t>::max()));
      return std::abs(any) <= limit ? any : limit;
    }
    default:
      return limit * rng.uniform(-1.0, 1.0);
  }
}

// Limits that phones stay within.
constexpr double kForce_mps2 = 160.0;
constexpr double kRate_radps = 35.0;
constexpr double kField_ut = 5000.0;

Vector3 random_vector(Rng& rng, double limit) {
  const double x = random_number(rng, limit);
  const double y = random_number(rng, limit);
  return {x, y, random_number(rng, limit)};
}

float random_level_dbm(Rng& rng) { return static_cast<float>(rng.uniform(-110.0, 5.0)); }

std::string random_octets(Rng& rng) {
  std::string octets(rng.below(33), '\0');
  for (char& octet : octets) octet = static_cast<char>(rng.below(256));
  return octets;
}

std::string random_text(Rng& rng) {
  // The second to fourth hold two, three and four octets a character.
  constexpr std::array<const char*, 5> kWords = {"", "F2", "\xC3\xA9tage", "\xE6\xA5\xBC 3",
                                                 "\xF0\x9F\x8F\xA2"};
  return kWords.at(rng.below(kWords.size()));
}

TransmitterId random_transmitter(Rng& rng) {
  const std::uint64_t address48 = rng.below(std::uint64_t{1} << 48U);
  switch (rng.below(3)) {
    case 0:
      return TransmitterId::wifi(address48);
    case 1:
      return TransmitterId::bluetooth(address48);
    default:
      return TransmitterId::column(address48);
  }
}

core::GeoPoint random_point(Rng& rng) {
  const double latitude_deg = rng.uniform(-90.0, 90.0);
  return {latitude_deg, rng.uniform(-180.0, 180.0)};
}

sample::WifiScan random_scan(Rng& rng) {
  sample::WifiScan scan;
  scan.time = random_time(rng);
  scan.readings.resize(rng.below(6));
  for (sample::WifiReading& reading : scan.readings) {
    const DeviceTime seen = random_time(rng);
    reading.transmitter = random_transmitter(rng);
    reading.rssi_dbm = random_level_dbm(rng);
    reading.frequency_mhz = static_cast<std::int32_t>(rng.below(7200));
    reading.last_seen = std::min(seen, scan.time);
    reading.ssid = random_octets(rng);
  }
  return scan;
}

sample::BleReading random_ble(Rng& rng) {
  sample::BleReading value;
  value.time = random_time(rng);
  value.transmitter = random_transmitter(rng);
  value.rssi_dbm = random_level_dbm(rng);
  if (rng.below(2) == 0) value.tx_power_dbm = rng.below(2) == 0 ? 0.0F : random_level_dbm(rng);
  value.beacon = random_text(rng);
  return value;
}

sample::WaypointSample random_waypoint(Rng& rng) {
  sample::WaypointSample value;
  value.time = random_time(rng);
  if (rng.below(2) == 0) {
    constexpr double kSite_m = 2000.0;
    const double x_m = random_number(rng, kSite_m);
    value.position_m = Vector2(x_m, random_number(rng, kSite_m));
  } else {
    value.geo_position = random_point(rng);
  }
  value.floor = random_text(rng);
  return value;
}

sample::RotationSample random_rotation(Rng& rng) {
  const Vector3 axis = Vector3(rng.normal(), rng.normal(), rng.normal()).normalized();
  const Eigen::AngleAxisd turn(rng.uniform(-3.0, 3.0), axis);
  return {random_time(rng), core::Quaternion(turn)};
}

}  // namespace

sample::RecordingInfo sample_recording_info() {
  using namespace std::chrono_literals;
  return {"Acme", "Pocket 3", "Main Building", "F2", core::UtcTime(1'700'000'000'123'456'789ns)};
}

std::vector<sample::Sample> one_of_each() {
  constexpr std::int64_t kMs = 1'000'000;
  const DeviceTime delivery = at_ns(5000 * kMs + 1);
  return {
      sample::AccelerometerSample{at_ns(1000 * kMs), {0.25, -1.5, 9.75}},
      sample::GyroscopeSample{at_ns(1001 * kMs), {0.125, -0.0625, 2.0}},
      sample::MagnetometerSample{at_ns(1002 * kMs), {18.5, -4.25, -41.0}, 3},
      sample::UncalibratedAccelerometerSample{
          at_ns(1003 * kMs), {0.5, -1.25, 9.5}, {0.03125, 0.0, -0.25}},
      sample::UncalibratedGyroscopeSample{
          at_ns(1004 * kMs), {0.375, -0.5, 1.0}, {0.015625, -0.03125, 0.0}},
      sample::UncalibratedMagnetometerSample{
          at_ns(1005 * kMs), {120.5, 33.0, -80.25}, {102.0, 37.25, -39.25}},
      sample::RotationSample{at_ns(1006 * kMs), {0.5, -0.5, 0.5, -0.5}},
      sample::BarometerSample{at_ns(1007 * kMs), 1013.25},
      sample::WifiScan{
          delivery,
          {{TransmitterId::wifi(0x02'1A'11'F0'00'07), -47.5F, 2437, at_ns(4200 * kMs), "guest"},
           {TransmitterId::wifi(0xA4'5E'60'C0'FF'EE), -81.0F, 5180, delivery, ""}}},
      sample::BleReading{at_ns(5001 * kMs), TransmitterId::bluetooth(0xC0'FF'EE'12'34'56), -63.0F,
                         -59.0F, "f7826da6-4fa2-4e98-8024-bc5b71e0893e/1/65535"},
      sample::GnssSample{at_ns(5002 * kMs), {31.25, 121.5}, 12.5},
      sample::WaypointSample{at_ns(-7), Vector2(-3.5, 12.25), std::nullopt, "F2"},
      sample::WaypointSample{at_ns(6000 * kMs), std::nullopt, core::GeoPoint{-33.875, 151.25}, ""},
  };
}

sample::Sample random_sample(Rng& rng, std::size_t kind) {
  switch (kind) {
    case 0:
      return sample::AccelerometerSample{random_time(rng), random_vector(rng, kForce_mps2)};
    case 1:
      return sample::GyroscopeSample{random_time(rng), random_vector(rng, kRate_radps)};
    case 2:
      return sample::MagnetometerSample{
          random_time(rng), random_vector(rng, kField_ut),
          static_cast<std::int8_t>(static_cast<int>(rng.below(5)) - 1)};
    case 3:
      return sample::UncalibratedAccelerometerSample{
          random_time(rng), random_vector(rng, kForce_mps2), random_vector(rng, kForce_mps2)};
    case 4:
      return sample::UncalibratedGyroscopeSample{random_time(rng), random_vector(rng, kRate_radps),
                                                 random_vector(rng, kRate_radps)};
    case 5:
      return sample::UncalibratedMagnetometerSample{random_time(rng), random_vector(rng, kField_ut),
                                                    random_vector(rng, kField_ut)};
    case 6:
      return random_rotation(rng);
    case 7:
      return sample::BarometerSample{random_time(rng), rng.uniform(300.0, 1100.0)};
    case 8:
      return random_scan(rng);
    case 9:
      return random_ble(rng);
    case 10:
      return sample::GnssSample{random_time(rng), random_point(rng), rng.uniform(0.0, 500.0)};
    default:
      return random_waypoint(rng);
  }
}

std::vector<sample::Sample> random_samples(Rng& rng, std::size_t count) {
  std::vector<sample::Sample> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples.push_back(random_sample(rng, rng.below(std::variant_size_v<sample::Sample>)));
  }
  return samples;
}

}  // namespace waylode::log::test
