// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace waylode::sim::detail {

/// A seed of its own for each named part, so that parts can change without each other:
/// FNV-1a over the name, finished by SplitMix64.
constexpr std::uint64_t derive_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xCBF2'9CE4'8422'2325ULL ^ seed;
  for (const char letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x0000'0100'0000'01B3ULL;
  }
  hash += 0x9E37'79B9'7F4A'7C15ULL;
  hash = (hash ^ (hash >> 30U)) * 0xBF58'476D'1CE4'E5B9ULL;
  hash = (hash ^ (hash >> 27U)) * 0x94D0'49BB'1331'11EBULL;
  return hash ^ (hash >> 31U);
}

}  // namespace waylode::sim::detail
