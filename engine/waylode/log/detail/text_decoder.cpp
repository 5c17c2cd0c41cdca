// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/text_decoder.hpp"

#include <chrono>
#include <string>
#include <utility>

namespace waylode::log::detail {
namespace {

constexpr core::Duration kScanCloses = std::chrono::milliseconds(200);

}  // namespace

TextDecoder::TextDecoder(LogFormat format, char header_mark, SampleSink sink)
    : header_mark_(header_mark), sink_(std::move(sink)) {
  report_.format = format;
}

void TextDecoder::feed(std::string_view bytes) {
  report_.bytes_read += bytes.size();
  lines_.feed(
      bytes, [this](std::string_view line) { take_line(line); },
      [this] { tally_.reject(kLineTooLong); });
}

void TextDecoder::finish() {
  const std::string_view rest = lines_.unended();
  if (rest.starts_with(header_mark_)) {
    take_header(rest);
  } else if (!rest.empty() && (!is_whole(rest) || take_record(rest) != nullptr)) {
    report_.truncated = "the last line, at byte " +
                        std::to_string(report_.bytes_read - rest.size()) + ", is cut short";
  }
  emit_scan();
  tally_.write_to(report_);
}

void TextDecoder::take_line(std::string_view line) {
  if (line.empty()) return;
  const bool is_header = line.front() == header_mark_;
  const Complaint complaint = is_header ? nullptr : take_record(line);
  if (!is_header && complaint == nullptr) return;
  const std::size_t cut = find_run_on(line);
  if (is_header) {
    take_header(line.substr(0, cut));
  } else if (cut == std::string_view::npos) {
    tally_.reject(complaint);
  } else if (const Complaint first = take_record(line.substr(0, cut))) {
    tally_.reject(first);
  }
  if (cut != std::string_view::npos) take_run_on(line.substr(cut));
}

/// `line` starts with a record that stood behind another.
void TextDecoder::take_run_on(std::string_view line) {
  while (true) {
    const std::size_t cut = find_run_on(line);
    if (const Complaint complaint = take_record(line.substr(0, cut))) {
      tally_.reject(complaint);
    } else {
      ++report_.recovered_run_on;
    }
    if (cut == std::string_view::npos) return;
    line.remove_prefix(cut);
  }
}

void TextDecoder::emit(sample::Sample&& sample) {
  if (!scan_.readings.empty() && sample::time_of(sample) > scan_.time + kScanCloses) emit_scan();
  tally_.accept(sample.index());
  sink_(std::move(sample));
}

void TextDecoder::add_to_scan(core::DeviceTime delivery, sample::WifiReading&& reading) {
  if (delivery != scan_.time) emit_scan();
  scan_.time = delivery;
  scan_.readings.push_back(std::move(reading));
}

void TextDecoder::emit_scan() {
  if (scan_.readings.empty()) return;
  sample::Sample scan = std::exchange(scan_, {});
  tally_.accept(scan.index());
  sink_(std::move(scan));
}

}  // namespace waylode::log::detail
