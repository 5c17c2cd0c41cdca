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
#include "waylode/log/detail/text_decoder.hpp"

namespace waylode::log {
namespace {

using detail::Complaint;

constexpr std::string_view kTypePrefix = "TYPE_";
constexpr std::size_t kMaxTypeLength = 64;

bool is_type_name(std::string_view type) {
  return type.starts_with(kTypePrefix) && type.size() > kTypePrefix.size() &&
         type.size() <= kMaxTypeLength && std::all_of(type.begin(), type.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
         });
}

void tell_start(std::optional<core::UtcTime>& start, std::string_view value) {
  const auto time_ms = detail::parse_integer<std::int64_t>(value);
  if (start || !time_ms || *time_ms < 0 || *time_ms > detail::kMaxTime_ms) return;
  start = core::UtcTime(std::chrono::milliseconds(*time_ms));
}

class IlcDecoder final : public detail::TextDecoder {
 public:
  explicit IlcDecoder(SampleSink sink) : TextDecoder(LogFormat::kIlc, '#', std::move(sink)) {}

 private:
  Complaint take_record(std::string_view line) override;
  void take_header(std::string_view line) override;
  std::size_t find_run_on(std::string_view line) const override {
    return detail::find_run_on_ilc_record(line);
  }
  bool is_whole(std::string_view line) const override { return detail::is_whole_ilc_line(line); }

  Complaint take_typed(std::string_view type, core::DeviceTime time, std::string_view line);
  Complaint take_wifi(core::DeviceTime time, std::string_view line);
  Complaint take_other(std::string_view type, std::string_view line);
};

void IlcDecoder::take_header(std::string_view line) {
  while (!line.empty()) {
    const std::size_t end = std::min(line.find('\t'), line.size());
    const std::string_view field = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    const std::size_t colon = field.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view key = field.substr(0, colon);
    const std::string_view value = field.substr(colon + 1);
    if (key == "startTime") tell_start(info().start_utc, value);
    if (key == "SiteName") detail::tell(info().site, value);
    if (key == "FloorName") detail::tell(info().floor, value);
    if (key == "Brand") detail::tell(info().device_brand, value);
    if (key == "Model") detail::tell(info().device_model, value);
  }
}

Complaint IlcDecoder::take_record(std::string_view line) {
  const std::size_t time_end = line.find('\t');
  if (time_end == std::string_view::npos) return detail::kNotARecord;
  const std::size_t type_end = std::min(line.find('\t', time_end + 1), line.size());
  const std::string_view type = line.substr(time_end + 1, type_end - time_end - 1);
  if (!type.starts_with(kTypePrefix)) return detail::kNotARecord;
  const auto time = detail::parse_ilc_time(line.substr(0, time_end));
  if (!time) return detail::kBadTime;
  return take_typed(type, *time, line);
}

Complaint IlcDecoder::take_typed(std::string_view type, core::DeviceTime time,
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
  return take_other(type, line);
}

/// A name may hold anything, so a second record on the line must be looked for first.
Complaint IlcDecoder::take_wifi(core::DeviceTime time, std::string_view line) {
  if (find_run_on(line) != std::string_view::npos) return detail::kFieldCount;
  sample::WifiReading reading;
  if (Complaint complaint = detail::parse_ilc_wifi(line, time, reading)) return complaint;
  add_to_scan(time, std::move(reading));
  return nullptr;
}

Complaint IlcDecoder::take_other(std::string_view type, std::string_view line) {
  if (find_run_on(line) != std::string_view::npos) return detail::kFieldCount;
  if (!is_type_name(type)) return detail::kNotARecord;
  ignore(type);
  return nullptr;
}

}  // namespace

std::unique_ptr<Decoder> make_ilc_decoder(SampleSink sink) {
  return std::make_unique<IlcDecoder>(std::move(sink));
}

}  // namespace waylode::log
