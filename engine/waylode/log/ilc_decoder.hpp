// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "waylode/log/detail/line_splitter.hpp"
#include "waylode/log/detail/tally.hpp"
#include "waylode/log/log_reader.hpp"

namespace waylode::log {

/// Logs of the Microsoft Indoor Location Competition 2.0: lines `time_ms TYPE_X value ...` parted
/// by tabs, header lines `# key:value ...`.
///
/// One clock, Unix milliseconds, serves as device time. The Wi-Fi rows of one delivery share a time
/// and make one WifiScan, which leaves the decoder when a row of another time comes or a record
/// more than 200 ms later. An iBeacon's UUID is written in lower case; a transmit power of 0, which
/// beacons use for "unknown", is not told. A line that holds two records (a lost line end) is split
/// where a 13-digit time and "\tTYPE_" show the second one. The last line of a file without line
/// end counts only if its last field cannot have been cut short.
class IlcDecoder final : public Decoder {
 public:
  explicit IlcDecoder(SampleSink sink);

  void feed(std::string_view bytes) override;
  void finish() override;
  /// Counts are written by finish().
  const LogReport& report() const override { return report_; }

 private:
  /// nullptr when the record was taken or is of a kind we do not use, else why it is bad; then
  /// nothing has changed. The same holds for the take_ functions below.
  using Complaint = const char*;

  void take_line(std::string_view line);
  /// `line` starts with a record that stood behind another.
  void take_run_on(std::string_view line);
  void take_header(std::string_view line);
  Complaint take_record(std::string_view line);
  Complaint take_typed(std::string_view type, core::DeviceTime time, std::string_view line);
  Complaint take_wifi(core::DeviceTime time, std::string_view line);
  void emit(sample::Sample&& sample);
  void emit_scan();

  SampleSink sink_;
  LogReport report_;
  detail::Tally tally_;
  detail::LineSplitter lines_;
  sample::WifiScan scan_;  ///< Open while it has readings.
};

}  // namespace waylode::log
