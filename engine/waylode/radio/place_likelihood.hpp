// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/radio/device_response.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/radio/signal_field.hpp"

namespace waylode::radio {

/// How well a scan fits every place of a floor, seen in two ways at once: which surveyed instances
/// resemble it, and what each transmitter is expected to sound like there. Immutable, shared by
/// sessions.
class PlaceLikelihood {
 public:
  struct Options {
    std::size_t candidates = 50;     ///< Instances that resemble a scan most, 1 to 500.
    double distance_scale = 0.03;    ///< A candidate counts exp(-(distance - least) / this).
    double candidate_sigma_m = 7.0;  ///< Of the kernel about each: how far places can sound alike.
    /// Of the candidates' likelihood, what is spread over the whole floor: above 0, below 1.
    double elsewhere_share = 0.01;
    double candidates_weight = 0.5;  ///< Power on the candidates' likelihood, not negative.
    double signal_weight = 0.5;      ///< Power on the signal field's; 0 does without it.
    double floor_window = 5.0;  ///< Floors this much less likely, as a logarithm, have no raster.
    SignalField::Options signal;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `matcher` must outlive this. kInvalidOptions.
  static core::Result<PlaceLikelihood> create(const Matcher& matcher, const Options& options);

  /// What was heard beside what is expected at a place: readings that are fresh, of transmitters
  /// that most scans hear there.
  std::vector<ResponseResidual> residuals(const Query& query, core::FloorId floor,
                                          const core::Vector2& position_m) const;

  /// Gives the likelier floors of an observation of `query` their raster.
  void add_rasters(const Query& query, observation::RadioObservation& observation) const;

 private:
  PlaceLikelihood(const Matcher& matcher, const Options& options, SignalField field)
      : matcher_(&matcher), options_(options), field_(std::move(field)) {}

  std::shared_ptr<const observation::LikelihoodRaster> raster(const Query& query,
                                                              core::FloorId floor) const;
  observation::LikelihoodRaster matched(const Query& query, core::FloorId floor,
                                        const RasterGeometry& geometry) const;

  const Matcher* matcher_;
  Options options_;
  SignalField field_;
};

}  // namespace waylode::radio
