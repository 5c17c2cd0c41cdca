// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>

#include "waylode/sample/sample.hpp"

/// Samples as the Protobuf messages of contract/waylode_log.proto. A kind of sample is numbered by
/// its place in sample::Sample.
namespace waylode::log::detail {

inline constexpr std::size_t kSampleKindCount = std::variant_size_v<sample::Sample>;

/// "/accelerometer", ...
const char* topic_of_kind(std::size_t kind);
/// "waylode.log.v1.Accelerometer", ...
std::string schema_name_of_kind(std::size_t kind);
/// The inverse; nullopt for a schema that is not ours.
std::optional<std::size_t> kind_of_schema_name(std::string_view name);
/// A serialised FileDescriptorSet that holds this message alone.
std::string schema_of_kind(std::size_t kind);

/// Why a sample may not stand in a log ("not_finite", "out_of_range", "bad_transmitter",
/// "bad_text", "last_seen_after_delivery"); nullptr when it may. The limits are those of the text
/// logs, limits.hpp.
const char* fault_of(const sample::Sample& sample);

/// Appends the message. The sample must be without fault.
void encode_sample(const sample::Sample& sample, std::string& bytes);

/// The sample, or the reason for rejecting the message: "bad_message" or as fault_of.
tl::expected<sample::Sample, const char*> decode_sample(std::size_t kind, std::string_view bytes);

}  // namespace waylode::log::detail
