// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/device_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "waylode/core/assert.hpp"

namespace waylode::radio {
namespace {

struct Difference {
  double value_db = 0.0;
  double sigma_db = 0.0;
};

std::vector<Difference> usable(std::span<const ResponseResidual> residuals) {
  std::vector<Difference> differences;
  for (const ResponseResidual& residual : residuals) {
    const double value_db = residual.rssi_dbm - residual.expected_dbm;
    const bool good =
        std::isfinite(value_db) && std::isfinite(residual.sigma_db) && residual.sigma_db > 0.0;
    if (good) differences.push_back({value_db, residual.sigma_db});
  }
  return differences;
}

double median_of(std::vector<Difference> differences) {
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::ranges::nth_element(differences, middle, {}, &Difference::value_db);
  return middle->value_db;
}

struct ScanMean {
  double value_db = 0.0;
  double variance_db2 = 0.0;
};

/// Huber's M-estimate of the scan's offset, reweighted from the median.
ScanMean robust_mean(const std::vector<Difference>& differences, double huber) {
  constexpr int kRounds = 5;
  double value_db = median_of(differences);
  double weight_sum = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0.0;
    weight_sum = 0.0;
    for (const Difference& difference : differences) {
      const double normed = std::abs(difference.value_db - value_db) / difference.sigma_db;
      const double weight =
          (normed > huber ? huber / normed : 1.0) / (difference.sigma_db * difference.sigma_db);
      sum += weight * difference.value_db;
      weight_sum += weight;
    }
    value_db = sum / weight_sum;
  }
  return {value_db, 1.0 / weight_sum};
}

}  // namespace

core::Result<void> DeviceResponse::Options::validate() const {
  const bool valid = prior_sigma_db > 0.0 && prior_sigma_db <= 100.0 && scan_sigma_db > 0.0 &&
                     scan_sigma_db <= 100.0 && drift_db >= 0.0 && drift_db <= 100.0 &&
                     feigned_db >= 0.0 && feigned_db <= 100.0 && huber > 0.0 && huber <= 100.0 &&
                     min_readings >= 1;
  if (valid) return {};
  return core::fail(core::ErrorCode::kInvalidOptions,
                    "sigmas and huber must be in (0, 100], drift_db and feigned_db in [0, 100], "
                    "min_readings 1 or "
                    "more",
                    "device response");
}

DeviceResponse::DeviceResponse(const Options& options)
    : options_(options), variance_db2_(options.prior_sigma_db * options.prior_sigma_db) {
  WAYLODE_ASSERT(options.validate().has_value());
}

void DeviceResponse::update(std::span<const ResponseResidual> residuals) {
  const std::vector<Difference> differences = usable(residuals);
  if (differences.size() < options_.min_readings) return;
  const ScanMean scan = robust_mean(differences, options_.huber);
  const double prior_db2 = options_.prior_sigma_db * options_.prior_sigma_db;
  variance_db2_ = std::min(prior_db2, variance_db2_ + options_.drift_db * options_.drift_db);
  const double scan_db2 = scan.variance_db2 + options_.scan_sigma_db * options_.scan_sigma_db;
  const double gain = variance_db2_ / (variance_db2_ + scan_db2);
  offset_db_ += gain * (scan.value_db - offset_db_);
  variance_db2_ *= 1.0 - gain;
}

double DeviceResponse::sigma_db() const { return std::sqrt(variance_db2_); }

Query DeviceResponse::applied(Query query) const {
  const double sure_db =
      std::copysign(std::max(0.0, std::abs(offset_db_) - options_.feigned_db), offset_db_);
  for (QueryReading& reading : query.readings) {
    reading.rssi_dbm -= static_cast<float>(sure_db);
  }
  return query;
}

}  // namespace waylode::radio
