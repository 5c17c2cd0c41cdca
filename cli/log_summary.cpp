// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "log_summary.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/log/log_reader.hpp"

namespace waylode::cli {
namespace {

void count(LogSummary& summary, const sample::Sample& sample) {
  const core::DeviceTime time = sample::time_of(sample);
  const auto [entry, is_first] =
      summary.kinds.try_emplace(sample::kind_of(sample), KindSummary{0, time, time});
  KindSummary& kind = entry->second;
  ++kind.count;
  kind.first = std::min(kind.first, time);
  kind.last = std::max(kind.last, time);
}

void note_radio(LogSummary& summary, const sample::Sample& sample) {
  if (const auto* scan = std::get_if<sample::WifiScan>(&sample)) {
    for (const sample::WifiReading& reading : scan->readings) {
      ++summary.wifi_readings;
      summary.wifi_transmitters.insert(reading.transmitter);
      const double age_s = core::to_seconds(scan->time - reading.last_seen);
      summary.wifi_ages_s.push_back(static_cast<float>(age_s));
    }
  } else if (const auto* reading = std::get_if<sample::BleReading>(&sample)) {
    summary.bluetooth_transmitters.insert(reading->transmitter);
  } else if (const auto* mark = std::get_if<sample::WaypointSample>(&sample)) {
    ++summary.marks_by_floor[mark->floor];
  }
}

}  // namespace

double KindSummary::rate_hz() const {
  const double span_s = core::to_seconds(last - first);
  return span_s > 0.0 ? static_cast<double>(count - 1) / span_s : 0.0;
}

double LogSummary::duration_s() const {
  if (kinds.empty()) return 0.0;
  core::DeviceTime first = kinds.begin()->second.first;
  core::DeviceTime last = kinds.begin()->second.last;
  for (const auto& [name, kind] : kinds) {
    first = std::min(first, kind.first);
    last = std::max(last, kind.last);
  }
  return core::to_seconds(last - first);
}

double LogSummary::wifi_age_quantile_s(double share) const {
  if (wifi_ages_s.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(wifi_ages_s.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  return wifi_ages_s[std::min(index, wifi_ages_s.size() - 1)];
}

core::Result<LogSummary> summarise_log(const std::filesystem::path& path) {
  LogSummary summary;
  auto report = log::read_log(path, [&](sample::Sample&& sample) {
    count(summary, sample);
    note_radio(summary, sample);
  });
  if (!report) return tl::unexpected(report.error());
  summary.report = *std::move(report);
  std::ranges::sort(summary.wifi_ages_s);
  return summary;
}

}  // namespace waylode::cli
