// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/getsensordata_decoder.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "waylode/log/detail/capture_clock.hpp"
#include "waylode/log/detail/getsensordata_records.hpp"
#include "waylode/log/detail/text_decoder.hpp"

namespace waylode::log {
namespace {

using detail::Complaint;

/// Phones hand out cached scan results of some minutes; an older date is on another clock.
constexpr core::Duration kMaxReadingAge = std::chrono::minutes(10);
/// How far a capture may seem to follow its delivery: the error of the clocks' offset.
constexpr core::Duration kClockSlack = std::chrono::milliseconds(500);
/// 2001: a smaller GNSS time is no UTC.
constexpr core::Duration kFirstUtc = std::chrono::seconds(978'307'200);

/// The fields that all records with two clocks share.
struct Stamp {
  core::DeviceTime arrival;
  core::Duration capture{};  ///< 0: not told.
};

/// Text behind "% Key:", blanks off; empty if the line is another one.
std::string_view comment_value(std::string_view line, std::string_view key) {
  constexpr std::string_view kBlanks = " \t";
  if (!line.starts_with(key)) return {};
  line.remove_prefix(key.size());
  const std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(kBlanks) + 1 - begin);
}

class GetSensorDataDecoder final : public detail::TextDecoder {
 public:
  explicit GetSensorDataDecoder(SampleSink sink)
      : TextDecoder(LogFormat::kGetSensorData, '%', std::move(sink)) {}

 private:
  Complaint take_record(std::string_view line) override;
  void take_header(std::string_view line) override;
  std::size_t find_run_on(std::string_view line) const override {
    return detail::find_run_on_getsensordata_record(line);
  }
  bool is_whole(std::string_view line) const override {
    return detail::is_whole_getsensordata_line(line);
  }

  template <typename Sample>
  Complaint take_sensor(std::string_view line, detail::CaptureClock& clock,
                        Complaint (*parse)(std::string_view, Sample&));
  template <typename Sample>
  Complaint take_arrival(std::string_view line, Complaint (*parse)(std::string_view, Sample&));
  Complaint take_wifi(std::string_view line);
  Complaint take_gnss(std::string_view line);
  core::DeviceTime last_seen(const Stamp& stamp) const;

  detail::CaptureClock accelerometer_clock_;
  detail::CaptureClock gyroscope_clock_;
  detail::CaptureClock magnetometer_clock_;
  detail::CaptureClock rotation_clock_;
  detail::CaptureClock barometer_clock_;
};

std::optional<core::DeviceTime> read_arrival(std::string_view line) {
  line.remove_prefix(5);
  const auto arrival = detail::parse_seconds(line.substr(0, line.find(';')));
  if (!arrival) return std::nullopt;
  return core::DeviceTime(*arrival);
}

std::optional<Stamp> read_stamp(std::string_view line) {
  const auto arrival = read_arrival(line);
  line.remove_prefix(std::min(line.find(';', 5), line.size() - 1) + 1);
  const auto capture = detail::parse_seconds(line.substr(0, line.find(';')));
  if (!arrival || !capture) return std::nullopt;
  return Stamp{*arrival, *capture};
}

void GetSensorDataDecoder::take_header(std::string_view line) {
  detail::tell(info().device_brand, comment_value(line, "% Manufacturer:"));
  detail::tell(info().device_model, comment_value(line, "% Model:"));
}

Complaint GetSensorDataDecoder::take_record(std::string_view line) {
  const std::string_view type = line.substr(0, line.find(';'));
  if (type.size() == line.size() || !detail::is_getsensordata_type(type)) {
    return detail::kNotARecord;
  }
  if (type == "ACCE") return take_sensor(line, accelerometer_clock_, detail::parse_acce);
  if (type == "GYRO") return take_sensor(line, gyroscope_clock_, detail::parse_gyro);
  if (type == "MAGN") return take_sensor(line, magnetometer_clock_, detail::parse_magn);
  if (type == "AHRS") return take_sensor(line, rotation_clock_, detail::parse_ahrs);
  if (type == "PRES") return take_sensor(line, barometer_clock_, detail::parse_pres);
  if (type == "WIFI") return take_wifi(line);
  if (type == "BLE4") return take_arrival(line, detail::parse_ble4);
  if (type == "POSI") return take_arrival(line, detail::parse_posi);
  if (type == "GNSS") return take_gnss(line);
  if (find_run_on(line) != std::string_view::npos) return detail::kFieldCount;
  ignore(type);
  return nullptr;
}

template <typename Sample>
Complaint GetSensorDataDecoder::take_sensor(std::string_view line, detail::CaptureClock& clock,
                                            Complaint (*parse)(std::string_view, Sample&)) {
  const auto stamp = read_stamp(line);
  if (!stamp) return detail::kBadTime;
  Sample sample{};
  if (Complaint complaint = parse(line, sample)) return complaint;
  const bool is_told = stamp->capture > core::Duration::zero();
  sample.time = is_told ? clock.map(stamp->arrival, stamp->capture) : stamp->arrival;
  emit(std::move(sample));
  return nullptr;
}

template <typename Sample>
Complaint GetSensorDataDecoder::take_arrival(std::string_view line,
                                             Complaint (*parse)(std::string_view, Sample&)) {
  const auto arrival = read_arrival(line);
  if (!arrival) return detail::kBadTime;
  Sample sample{};
  sample.time = *arrival;
  if (Complaint complaint = parse(line, sample)) return complaint;
  emit(std::move(sample));
  return nullptr;
}

/// A name may hold anything, so a second record on the line must be looked for first.
Complaint GetSensorDataDecoder::take_wifi(std::string_view line) {
  if (find_run_on(line) != std::string_view::npos) return detail::kFieldCount;
  const auto stamp = read_stamp(line);
  if (!stamp) return detail::kBadTime;
  sample::WifiReading reading;
  if (Complaint complaint = detail::parse_wifi(line, reading)) return complaint;
  reading.last_seen = last_seen(*stamp);
  add_to_scan(stamp->arrival, std::move(reading));
  return nullptr;
}

core::DeviceTime GetSensorDataDecoder::last_seen(const Stamp& stamp) const {
  const auto seen = accelerometer_clock_.look_up(stamp.capture);
  if (stamp.capture == core::Duration::zero() || !seen) return stamp.arrival;
  if (*seen > stamp.arrival + kClockSlack || *seen < stamp.arrival - kMaxReadingAge) {
    return stamp.arrival;
  }
  return std::min(*seen, stamp.arrival);
}

Complaint GetSensorDataDecoder::take_gnss(std::string_view line) {
  const auto stamp = read_stamp(line);
  if (!stamp) return detail::kBadTime;
  if (Complaint complaint = take_arrival(line, detail::parse_gnss)) return complaint;
  if (!info().start_utc && stamp->capture > kFirstUtc) {
    info().start_utc = core::UtcTime(stamp->capture - stamp->arrival.time_since_epoch());
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<Decoder> make_getsensordata_decoder(SampleSink sink) {
  return std::make_unique<GetSensorDataDecoder>(std::move(sink));
}

}  // namespace waylode::log
