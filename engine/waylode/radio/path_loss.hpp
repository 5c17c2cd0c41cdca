// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"

namespace waylode::radio {

/// How signal strength falls with distance, on average: straight over the logarithm of distance.
struct PathLoss {
  double reference_distance_m = 1.0;  ///< d0, above 0.
  double reference_dbm = -40.0;       ///< Heard there.
  double exponent = 3.0;              ///< n: 2 in free space, 2 to 4 indoors.

  /// Distances below a centimetre count as one.
  double mean_dbm(double distance_m) const;
  /// The inverse. nullopt for an exponent of 0 or less, or where the distance has no finite value.
  std::optional<double> distance_m(double rssi_dbm) const;

  bool operator==(const PathLoss&) const = default;
};

struct DistanceReading {
  double distance_m = 0.0;
  double rssi_dbm = 0.0;
};

struct PathLossFit {
  PathLoss law;
  double sigma_db = 0.0;  ///< Root of the residual sum over (readings - 2); 0 for two readings.
  std::size_t readings = 0;
};

/// Least squares. nullopt without two distinct distances. What is not finite is passed over.
std::optional<PathLossFit> fit_path_loss(std::span<const DistanceReading> readings,
                                         double reference_distance_m = 1.0);

struct PlacedReading {
  core::Vector2 position_m = core::Vector2::Zero();
  double rssi_dbm = 0.0;
};

struct TransmitterFit {
  core::Vector2 position_m = core::Vector2::Zero();
  PathLoss law;
  double sigma_db = 0.0;  ///< Root of the residual sum over (readings - 4).
  std::size_t readings = 0;
};

/// Finds where one transmitter stands that explains what was heard, best place and law together.
/// One that moved leaves a large residual.
class TransmitterLocator {
 public:
  struct Options {
    double min_exponent = 1.5;    ///< Indoors below free space only in corridors; 0 to max.
    double max_exponent = 6.0;    ///< Up to 10.
    double margin_m = 20.0;       ///< How far outside the readings it may stand; 0 to 1000.
    double height_m = 1.5;        ///< Above the phone; keeps the law finite beneath it; above 0.
    std::size_t grid = 12;        ///< Starting places per axis, 2 to 100.
    std::size_t iterations = 20;  ///< Of Gauss-Newton from the best few; 0 to 1000.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` must be valid.
  explicit TransmitterLocator(const Options& options) : options_(options) {}

  /// nullopt with fewer than five finite readings, or when all are at one place.
  std::optional<TransmitterFit> fit(std::span<const PlacedReading> readings) const;

 private:
  Options options_;
};

}  // namespace waylode::radio
