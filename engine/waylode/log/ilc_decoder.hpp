// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "waylode/log/log_reader.hpp"

namespace waylode::log {

/// Logs of the Microsoft Indoor Location Competition 2.0: lines `time_ms TYPE_X value ...` parted
/// by tabs, header lines `# key:value ...`.
///
/// One clock, Unix milliseconds, serves as device time. The Wi-Fi rows of one delivery share a time
/// and make one WifiScan, which leaves the decoder when a row of another time comes or a record
/// more than 200 ms later. An iBeacon's UUID is written in lower case; a transmit power of 0 or
/// more is not told (beacons and loggers write such for "unknown"). A line that holds two records
/// (a lost line end) is split where a 13-digit time and "\tTYPE_" show the second one. The last
/// line of a file without line end counts only if its last field cannot have been cut short.
std::unique_ptr<Decoder> make_ilc_decoder(SampleSink sink);

}  // namespace waylode::log
