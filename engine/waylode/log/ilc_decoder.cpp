// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/ilc_decoder.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "waylode/log/detail/fields.hpp"
#include "waylode/log/detail/ilc_records.hpp"
#include "waylode/log/detail/limits.hpp"
#include "waylode/log/detail/reasons.hpp"

namespace waylode::log {
namespace {

constexpr core::Duration kScanCloses = std::chrono::milliseconds(200);
constexpr std::string_view kTypePrefix = "TYPE_";
constexpr std::size_t kMaxTypeLength = 64;

bool is_type_name(std::string_view type) {
  return type.starts_with(kTypePrefix) && type.size() > kTypePrefix.size() &&
         type.size() <= kMaxTypeLength && std::all_of(type.begin(), type.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// Keeps the first value told.
void tell(std::string& field, std::string_view value) {
  if (field.empty()) field = value;
}

void tell_start(std::optional<core::UtcTime>& start, std::string_view value) {
  const auto time_ms = detail::parse_integer<std::int64_t>(value);
  if (start || !time_ms || *time_ms < 0 || *time_ms > detail::kMaxTime_ms) return;
  start = core::UtcTime(std::chrono::milliseconds(*time_ms));
}

}  // namespace

IlcDecoder::IlcDecoder(SampleSink sink) : sink_(std::move(sink)) {
  report_.format = LogFormat::kIlc;
}

void IlcDecoder::feed(std::string_view bytes) {
  report_.bytes_read += bytes.size();
  lines_.feed(
      bytes, [this](std::string_view line) { take_line(line); },
      [this] { tally_.reject(detail::kLineTooLong); });
}

void IlcDecoder::finish() {
  const std::string_view rest = lines_.unended();
  if (rest.starts_with('#')) {
    take_header(rest);
  } else if (!rest.empty() && (!detail::is_whole_ilc_line(rest) || take_record(rest) != nullptr)) {
    report_.truncated = "the last line, at byte " +
                        std::to_string(report_.bytes_read - rest.size()) + ", is cut short";
  }
  emit_scan();
  tally_.write_to(report_);
}

void IlcDecoder::take_line(std::string_view line) {
  if (line.empty()) return;
  const bool is_header = line.front() == '#';
  const Complaint complaint = is_header ? nullptr : take_record(line);
  if (!is_header && complaint == nullptr) return;
  const std::size_t cut = detail::find_run_on_ilc_record(line);
  if (is_header) {
    take_header(line.substr(0, cut));
  } else if (cut == std::string_view::npos) {
    tally_.reject(complaint);
  } else if (const Complaint first = take_record(line.substr(0, cut))) {
    tally_.reject(first);
  }
  if (cut != std::string_view::npos) take_run_on(line.substr(cut));
}

void IlcDecoder::take_run_on(std::string_view line) {
  while (true) {
    const std::size_t cut = detail::find_run_on_ilc_record(line);
    if (const Complaint complaint = take_record(line.substr(0, cut))) {
      tally_.reject(complaint);
    } else {
      ++report_.recovered_run_on;
    }
    if (cut == std::string_view::npos) return;
    line.remove_prefix(cut);
  }
}

void IlcDecoder::take_header(std::string_view line) {
  while (!line.empty()) {
    const std::size_t end = std::min(line.find('\t'), line.size());
    const std::string_view field = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    const std::size_t colon = field.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view key = field.substr(0, colon);
    const std::string_view value = field.substr(colon + 1);
    if (key == "startTime") tell_start(report_.info.start_utc, value);
    if (key == "SiteName") tell(report_.info.site, value);
    if (key == "FloorName") tell(report_.info.floor, value);
    if (key == "Brand") tell(report_.info.device_brand, value);
    if (key == "Model") tell(report_.info.device_model, value);
  }
}

IlcDecoder::Complaint IlcDecoder::take_record(std::string_view line) {
  const std::size_t time_end = line.find('\t');
  if (time_end == std::string_view::npos) return detail::kNotARecord;
  const std::size_t type_end = std::min(line.find('\t', time_end + 1), line.size());
  const std::string_view type = line.substr(time_end + 1, type_end - time_end - 1);
  if (!type.starts_with(kTypePrefix)) return detail::kNotARecord;
  const auto time = detail::parse_ilc_time(line.substr(0, time_end));
  if (!time) return detail::kBadTime;
  return take_typed(type, *time, line);
}

IlcDecoder::Complaint IlcDecoder::take_typed(std::string_view type, core::DeviceTime time,
                                             std::string_view line) {
  const auto take = [&]<typename Sample>(Complaint (*parse)(std::string_view, Sample&)) {
    Sample sample{};
    sample.time = time;
    const Complaint complaint = parse(line, sample);
    if (complaint == nullptr) emit(std::move(sample));
    return complaint;
  };
  if (type == "TYPE_WIFI") return take_wifi(time, line);
  if (type == "TYPE_ACCELEROMETER") return take(detail::parse_ilc_accelerometer);
  if (type == "TYPE_GYROSCOPE") return take(detail::parse_ilc_gyroscope);
  if (type == "TYPE_MAGNETIC_FIELD") return take(detail::parse_ilc_magnetometer);
  if (type == "TYPE_ROTATION_VECTOR") return take(detail::parse_ilc_rotation);
  if (type == "TYPE_ACCELEROMETER_UNCALIBRATED") {
    return take(detail::parse_ilc_uncalibrated_accelerometer);
  }
  if (type == "TYPE_GYROSCOPE_UNCALIBRATED") return take(detail::parse_ilc_uncalibrated_gyroscope);
  if (type == "TYPE_MAGNETIC_FIELD_UNCALIBRATED") {
    return take(detail::parse_ilc_uncalibrated_magnetometer);
  }
  if (type == "TYPE_BEACON") return take(detail::parse_ilc_beacon);
  if (type == "TYPE_WAYPOINT") return take(detail::parse_ilc_waypoint);
  if (detail::find_run_on_ilc_record(line) != std::string_view::npos) return detail::kFieldCount;
  if (!is_type_name(type)) return detail::kNotARecord;
  tally_.ignore(type);
  return nullptr;
}

IlcDecoder::Complaint IlcDecoder::take_wifi(core::DeviceTime time, std::string_view line) {
  if (detail::find_run_on_ilc_record(line) != std::string_view::npos) return detail::kFieldCount;
  sample::WifiReading reading;
  if (Complaint complaint = detail::parse_ilc_wifi(line, time, reading)) return complaint;
  if (time != scan_.time) emit_scan();
  scan_.time = time;
  scan_.readings.push_back(std::move(reading));
  return nullptr;
}

void IlcDecoder::emit(sample::Sample&& sample) {
  if (!scan_.readings.empty() && sample::time_of(sample) > scan_.time + kScanCloses) emit_scan();
  tally_.accept(sample.index());
  sink_(std::move(sample));
}

void IlcDecoder::emit_scan() {
  if (scan_.readings.empty()) return;
  sample::Sample scan = std::exchange(scan_, {});
  tally_.accept(scan.index());
  sink_(std::move(scan));
}

}  // namespace waylode::log
