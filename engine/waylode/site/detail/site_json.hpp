// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/site/site.hpp"

namespace waylode::site::detail {

/// Everything of `parts` but the radio map, numbers exact. kInvalidArgument for a name that is not
/// UTF-8.
core::Result<std::string> format_site_json(const SiteParts& parts);

/// The inverse. kBundleCorrupt unless every member is there, of its kind, finite and usable.
core::Result<SiteParts> parse_site_json(std::string_view text, std::string_view place);

}  // namespace waylode::site::detail
