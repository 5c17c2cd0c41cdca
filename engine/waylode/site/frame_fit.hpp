// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "waylode/core/geometry.hpp"

namespace waylode::site {

/// The least-squares affine map that takes from[i] to to[i]. nullopt for fewer than three pairs,
/// lists of different lengths, or points that lie (nearly) on one line.
std::optional<core::Affine2> fit_affine(std::span<const core::Vector2> from,
                                        std::span<const core::Vector2> to);

/// The rotation, scale and shift (no mirroring) that takes from[i] to to[i] exactly. nullopt when
/// either pair coincides.
std::optional<core::Affine2> fit_similarity(const core::Vector2 (&from)[2],
                                            const core::Vector2 (&to)[2]);

}  // namespace waylode::site
