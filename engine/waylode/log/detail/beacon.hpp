// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace waylode::log::detail {

/// "uuid/major/minor" with the UUID in lower case, empty if the UUID is; nullopt if the UUID is not
/// 8 to 64 hexadecimal digits and dashes, or a number is not in [0, 65535].
std::optional<std::string> ibeacon_name(std::string_view uuid, std::string_view major,
                                        std::string_view minor);

/// A beacon's calibrated power is far below 0 dBm. Loggers write 0 for "unknown" and some beacons
/// broadcast a positive number: neither is told.
std::optional<float> told_tx_power_dbm(double tx_power_dbm);

}  // namespace waylode::log::detail
