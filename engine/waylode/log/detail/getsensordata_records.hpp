// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "waylode/log/detail/reasons.hpp"
#include "waylode/sample/sample.hpp"

/// Single lines of a GetSensorData log. Every parser gets the whole line, returns nullptr and fills
/// its second argument (but for the time), or returns the reason why the record is bad.
namespace waylode::log::detail {

Complaint parse_acce(std::string_view line, sample::AccelerometerSample& sample);
Complaint parse_gyro(std::string_view line, sample::GyroscopeSample& sample);
Complaint parse_magn(std::string_view line, sample::MagnetometerSample& sample);
Complaint parse_ahrs(std::string_view line, sample::RotationSample& sample);
Complaint parse_pres(std::string_view line, sample::BarometerSample& sample);
Complaint parse_gnss(std::string_view line, sample::GnssSample& sample);
Complaint parse_posi(std::string_view line, sample::WaypointSample& sample);
Complaint parse_ble4(std::string_view line, sample::BleReading& reading);
/// Fills everything but last_seen.
Complaint parse_wifi(std::string_view line, sample::WifiReading& reading);

/// "ACCE" and the like: the kinds that the format defines.
bool is_getsensordata_type(std::string_view type);

/// A time field in seconds, as nanoseconds since its clock's zero.
std::optional<core::Duration> parse_seconds(std::string_view text);

/// Where a second record starts inside the line; npos if nowhere.
std::size_t find_run_on_getsensordata_record(std::string_view line);

/// The last field cannot be the front part of a longer one that matters.
bool is_whole_getsensordata_line(std::string_view line);

}  // namespace waylode::log::detail
