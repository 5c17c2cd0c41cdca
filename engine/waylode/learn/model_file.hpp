// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/learn/regression.hpp"

namespace waylode::learn {

/// A trained regression as JSON text: vectors, weights, covariance, scaling and kernel, to the
/// last digit. Stable: the same regression gives the same text.
std::string format_model(const Regression& regression);

/// What format_model wrote. `place` names the text in errors. kBundleCorrupt for text that is not
/// JSON, another version, members missing or unknown, sizes that do not match, and values out of
/// range or not finite.
core::Result<Regression> parse_model(std::string_view text, std::string_view place);

}  // namespace waylode::learn
