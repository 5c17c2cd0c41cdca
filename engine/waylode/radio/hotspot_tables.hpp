// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace waylode::radio {

/// What the holder of an address prefix makes.
enum class VendorKind : std::uint8_t { kUnknown, kPhone, kRouter, kMixed };

/// Whose name a network bears.
enum class NameKind : std::uint8_t {
  kOther,
  kMixed,  ///< As phones and routers of one brand are named.
  kPhone,  ///< As what is carried about is named.
};

/// Prefix of a hardware address.
struct PrefixRule {
  std::string digits;  ///< 1 to 12 hexadecimal digits, either case: 6 of a large assignment, 7, 9.
  VendorKind kind = VendorKind::kUnknown;
};

/// Characters in a network's name; their case counts.
struct NameRule {
  enum class Place : std::uint8_t { kAnywhere, kStart, kEnd };

  std::string text;  ///< 1 to 32 bytes.
  Place place = Place::kStart;
  NameKind kind = NameKind::kPhone;
};

/// What a HotspotClassifier decides by. Append to built_in() to extend it.
struct HotspotTables {
  std::vector<PrefixRule> prefixes;  ///< The longest that fits holds; of equals the last.
  std::vector<NameRule> names;       ///< kPhone holds over kMixed where both fit.

  /// Prefixes that the IEEE assigned to well-known makers, and names that phones give themselves.
  static HotspotTables built_in();
};

}  // namespace waylode::radio
