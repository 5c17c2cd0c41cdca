// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/radio/reference_map.hpp"

namespace waylode::radio {

/// The reference points of a floor that fit what was heard best, the best first, each at least
/// `apart_m` from those before it; at most `count`. For a start that may be elsewhere than it
/// seems. Readings of several scans may be given together: a transmitter named repeatedly counts
/// with its mean. Empty when nothing heard is known, or for a floor without points.
std::vector<core::Vector2> alternatives(const ReferenceMap& map,
                                        std::span<const QueryReading> readings, core::FloorId floor,
                                        std::size_t count, double apart_m);

}  // namespace waylode::radio
