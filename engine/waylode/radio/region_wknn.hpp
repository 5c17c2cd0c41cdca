// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::radio {

/// Weighted nearest neighbours among the points whose strongest transmitter is the scan's, so that
/// with m useful transmitters about one m-th of the map is compared: [Wu2019] 1.2.1. Where a region
/// has too few points, those of the scan's next strongest join; at last the whole map. Ignores the
/// prior.
class RegionWknn final : public Positioner {
 public:
  struct Options {
    std::size_t neighbours = 4;  ///< K, 1 to 1000; the paper tells none, 3 to 5 do.
    Compared compared = Compared::kUnion;
    /// Error covariance = base^2 I + spread_gain * weighted scatter of the neighbours.
    double base_sigma_m = 1.0;
    double spread_gain = 1.0;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `map` must outlive this; `options` must be valid.
  RegionWknn(const ReferenceMap& map, const Options& options) : map_(&map), options_(options) {}

  std::optional<Positioning> estimate(const Query& query, std::optional<core::FloorId> known_floor,
                                      const std::optional<core::Belief>& prior) const override;

 private:
  const ReferenceMap* map_;
  Options options_;
};

}  // namespace waylode::radio
