// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/domain_filter.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "waylode/core/assert.hpp"

namespace waylode::radio {
namespace {

constexpr double kSigmaPerMad = 1.4826;  // Of a Gaussian: 1 / quantile(0.75).

std::vector<float> finite_of(std::span<const float> values) {
  std::vector<float> finite;
  finite.reserve(values.size());
  for (const float value : values) {
    if (std::isfinite(value)) finite.push_back(value);
  }
  return finite;
}

/// Of an even number, the mean of the middle two. `values` must not be empty.
float median_of(std::vector<float> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return 0.5F * (values[middle - 1] + values[middle]);
}

/// Where readings are believed, and what stands for one that is not.
struct Domain {
  double centre_dbm = 0.0;
  double half_width_db = 0.0;
};

Domain domain_of(const SignalStatistics& statistics, const DomainFilter::Options& options) {
  const auto mean = static_cast<double>(statistics.mean_dbm);
  const auto max = static_cast<double>(statistics.max_dbm);
  const auto min = static_cast<double>(statistics.min_dbm);
  switch (options.mode) {
    case DomainFilter::Mode::kHalfRange:
      return {mean, 0.5 * (max - min)};  // [Wu2019] 1.1, theta as half the range.
    case DomainFilter::Mode::kLiteral:
      return {mean, 0.5 * std::abs(max + min)};  // [Wu2019] 1.1, theta as printed.
    case DomainFilter::Mode::kMad:
    case DomainFilter::Mode::kOff:
      break;
  }
  const double mad = static_cast<double>(std::max(statistics.mad_db, options.min_mad_db));
  return {static_cast<double>(statistics.median_dbm),
          static_cast<double>(options.mad_factor) * kSigmaPerMad * mad};
}

}  // namespace

std::optional<SignalStatistics> signal_statistics(std::span<const float> rssi_dbm) {
  const std::vector<float> finite = finite_of(rssi_dbm);
  if (finite.empty()) return std::nullopt;
  const auto count = static_cast<double>(finite.size());
  double sum = 0.0;
  for (const float value : finite) sum += static_cast<double>(value);
  const double mean = sum / count;  // [Wu2019] eq. (1)
  double squares = 0.0;
  for (const float value : finite) {
    squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
  }
  const auto [min, max] = std::ranges::minmax(finite);
  const float median = median_of(finite);
  std::vector<float> deviations;
  deviations.reserve(finite.size());
  for (const float value : finite) deviations.push_back(std::abs(value - median));

  SignalStatistics statistics;
  statistics.count = finite.size();
  statistics.mean_dbm = static_cast<float>(mean);
  statistics.min_dbm = min;
  statistics.max_dbm = max;
  statistics.median_dbm = median;
  statistics.mad_db = median_of(std::move(deviations));
  if (finite.size() > 1) statistics.sigma_db = static_cast<float>(std::sqrt(squares / (count - 1)));
  return statistics;
}

core::Result<void> DomainFilter::Options::validate() const {
  if (!(mad_factor > 0.0F && mad_factor <= 100.0F && min_mad_db >= 0.0F && min_mad_db <= 20.0F)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "mad_factor must be in (0, 100] and min_mad_db in [0, 20]", "domain_filter");
  }
  return {};
}

DomainFilter::Outcome DomainFilter::apply(std::span<const float> rssi_dbm) const {
  WAYLODE_ASSERT(options_.validate().has_value());
  Outcome outcome{finite_of(rssi_dbm), {}};
  const std::optional<SignalStatistics> statistics = signal_statistics(outcome.rssi_dbm);
  if (!statistics || options_.mode == Mode::kOff) return outcome;
  // The bounds themselves belong to the domain; the slack keeps rounding from moving them.
  constexpr double kSlack_db = 1e-4;
  const Domain domain = domain_of(*statistics, options_);
  for (std::size_t i = 0; i < outcome.rssi_dbm.size(); ++i) {
    const double deviation = std::abs(static_cast<double>(outcome.rssi_dbm[i]) - domain.centre_dbm);
    if (deviation <= domain.half_width_db + kSlack_db) continue;
    outcome.rssi_dbm[i] = static_cast<float>(domain.centre_dbm);
    outcome.replaced.push_back(i);
  }
  return outcome;
}

std::size_t remove_duplicates(std::vector<sample::WifiScan>& scans) {
  std::set<std::pair<core::DeviceTime, core::TransmitterId>> seen;
  std::size_t removed = 0;
  std::erase_if(scans, [&](sample::WifiScan& scan) {
    const std::size_t gone = std::erase_if(scan.readings, [&](const sample::WifiReading& reading) {
      return !seen.emplace(scan.time, reading.transmitter).second;
    });
    removed += gone;
    return gone > 0 && scan.readings.empty();
  });
  return removed;
}

}  // namespace waylode::radio
