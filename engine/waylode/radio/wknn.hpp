// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/scan_assembler.hpp"

namespace waylode::radio {

/// Weighted k nearest neighbours: a scan becomes, for every floor, a weighted mean of surveyed
/// places, its error covariance, and the floor's likelihood.
class WknnEstimator {
 public:
  struct Options {
    std::size_t neighbours = 8;        ///< k, 1 to 200.
    std::size_t floor_neighbours = 8;  ///< Nearest over all floors that vote for theirs.
    double weight_exponent = 6.0;      ///< Weight = (d_nearest / d)^exponent.
    /// Error covariance = (base^2 I + spread_gain * weighted scatter of the neighbours) / trust.
    double base_sigma_m = 3.0;
    double spread_gain = 1.0;
    std::size_t min_readings = 3;  ///< Scans with fewer say too little to be used.
    /// Trust in a scan of n readings is n / (n + few_readings).
    double few_readings = 20.0;
    double floor_few_readings = 5.0;  ///< The same for its vote on the floor.
    /// A match ages as its bearer may have walked on: see aged().
    double walking_speed_mps = 1.2;  ///< Brisk for indoors, so that the doubt covers most people.
    double fresh_for_s = 3.0;        ///< No ageing sooner: about a scan's own duration.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `matcher` must outlive the estimator.
  WknnEstimator(const Matcher& matcher, const Options& options)
      : matcher_(&matcher), options_(options) {}

  /// nullopt when the scan has too few readings or shares none with the map.
  std::optional<observation::RadioObservation> estimate(
      const Query& query, std::optional<core::FloorId> known_floor = std::nullopt) const;

  /// The same, with the number of fingerprints it took.
  std::optional<Positioning> position(
      const Query& query, std::optional<core::FloorId> known_floor = std::nullopt) const;

  /// Whether a scan shows that the phone is off the map: at least min_readings of Wi-Fi (or table
  /// columns), and the map knows none of the scan. Bluetooth alone never does, since people carry
  /// most of it about.
  bool is_foreign(const Query& query) const;

  /// The covariance of a match `age_s` after its scan: (walking_speed_mps (age_s - fresh_for_s))^2
  /// more per axis.
  core::Matrix2 aged(const core::Matrix2& covariance_m2, double age_s) const;

 private:
  const Matcher* matcher_;
  Options options_;
};

/// The same behind the common interface; ignores the prior.
class WknnPositioner final : public Positioner {
 public:
  /// The matcher of `estimator` must outlive this.
  explicit WknnPositioner(const WknnEstimator& estimator) : estimator_(estimator) {}

  std::optional<Positioning> estimate(const Query& query, std::optional<core::FloorId> known_floor,
                                      const std::optional<core::Belief>&) const override {
    return estimator_.position(query, known_floor);
  }

 private:
  WknnEstimator estimator_;
};

}  // namespace waylode::radio
