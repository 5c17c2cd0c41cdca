// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// mcap_interop_helper write FOLDER          ours_*.mcap of many samples, and their JSON
//                     golden FOLDER         one_of_each.mcap and .json
//                     check FOLDER          that the golden files are what we write and read
//                     compare MCAP JSON     that a file reads as its JSON says
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "waylode/core/file.hpp"
#include "waylode/log/mcap_decoder.hpp"
#include "waylode/log/mcap_writer.hpp"
#include "waylode/log/test_samples.hpp"

namespace waylode::log {
namespace {

using Json = nlohmann::ordered_json;
using core::Vector3;

std::string ns_text(core::DeviceTime time) {
  return std::to_string(time.time_since_epoch().count());
}

std::string hex(const std::string& octets) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const char octet : octets) {
    const auto value = static_cast<unsigned char>(octet);
    text += {kDigits[value >> 4U], kDigits[value & 15U]};
  }
  return text;
}

Json to_json(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

void describe(const sample::AccelerometerSample& value, Json& json) {
  json["specific_force_mps2"] = to_json(value.specific_force_mps2);
}
void describe(const sample::GyroscopeSample& value, Json& json) {
  json["angular_rate_radps"] = to_json(value.angular_rate_radps);
}
void describe(const sample::MagnetometerSample& value, Json& json) {
  json["field_ut"] = to_json(value.field_ut);
  json["accuracy"] = static_cast<int>(value.accuracy);
}
void describe(const sample::UncalibratedAccelerometerSample& value, Json& json) {
  json["specific_force_mps2"] = to_json(value.specific_force_mps2);
  json["bias_mps2"] = to_json(value.bias_mps2);
}
void describe(const sample::UncalibratedGyroscopeSample& value, Json& json) {
  json["angular_rate_radps"] = to_json(value.angular_rate_radps);
  json["bias_radps"] = to_json(value.bias_radps);
}
void describe(const sample::UncalibratedMagnetometerSample& value, Json& json) {
  json["field_ut"] = to_json(value.field_ut);
  json["bias_ut"] = to_json(value.bias_ut);
}
void describe(const sample::RotationSample& value, Json& json) {
  const core::Quaternion& turn = value.enu_from_device;
  json["enu_from_device_wxyz"] = {turn.w(), turn.x(), turn.y(), turn.z()};
}
void describe(const sample::BarometerSample& value, Json& json) {
  json["pressure_hpa"] = value.pressure_hpa;
}
void describe(const sample::WifiScan& scan, Json& json) {
  json["readings"] = Json::array();
  for (const sample::WifiReading& reading : scan.readings) {
    json["readings"].push_back({{"transmitter", core::to_string(reading.transmitter)},
                                {"rssi_dbm", reading.rssi_dbm},
                                {"frequency_mhz", reading.frequency_mhz},
                                {"last_seen_ns", ns_text(reading.last_seen)},
                                {"ssid_hex", hex(reading.ssid)}});
  }
}
void describe(const sample::BleReading& value, Json& json) {
  json["transmitter"] = core::to_string(value.transmitter);
  json["rssi_dbm"] = value.rssi_dbm;
  if (value.tx_power_dbm) json["tx_power_dbm"] = *value.tx_power_dbm;
  json["beacon"] = value.beacon;
}
void describe(const sample::GnssSample& value, Json& json) {
  json["latitude_deg"] = value.position.latitude_deg;
  json["longitude_deg"] = value.position.longitude_deg;
  json["accuracy_m"] = value.accuracy_m;
}
void describe(const sample::WaypointSample& value, Json& json) {
  if (value.position_m) json["position_m"] = {value.position_m->x(), value.position_m->y()};
  if (value.geo_position) {
    json["latitude_deg"] = value.geo_position->latitude_deg;
    json["longitude_deg"] = value.geo_position->longitude_deg;
  }
  json["floor"] = value.floor;
}

Json to_json(const sample::Sample& sample) {
  Json json = {{"kind", sample::kind_of(sample)},
               {"device_time_ns", ns_text(sample::time_of(sample))}};
  std::visit([&json](const auto& value) { describe(value, json); }, sample);
  return json;
}

Json to_json(const std::vector<sample::Sample>& samples) {
  Json json = Json::array();
  for (const sample::Sample& sample : samples) json.push_back(to_json(sample));
  return json;
}

/// One sample a line, so that a difference shows where it is.
std::string to_lines(const Json& rows) {
  std::string text = "[\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += rows[i].dump() + (i + 1 < rows.size() ? ",\n" : "\n");
  }
  return text + "]\n";
}

