// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/magnetic/field_grid.hpp"

namespace waylode::magnetic::detail {

/// The field over one piece of the path.
struct PathField {
  core::Vector2 from_end_m = core::Vector2::Zero();  ///< Floor frame, from the end of the path.
  core::Vector2 field_ut = core::Vector2::Zero();    ///< Horizontal, vertical.
};

/// A place where the path's end was tried.
struct Trial {
  core::Vector2 end_m = core::Vector2::Zero();
  double mean_square_ut2 = 0.0;
};

struct SearchArea {
  core::Vector2 centre_m = core::Vector2::Zero();
  double radius_m = 0.0;
  double step_m = 0.0;
};

/// Tries every place of the area, row by row. Left out are those that put fewer than `least_known`
/// pieces on the map. `bias_share`: how much of the squared mean difference counts, 0 to 1.
std::vector<Trial> try_area(std::span<const PathField> path, const FieldGrid& grid,
                            const SearchArea& area, std::size_t least_known, double bias_share);

/// What the trials say together.
struct Fit {
  Trial best;
  core::Matrix2 covariance_m2 = core::Matrix2::Identity();  ///< Of the best trial's place.
};

struct FitDoubt {
  double independent_count = 1.0;  ///< Differences along the path that are independent.
  double field_sigma_ut = 0.0;
  double widest_sigma_m = 0.0;
};

/// nullopt without trials, or where no direction is known better than `widest_sigma_m`.
std::optional<Fit> fit_trials(std::span<const Trial> trials, const SearchArea& area,
                              const FitDoubt& doubt);

}  // namespace waylode::magnetic::detail
