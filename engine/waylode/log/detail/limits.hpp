// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "waylode/core/geometry.hpp"

/// Bounds that no phone's sensor leaves while it works; beyond them a record is damaged, not rare.
namespace waylode::log::detail {

inline constexpr double kMaxSpecificForce_mps2 = 400.0;  ///< Phones measure up to 16 g.
inline constexpr double kMaxAngularRate_radps = 100.0;   ///< Phones measure up to 2000 deg/s.
inline constexpr double kMaxField_ut = 20'000.0;  ///< Hall sensors end at 5 mT; bias beside it.
inline constexpr double kMinPressure_hpa = 300.0;
inline constexpr double kMaxPressure_hpa = 1300.0;  ///< 2 km below the sea, deeper than any mine.
inline constexpr double kMinRssi_dbm = -127.0;
inline constexpr double kMaxRssi_dbm = 20.0;
inline constexpr double kMaxCoordinate_m = 100'000.0;  ///< Floor frames start at their building.
inline constexpr std::int32_t kMaxFrequency_mhz = 100'000;
inline constexpr double kMaxGnssAccuracy_m = 1'000'000.0;
/// The last millisecond that fits a 64-bit count of nanoseconds, with a margin for sums.
inline constexpr std::int64_t kMaxTime_ms = 9'000'000'000'000;
/// Seconds since any start, or UTC until 2096; differences of two differences fit 64 bits too.
inline constexpr double kMaxTime_s = 4e9;

inline bool all_within(std::span<const double> values, double limit) {
  return std::all_of(values.begin(), values.end(),
                     [limit](double value) { return std::abs(value) <= limit; });
}

inline bool is_rssi(double value_dbm) {
  return value_dbm >= kMinRssi_dbm && value_dbm <= kMaxRssi_dbm;
}

inline bool is_pressure(double value_hpa) {
  return value_hpa >= kMinPressure_hpa && value_hpa <= kMaxPressure_hpa;
}

inline bool is_geo_point(double latitude_deg, double longitude_deg) {
  return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 180.0;
}

/// What one signed byte of an advertisement can say.
inline bool is_tx_power(double value_dbm) { return value_dbm >= -128.0 && value_dbm <= 127.0; }

/// A rotation from the vector part of its unit quaternion, the scalar part being positive (Android
/// TYPE_ROTATION_VECTOR). The length may exceed one by rounding only; else nullopt.
inline std::optional<core::Quaternion> rotation_from_vector_part(double x, double y, double z) {
  constexpr double kRoundingSlack = 1e-3;
  const double squared_scalar = 1.0 - (x * x + y * y + z * z);
  if (!(squared_scalar >= -kRoundingSlack)) return std::nullopt;
  return core::Quaternion(std::sqrt(std::max(0.0, squared_scalar)), x, y, z).normalized();
}

}  // namespace waylode::log::detail
