// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/site/floor.hpp"

namespace waylode::site::detail {

/// [x, y], finite; the message says what is wrong otherwise.
tl::expected<core::Vector2, std::string> parse_position(const nlohmann::json& value);

/// Adds one feature of a plan file (contract/plan-format.md) to `plan`. Every vertex must lie in
/// `bounds`. The error is a sentence with the remedy, without place.
tl::expected<void, std::string> add_feature(const nlohmann::json& feature,
                                            const core::Bounds2& bounds, Plan& plan);

}  // namespace waylode::site::detail
