// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "waylode/core/result.hpp"

namespace waylode::site::detail {

/// JSON text as a tree. On failure `code`, with the byte where the text stops making sense.
core::Result<nlohmann::json> parse_json(std::string_view text, std::string_view place,
                                        core::ErrorCode code);

/// The member, or nullptr when `object` is no object or lacks it.
const nlohmann::json* find_member(const nlohmann::json& object, const char* key);

}  // namespace waylode::site::detail
