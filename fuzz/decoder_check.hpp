// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "waylode/log/log_reader.hpp"

namespace waylode::fuzz {

/// Traps unless `condition` holds.
void require(bool condition);

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

using MakeDecoder = std::function<std::unique_ptr<log::Decoder>(log::SampleSink)>;

/// Decodes the bytes at once and in pieces of a few sizes: the same samples and the same report
/// must come out, with finite numbers, no reading newer than its scan, and every sample counted.
void check_decoder(std::string_view bytes, const MakeDecoder& make_decoder);

/// Of one accepted sample.
void check_sample(const sample::Sample& sample);

}  // namespace waylode::fuzz
