// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "decoder_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

namespace waylode::fuzz {
namespace {

using namespace waylode::sample;

struct Decoded {
  std::vector<Sample> samples;
  log::LogReport report;
};

Decoded decode(std::string_view bytes, std::size_t piece_bytes, const MakeDecoder& make_decoder) {
  Decoded decoded;
  const auto decoder =
      make_decoder([&decoded](Sample&& sample) { decoded.samples.push_back(std::move(sample)); });
  while (!bytes.empty()) {
    decoder->feed(bytes.substr(0, piece_bytes));
    bytes.remove_prefix(std::min(piece_bytes, bytes.size()));
  }
  decoder->finish();
  decoded.report = decoder->report();
  return decoded;
}

bool is_finite(const Vector3& vector) { return vector.allFinite(); }

struct IsSound {
  bool operator()(const AccelerometerSample& s) const { return is_finite(s.specific_force_mps2); }
  bool operator()(const GyroscopeSample& s) const { return is_finite(s.angular_rate_radps); }
  bool operator()(const MagnetometerSample& s) const { return is_finite(s.field_ut); }
  bool operator()(const UncalibratedAccelerometerSample& s) const {
    return is_finite(s.specific_force_mps2) && is_finite(s.bias_mps2);
  }
  bool operator()(const UncalibratedGyroscopeSample& s) const {
    return is_finite(s.angular_rate_radps) && is_finite(s.bias_radps);
  }
  bool operator()(const UncalibratedMagnetometerSample& s) const {
    return is_finite(s.field_ut) && is_finite(s.bias_ut);
  }
  bool operator()(const RotationSample& s) const {
    return std::abs(s.enu_from_device.norm() - 1.0) < 1e-9;
  }
  bool operator()(const BarometerSample& s) const { return std::isfinite(s.pressure_hpa); }
  bool operator()(const WifiScan& scan) const {
    for (const auto& reading : scan.readings) {
      if (!std::isfinite(reading.rssi_dbm) || reading.last_seen > scan.time) return false;
    }
    return !scan.readings.empty();
  }
  bool operator()(const BleReading& s) const {
    return std::isfinite(s.rssi_dbm) && std::isfinite(s.tx_power_dbm.value_or(0.0F));
  }
  bool operator()(const GnssSample& s) const {
    return std::isfinite(s.position.latitude_deg) && std::isfinite(s.position.longitude_deg) &&
           std::isfinite(s.accuracy_m);
  }
  bool operator()(const WaypointSample& s) const {
    const auto geo = s.geo_position.value_or(GeoPoint{});
    return s.position_m.has_value() != s.geo_position.has_value() &&
           s.position_m.value_or(Vector2::Zero()).allFinite() && std::isfinite(geo.latitude_deg) &&
           std::isfinite(geo.longitude_deg);
  }
};

}  // namespace

void require(bool condition) {
  if (!condition) __builtin_trap();
}

void check_sample(const Sample& sample) { require(std::visit(IsSound(), sample)); }

void check_decoder(std::string_view bytes, const MakeDecoder& make_decoder) {
  const Decoded whole = decode(bytes, std::string_view::npos, make_decoder);
  std::uint64_t accepted = 0;
  for (const auto& [kind, count] : whole.report.accepted) accepted += count;
  require(accepted == whole.samples.size());
  require(whole.report.bytes_read == bytes.size());
  for (const Sample& sample : whole.samples) check_sample(sample);
  for (const std::size_t piece_bytes : {std::size_t{1}, std::size_t{7}, bytes.size() / 2 + 1}) {
    const Decoded pieces = decode(bytes, piece_bytes, make_decoder);
    require(pieces.samples == whole.samples);
    require(pieces.report == whole.report);
  }
}

}  // namespace waylode::fuzz
