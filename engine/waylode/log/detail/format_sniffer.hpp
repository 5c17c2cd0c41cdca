// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "waylode/log/log_report.hpp"

namespace waylode::log::detail {

/// How much of a log decides its format.
inline constexpr std::size_t kSniffBytes = 65536;

/// The format that the first bytes of a log show; nullopt when it is none of ours. The first line
/// that is a record of some format decides, so that damaged lines before it do no harm; a log of
/// headers alone is known by them.
std::optional<LogFormat> sniff_format(std::string_view head);

}  // namespace waylode::log::detail
