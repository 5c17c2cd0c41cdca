// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "waylode/log/detail/line_splitter.hpp"
#include "waylode/log/detail/reasons.hpp"
#include "waylode/log/detail/tally.hpp"
#include "waylode/log/log_reader.hpp"

namespace waylode::log::detail {

/// What the formats of one record per line have in common: lines, records run together (a lost line
/// end), Wi-Fi rows gathered into scans, counts, and the last line of a file that ends too early.
///
/// A scan leaves the decoder when a row of another time comes, or a record more than 200 ms later.
class TextDecoder : public Decoder {
 public:
  void feed(std::string_view bytes) final;
  void finish() final;
  /// Counts are written by finish().
  const LogReport& report() const final { return report_; }

 protected:
  TextDecoder(LogFormat format, char header_mark, SampleSink sink);

  /// nullptr when the record was taken or is of a kind we do not use; else why it is bad, and then
  /// nothing has changed.
  virtual Complaint take_record(std::string_view line) = 0;
  virtual void take_header(std::string_view line) = 0;
  /// Where another record starts inside a record's or header's line; npos if nowhere.
  virtual std::size_t find_run_on(std::string_view line) const = 0;
  /// The last field cannot be the front part of a longer one, so that the line needs no end.
  virtual bool is_whole(std::string_view line) const = 0;

  void emit(sample::Sample&& sample);
  void add_to_scan(core::DeviceTime delivery, sample::WifiReading&& reading);
  void ignore(std::string_view kind) { tally_.ignore(kind); }
  sample::RecordingInfo& info() { return report_.info; }

 private:
  void take_line(std::string_view line);
  void take_run_on(std::string_view line);
  void emit_scan();

  char header_mark_;
  SampleSink sink_;
  LogReport report_;
  Tally tally_;
  LineSplitter lines_;
  sample::WifiScan scan_;  ///< Open while it has readings.
};

/// Keeps the first value told.
inline void tell(std::string& field, std::string_view value) {
  if (field.empty()) field = value;
}

}  // namespace waylode::log::detail
