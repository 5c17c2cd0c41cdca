// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/radio/detail/name_automaton.hpp"
#include "waylode/radio/detail/prefix_automaton.hpp"
#include "waylode/radio/hotspot_tables.hpp"

namespace waylode::radio {

/// Tells by address and name whether a Wi-Fi transmitter is carried about: [Wu2019] 1.1 with its
/// automaton, which the paper does not give, filled in. Two automata read the address and the name;
/// what they accept, and whether the address is locally administered, give the verdict. Makers that
/// sell phones sell routers too, so that much stays unsure: HotspotEvidence settles it. Immutable.
class HotspotClassifier {
 public:
  enum class Verdict : std::uint8_t { kUnsure, kMobile, kFixed };

  enum class Reason : std::uint8_t {
    kNothing,       ///< Neither address nor name tells.
    kNotWifi,       ///< Bluetooth or a column of a table.
    kPhoneVendor,   ///< The address is of a maker of phones only: mobile.
    kPhoneName,     ///< A phone's name, and an address that a phone may have: mobile.
    kRouterVendor,  ///< The address is of a maker of routers only: fixed.
    kNameAlone,     ///< A phone's name; who holds the address is not known: unsure.
    kConflict,      ///< A phone's name on a router: unsure.
  };

  struct Classification {
    Verdict verdict = Verdict::kUnsure;
    Reason reason = Reason::kNothing;
    /// A hint only where the address is locally administered: routers and phones alike derive such
    /// addresses from their own by setting that bit, or invent them.
    VendorKind vendor = VendorKind::kUnknown;
    NameKind name = NameKind::kOther;

    bool operator==(const Classification&) const = default;
  };

  /// kInvalidOptions for rules that cannot be read.
  static core::Result<HotspotClassifier> create(const HotspotTables& tables);
  /// By HotspotTables::built_in().
  HotspotClassifier();

  Classification classify(core::TransmitterId transmitter, std::string_view ssid) const;

 private:
  explicit HotspotClassifier(const HotspotTables& tables)
      : prefixes_(tables.prefixes), names_(tables.names) {}

  detail::PrefixAutomaton prefixes_;
  detail::NameAutomaton names_;
};

const char* to_string(HotspotClassifier::Verdict verdict);
const char* to_string(HotspotClassifier::Reason reason);

}  // namespace waylode::radio
