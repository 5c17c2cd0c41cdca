// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "waylode/site/floor.hpp"

namespace waylode::site::detail {

/// Drops repeated vertices, winds the outer ring counter-clockwise and the holes clockwise.
void tidy(Polygon& polygon);

/// Why a tidied polygon is no simple area ("crosses itself", ...); empty when it is one.
std::string defect_of(const Polygon& polygon);

}  // namespace waylode::site::detail
