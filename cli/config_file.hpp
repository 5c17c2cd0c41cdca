// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/pipeline/options.hpp"

namespace waylode::cli {

/// Every option with its value, range and meaning, as TOML; parse_options gives the same back.
std::string format_options(pipeline::Options options);

/// Defaults changed by a configuration file's text. Strict: a key that is not an option and a value
/// of the wrong kind or out of its range are kInvalidOptions with "place:line".
core::Result<pipeline::Options> parse_options(std::string_view toml, const std::string& place);

/// The defaults without a path; else the file, with errors of core::read_file and parse_options.
core::Result<pipeline::Options> load_options(const std::optional<std::string>& path);

/// Help for the option --config, which verbs share.
inline constexpr const char* kConfigHelp =
    "Options to change, as TOML; `waylode config dump` lists all of them";

}  // namespace waylode::cli