bool write_log(const std::filesystem::path& path, const std::vector<sample::Sample>& samples,
               const McapWriterOptions& options) {
  auto writer = McapWriter::create(path, test::sample_recording_info(), options);
  bool written = writer.has_value();
  for (const sample::Sample& sample : samples) written = written && writer->write(sample);
  return written && writer->close();
}

bool write_pair(const std::filesystem::path& stem, const std::vector<sample::Sample>& samples,
                const McapWriterOptions& options) {
  return write_log(stem.string() + ".mcap", samples, options) &&
         core::write_file_atomically(stem.string() + ".json", to_lines(to_json(samples)));
}

constexpr McapWriterOptions kGoldenOptions{McapCompression::kNone, 1U << 20U};

bool write_all(const std::filesystem::path& folder) {
  constexpr std::size_t kCount = 600;
  constexpr std::size_t kSmallChunk_bytes = 8192;
  core::Rng rng(3);
  std::vector<sample::Sample> samples = test::one_of_each();
  for (sample::Sample& sample : test::random_samples(rng, kCount)) samples.push_back(sample);
  return write_pair(folder / "ours_zstd", samples, {McapCompression::kZstd, kSmallChunk_bytes}) &&
         write_pair(folder / "ours_plain", samples, {McapCompression::kNone, kSmallChunk_bytes});
}

bool compare(const std::filesystem::path& mcap, const std::filesystem::path& expected) {
  std::vector<sample::Sample> samples;
  const auto decoder = make_mcap_decoder(
      [&samples](sample::Sample&& sample) { samples.push_back(std::move(sample)); });
  const auto bytes = core::read_file(mcap);
  const auto json = core::read_file(expected);
  if (!bytes || !json) return false;
  decoder->feed(*bytes);
  decoder->finish();
  const LogReport& report = decoder->report();
  for (const auto& [reason, count] : report.rejected) std::fprintf(stderr, "%s\n", reason.c_str());
  return report.rejected_total() == 0 && !report.truncated &&
         report.info == test::sample_recording_info() && to_lines(to_json(samples)) == *json;
}

bool check_golden(const std::filesystem::path& folder) {
  const auto written = folder / "one_of_each.mcap";
  const auto again = std::filesystem::temp_directory_path() / "waylode_one_of_each.mcap";
  if (!write_log(again, test::one_of_each(), kGoldenOptions)) return false;
  const bool same = core::read_file(again) == core::read_file(written);
  std::filesystem::remove(again);
  return same && compare(written, folder / "one_of_each.json");
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) return 2;
  const std::string& verb = arguments[0];
  bool good = false;
  if (verb == "write") good = write_all(arguments[1]);
  if (verb == "golden") {
    const auto stem = std::filesystem::path(arguments[1]) / "one_of_each";
    good = write_pair(stem, test::one_of_each(), kGoldenOptions);
  }
  if (verb == "check") good = check_golden(arguments[1]);
  if (verb == "compare" && arguments.size() == 3) good = compare(arguments[1], arguments[2]);
  std::fprintf(stderr, "%s %s: %s\n", verb.c_str(), arguments[1].c_str(), good ? "ok" : "FAILED");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace waylode::log

int main(int argc, char** argv) {
  return waylode::log::run(std::vector<std::string>(argv + 1, argv + argc));
}
