// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "waylode/core/result.hpp"
#include "waylode/radio/scan_assembler.hpp"

namespace waylode::radio {

/// A reading beside what the map expects where the phone is believed to be.
struct ResponseResidual {
  double rssi_dbm = 0.0;
  double expected_dbm = 0.0;
  double sigma_db = 6.0;  ///< Of the difference, above 0.
};

/// How much louder this phone hears than those of the survey: estimated on line, with doubt. One
/// offset for all readings; place and moment disturb a scan as a whole, hence the readings of a
/// scan count as few.
class DeviceResponse {
 public:
  struct Options {
    double prior_sigma_db = 6.0;  ///< Between phones, above 0.
    double scan_sigma_db = 2.0;   ///< By which a whole scan errs (body, wrong place), above 0.
    double drift_db = 0.05;       ///< Random walk from scan to scan (grip, pocket), not negative.
    /// An offset that place, body and the choice of readings can feign: only what exceeds it is
    /// taken from the readings; not negative.
    double feigned_db = 3.0;
    double huber = 1.5;            ///< Residuals beyond this many sigmas pull no harder; above 0.
    std::size_t min_readings = 5;  ///< Scans with fewer are passed over; 1 or more.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` must be valid.
  explicit DeviceResponse(const Options& options);

  /// One scan. Residuals that are not finite, or of no positive sigma, are passed over.
  void update(std::span<const ResponseResidual> residuals);

  double offset_db() const { return offset_db_; }  ///< Heard less expected.
  double sigma_db() const;                         ///< Of the offset.
  /// The query about as a phone of the survey would have heard it (feigned_db short of it).
  Query applied(Query query) const;

 private:
  Options options_;
  double offset_db_ = 0.0;
  double variance_db2_ = 0.0;
};

}  // namespace waylode::radio
