// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::radio {

/// Nearest neighbours in plain RSSI over the whole map, the baseline of [Zhao2019] 3. Ignores the
/// prior.
class KnnPositioner final : public Positioner {
 public:
  struct Options {
    std::size_t neighbours = 5;  ///< K, 1 to 1000.
    bool weighted = false;       ///< By inverse distance.
    Compared compared = Compared::kUnion;
    /// Error covariance = base^2 I + spread_gain * weighted scatter of the neighbours.
    double base_sigma_m = 1.0;
    double spread_gain = 1.0;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `map` must outlive this; `options` must be valid.
  KnnPositioner(const ReferenceMap& map, const Options& options) : map_(&map), options_(options) {}

  std::optional<Positioning> estimate(const Query& query, std::optional<core::FloorId> known_floor,
                                      const std::optional<core::Belief>& prior) const override;

 private:
  const ReferenceMap* map_;
  Options options_;
};

}  // namespace waylode::radio
