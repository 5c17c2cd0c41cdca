// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/log/log_report.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::cli {

/// The samples of one kind in a log.
struct KindSummary {
  std::uint64_t count = 0;
  core::DeviceTime first;
  core::DeviceTime last;

  /// Samples per second between the first and the last; 0 when that is no span.
  double rate_hz() const;
};

/// What `inspect` tells of a log besides the reader's own report.
struct LogSummary {
  log::LogReport report;
  std::map<std::string, KindSummary> kinds;  ///< As sample::kind_of names them.
  std::uint64_t wifi_readings = 0;
  std::set<core::TransmitterId> wifi_transmitters;
  std::vector<float> wifi_ages_s;  ///< Delivery less last seen, per reading; sorted.
  std::set<core::TransmitterId> bluetooth_transmitters;
  std::map<std::string, std::uint64_t> marks_by_floor;  ///< "" where a mark names no floor.

  double duration_s() const;
  /// The smallest age that a share of the readings does not exceed; 0 without readings.
  double wifi_age_quantile_s(double share) const;
};

/// Errors of log::read_log.
core::Result<LogSummary> summarise_log(const std::filesystem::path& path);

}  // namespace waylode::cli
