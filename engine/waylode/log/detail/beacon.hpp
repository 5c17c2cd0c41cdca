// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace waylode::log::detail {

/// "uuid/major/minor" with the UUID in lower case; nullopt if the UUID is not 8 to 64 hexadecimal
/// digits and dashes, or a number is not in [0, 65535].
std::optional<std::string> ibeacon_name(std::string_view uuid, std::string_view major,
                                        std::string_view minor);

/// Calibrated power of a beacon is far below 0 dBm: an exact 0 is how loggers write "unknown".
std::optional<float> told_tx_power_dbm(double tx_power_dbm);

}  // namespace waylode::log::detail
