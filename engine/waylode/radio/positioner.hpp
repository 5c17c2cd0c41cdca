// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "waylode/core/fix.hpp"
#include "waylode/core/id.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/radio/scan_assembler.hpp"

namespace waylode::radio {

/// Where a scan seems to come from, and what it took to say so.
struct Positioning {
  observation::RadioObservation observation;
  /// Surveyed points that the scan was compared with. Models that compare with none say how many
  /// vectors they keep.
  std::size_t comparisons = 0;
};

/// A way to turn one scan into places, floor by floor. Implementations are immutable, so any number
/// of sessions share one; what they learn from (a map) must outlive them.
class Positioner {
 public:
  virtual ~Positioner() = default;

  /// `known_floor` restricts the search to one floor. `prior` is where the person is thought to be;
  /// most methods ignore it. nullopt when the scan tells nothing here.
  virtual std::optional<Positioning> estimate(const Query& query,
                                              std::optional<core::FloorId> known_floor,
                                              const std::optional<core::Belief>& prior) const = 0;

 protected:
  Positioner() = default;
  Positioner(const Positioner&) = default;
  Positioner& operator=(const Positioner&) = default;
  Positioner(Positioner&&) = default;
  Positioner& operator=(Positioner&&) = default;
};

}  // namespace waylode::radio
