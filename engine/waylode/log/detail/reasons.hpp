// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Why a record of a text log was rejected, as LogReport::rejected names it.
namespace waylode::log::detail {

/// One of the reasons below; nullptr: nothing to complain of.
using Complaint = const char*;

inline constexpr const char* kFieldCount = "wrong_field_count";
inline constexpr const char* kNotANumber = "not_a_number";
inline constexpr const char* kOutOfRange = "out_of_range";
inline constexpr const char* kBadTime = "bad_time";
inline constexpr const char* kBadAddress = "bad_address";
inline constexpr const char* kBadBeacon = "bad_beacon_id";
inline constexpr const char* kSeenAfterDelivery = "last_seen_after_delivery";
inline constexpr const char* kNotARecord = "not_a_record";
inline constexpr const char* kLineTooLong = "line_too_long";

}  // namespace waylode::log::detail
