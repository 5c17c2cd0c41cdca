// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "waylode/log/detail/limits.hpp"
#include "waylode/log/detail/reasons.hpp"
#include "waylode/log/detail/sample_codec.hpp"
#include "waylode/log/detail/utf8.hpp"

namespace waylode::log::detail {
namespace {

using core::GeoPoint;
using core::TransmitterId;
using core::Vector3;

constexpr const char* kNotFinite = "not_finite";
constexpr const char* kBadTransmitter = "bad_transmitter";
constexpr const char* kBadText = "bad_text";

/// The first complaint of several.
template <typename... Faults>
const char* first_of(Faults... faults) {
  const char* first = nullptr;
  ((first = first != nullptr ? first : faults), ...);
  return first;
}

const char* range_fault(bool in_range) { return in_range ? nullptr : kOutOfRange; }

/// Every value within [-limit, limit].
template <typename... Values>
const char* limit_fault(double limit, const Values&... values) {
  if (!(std::isfinite(values) && ...)) return kNotFinite;
  return range_fault(((std::abs(values) <= limit) && ...));
}
const char* vector_fault(const Vector3& vector, double limit) {
  return limit_fault(limit, vector.x(), vector.y(), vector.z());
}
const char* rssi_fault(float level_dbm) {
  return std::isfinite(level_dbm) ? range_fault(is_rssi(level_dbm)) : kNotFinite;
}

const char* tx_power_fault(const std::optional<float>& level_dbm) {
  if (!level_dbm) return nullptr;
  return std::isfinite(*level_dbm) ? range_fault(is_tx_power(*level_dbm)) : kNotFinite;
}

const char* geo_fault(const GeoPoint& point) {
  constexpr double kPole_deg = 90.0;
  constexpr double kDateLine_deg = 180.0;
  return first_of(limit_fault(kPole_deg, point.latitude_deg),
                  limit_fault(kDateLine_deg, point.longitude_deg));
}

const char* transmitter_fault(TransmitterId id) {
  constexpr std::uint64_t kUnusedBits = 0x00FF'0000'0000'0000ULL;
  const bool known = id.kind() <= TransmitterId::Kind::kColumn && (id.packed() & kUnusedBits) == 0;
  return known ? nullptr : kBadTransmitter;
}

const char* fault(const sample::AccelerometerSample& value) {
  return vector_fault(value.specific_force_mps2, kMaxSpecificForce_mps2);
}
const char* fault(const sample::GyroscopeSample& value) {
  return vector_fault(value.angular_rate_radps, kMaxAngularRate_radps);
}
const char* fault(const sample::MagnetometerSample& value) {
  return first_of(vector_fault(value.field_ut, kMaxField_ut),
                  range_fault(value.accuracy >= -1 && value.accuracy <= 3));
}
const char* fault(const sample::UncalibratedAccelerometerSample& value) {
  return first_of(vector_fault(value.specific_force_mps2, kMaxSpecificForce_mps2),
                  vector_fault(value.bias_mps2, kMaxSpecificForce_mps2));
}
const char* fault(const sample::UncalibratedGyroscopeSample& value) {
  return first_of(vector_fault(value.angular_rate_radps, kMaxAngularRate_radps),
                  vector_fault(value.bias_radps, kMaxAngularRate_radps));
}
const char* fault(const sample::UncalibratedMagnetometerSample& value) {
  return first_of(vector_fault(value.field_ut, kMaxField_ut),
                  vector_fault(value.bias_ut, kMaxField_ut));
}

const char* fault(const sample::RotationSample& value) {
  // A unit quaternion in double precision, as every decoder makes it.
  constexpr double kNormTolerance = 1e-9;
  const core::Quaternion& turn = value.enu_from_device;
  return first_of(limit_fault(1.0 + kNormTolerance, turn.w(), turn.x(), turn.y(), turn.z()),
                  range_fault(std::abs(turn.norm() - 1.0) <= kNormTolerance));
}

const char* fault(const sample::BarometerSample& value) {
  return first_of(limit_fault(kMaxPressure_hpa, value.pressure_hpa),
                  range_fault(value.pressure_hpa >= kMinPressure_hpa));
}

const char* fault(const sample::WifiScan& scan) {
  for (const sample::WifiReading& reading : scan.readings) {
    const char* found = first_of(
        rssi_fault(reading.rssi_dbm), transmitter_fault(reading.transmitter),
        range_fault(reading.frequency_mhz >= 0 && reading.frequency_mhz <= kMaxFrequency_mhz),
        reading.last_seen <= scan.time ? nullptr : kSeenAfterDelivery);
    if (found != nullptr) return found;
  }
  return nullptr;
}

const char* fault(const sample::BleReading& value) {
  return first_of(rssi_fault(value.rssi_dbm), tx_power_fault(value.tx_power_dbm),
                  transmitter_fault(value.transmitter), is_utf8(value.beacon) ? nullptr : kBadText);
}

const char* fault(const sample::GnssSample& value) {
  return first_of(geo_fault(value.position), limit_fault(kMaxGnssAccuracy_m, value.accuracy_m),
                  range_fault(value.accuracy_m >= 0.0));
}

const char* fault(const sample::WaypointSample& value) {
  return first_of(range_fault(value.position_m.has_value() != value.geo_position.has_value()),
                  value.position_m
                      ? limit_fault(kMaxCoordinate_m, value.position_m->x(), value.position_m->y())
                      : nullptr,
                  value.geo_position ? geo_fault(*value.geo_position) : nullptr,
                  is_utf8(value.floor) ? nullptr : kBadText);
}

}  // namespace

const char* fault_of(const sample::Sample& sample) {
  return std::visit([](const auto& value) { return fault(value); }, sample);
}

}  // namespace waylode::log::detail
