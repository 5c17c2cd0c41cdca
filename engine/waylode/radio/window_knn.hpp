// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::radio {

/// Nearest neighbours among the points that agree with the scan transmitter by transmitter:
/// [Zhou2016] 1.1. A point scores a hit when it heard a transmitter within a window about what the
/// scan heard. Takes the plain centroid of the nearest. Ignores the prior.
class WindowKnn final : public Positioner {
 public:
  /// The window (R - below_db, R + above_db), bounds excluded, for R of at least from_dbm.
  struct Window {
    float from_dbm = 0.0F;
    float below_db = 0.0F;
    float above_db = 0.0F;

    bool operator==(const Window&) const = default;
  };

  enum class Keep : std::uint8_t {
    kMostHits,  ///< Points with the most hits, or up to `slack_hits` fewer; one at least.
    kAllHits,   ///< Points with a hit for each transmitter.
  };

  struct Options {
    /// By falling from_dbm; the last serves all that is weaker. One to 64. The paper's own table is
    /// in a thesis that is not to be had; wider where weaker, as readings scatter there.
    std::vector<Window> windows = {{-55.0F, 5.0F, 5.0F},
                                   {-70.0F, 7.0F, 7.0F},
                                   {-85.0F, 10.0F, 10.0F},
                                   {-127.0F, 12.0F, 12.0F}};
    std::size_t strongest = 4;  ///< Transmitters of the scan that count, the strongest; 1 to 1000.
    Keep keep = Keep::kMostHits;
    std::size_t slack_hits = 1;  ///< For kMostHits.
    std::size_t neighbours = 4;  ///< k, 1 to 1000; fewer when fewer points are kept.
    Compared compared = Compared::kQuery;
    /// Error covariance = base^2 I + spread_gain * scatter of the neighbours.
    double base_sigma_m = 1.0;
    double spread_gain = 1.0;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `map` must outlive this; `options` must be valid.
  WindowKnn(const ReferenceMap& map, Options options) : map_(&map), options_(std::move(options)) {}

  /// All points compare when none is kept.
  std::optional<Positioning> estimate(const Query& query, std::optional<core::FloorId> known_floor,
                                      const std::optional<core::Belief>& prior) const override;

 private:
  const ReferenceMap* map_;
  Options options_;
};

}  // namespace waylode::radio
