// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "waylode/log/log_reader.hpp"

namespace waylode::log {

/// Logs of the Android program GetSensorData (IPIN competitions, Track 3): lines `TYPE;value;...`,
/// comments after `%`.
///
/// Times. AppTimestamp, the arrival in seconds since the log's start, is device time: truth (POSI),
/// Wi-Fi, BLE and GNSS have no better one. A motion, magnetic or pressure record is dated by its
/// SensorTimestamp (capture, seconds since the phone's boot), moved to device time by the smallest
/// (arrival - capture) of its sensor so far: intervals are the sensor's own, the offset is causal,
/// a step of the capture clock is survived. Without SensorTimestamp the arrival counts.
///
/// The Wi-Fi rows of one AppTimestamp make one WifiScan. A row's last_seen is its SensorTimestamp,
/// which shares the motion sensors' clock, if that falls within the 10 minutes before the delivery;
/// else the delivery. Rows with and without the frequency column are known; a network's name may
/// hold semicolons.
///
/// AHRS holds Android's rotation vector (checked: it reproduces the record's own pitch, roll and
/// yaw = -azimuth). A transmit power of 0 or more, an empty UUID: not told. Start in UTC: time of
/// the first GNSS record less its arrival. Light, proximity, sound and the like are ignored.
std::unique_ptr<Decoder> make_getsensordata_decoder(SampleSink sink);

}  // namespace waylode::log
