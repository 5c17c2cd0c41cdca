// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "waylode/log/detail/reasons.hpp"
#include "waylode/sample/sample.hpp"

/// Single lines of an ILC log. Every parser gets the whole line, returns nullptr and fills its
/// second argument, or returns the reason why the record is bad.
namespace waylode::log::detail {

/// The line's first field, Unix milliseconds.
std::optional<core::DeviceTime> parse_ilc_time(std::string_view text);

Complaint parse_ilc_accelerometer(std::string_view line, sample::AccelerometerSample& sample);
Complaint parse_ilc_gyroscope(std::string_view line, sample::GyroscopeSample& sample);
Complaint parse_ilc_magnetometer(std::string_view line, sample::MagnetometerSample& sample);
Complaint parse_ilc_rotation(std::string_view line, sample::RotationSample& sample);
Complaint parse_ilc_uncalibrated_accelerometer(std::string_view line,
                                               sample::UncalibratedAccelerometerSample& sample);
Complaint parse_ilc_uncalibrated_gyroscope(std::string_view line,
                                           sample::UncalibratedGyroscopeSample& sample);
Complaint parse_ilc_uncalibrated_magnetometer(std::string_view line,
                                              sample::UncalibratedMagnetometerSample& sample);
Complaint parse_ilc_waypoint(std::string_view line, sample::WaypointSample& sample);
/// A network's name may hold tabs: the other fields are counted from the end of the line.
Complaint parse_ilc_wifi(std::string_view line, core::DeviceTime delivery,
                         sample::WifiReading& reading);
Complaint parse_ilc_beacon(std::string_view line, sample::BleReading& reading);

/// Where another record starts inside a record's or header's line; npos if nowhere.
std::size_t find_run_on_ilc_record(std::string_view line);

/// The last field cannot be the front part of a longer one, so that the line needs no end.
bool is_whole_ilc_line(std::string_view line);

}  // namespace waylode::log::detail
