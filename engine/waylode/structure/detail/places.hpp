// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "waylode/structure/structure_adjuster.hpp"

namespace waylode::structure::detail {

/// Which visits of which walks met the same place.
struct Places {
  std::vector<std::vector<std::size_t>> of;  ///< [walk][visit], into names; numbered as first met.
  std::vector<std::string> names;            ///< Empty where no visit is named.
  std::vector<std::string> notes;            ///< What was ambiguous.

  std::size_t count() const { return names.size(); }
};

/// What earlier rounds have found out.
struct Findings {
  std::vector<Visit> apart;                       ///< Not where their name or route says.
  std::vector<std::pair<Visit, Visit>> together;  ///< The same place by geometry.
};

/// Visits are one place when they carry one name, when a segment between them is no longer than one
/// may pass a landmark by, when their walks went the same route, or when geometry said so; never
/// when their names differ.
Places associate(std::span<const Walk> walks, const Findings& findings,
                 const StructureAdjuster::Options& options);

}  // namespace waylode::structure::detail
