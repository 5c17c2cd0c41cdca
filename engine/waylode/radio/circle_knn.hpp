// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::radio {

/// Weighted nearest neighbours among the points around where dead reckoning holds the person to be:
/// [Zhao2019] 2.3. Never corrects a prior that is further off than the radius: whoever feeds the
/// outcome back must check it against a search of the whole map now and then.
class CircleKnn final : public Positioner {
 public:
  struct Options {
    double radius_m = 2.0;       ///< Points on the circle count; above 0, to 1000.
    std::size_t neighbours = 4;  ///< At most as many as the circle holds; 1 to 1000.
    Compared compared = Compared::kUnion;
    /// Error covariance = base^2 I + spread_gain * weighted scatter of the neighbours.
    double base_sigma_m = 1.0;
    double spread_gain = 1.0;
    /// How well the best point fits: -n/2 (root mean square difference / sigma)^2, n the readings
    /// but no more than these, since readings of one scan err together; above 0.
    double reading_sigma_db = 6.0;
    double independent_readings = 6.0;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `map` must outlive this; `options` must be valid.
  CircleKnn(const ReferenceMap& map, const Options& options) : map_(&map), options_(options) {}

  /// Around a prior, the floor's log_likelihood tells how well the best point there fits what was
  /// heard. nullopt when the circle is empty: keep dead reckoning then. Without a prior, or with
  /// one of another floor than the known one, all points compare.
  std::optional<Positioning> estimate(const Query& query, std::optional<core::FloorId> known_floor,
                                      const std::optional<core::Belief>& prior) const override;

 private:
  const ReferenceMap* map_;
  Options options_;
};

}  // namespace waylode::radio
