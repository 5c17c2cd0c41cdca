// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/hotspot_classifier.hpp"

#include <algorithm>

namespace waylode::radio {
namespace {

using Verdict = HotspotClassifier::Verdict;
using Reason = HotspotClassifier::Reason;

constexpr std::uint64_t kLocallyAdministered = 0x0200'0000'0000ULL;

bool is_readable(const PrefixRule& rule) {
  return !rule.digits.empty() && rule.digits.size() <= 12 &&
         std::ranges::all_of(rule.digits, [](char c) { return detail::hexadecimal_digit(c) >= 0; });
}

bool is_readable(const NameRule& rule) { return !rule.text.empty() && rule.text.size() <= 32; }

/// What the accepting states of both automata say together.
HotspotClassifier::Classification conclude(VendorKind vendor, NameKind name, bool local) {
  const auto say = [&](Verdict verdict, Reason reason) {
    return HotspotClassifier::Classification{verdict, reason, vendor, name};
  };
  if (name == NameKind::kPhone) {
    const bool may_be_phone = vendor == VendorKind::kMixed || vendor == VendorKind::kPhone;
    if (local || may_be_phone) return say(Verdict::kMobile, Reason::kPhoneName);
    return say(Verdict::kUnsure,
               vendor == VendorKind::kRouter ? Reason::kConflict : Reason::kNameAlone);
  }
  if (!local && vendor == VendorKind::kPhone) return say(Verdict::kMobile, Reason::kPhoneVendor);
  if (!local && vendor == VendorKind::kRouter) return say(Verdict::kFixed, Reason::kRouterVendor);
  return say(Verdict::kUnsure, Reason::kNothing);
}

}  // namespace

core::Result<HotspotClassifier> HotspotClassifier::create(const HotspotTables& tables) {
  for (const PrefixRule& rule : tables.prefixes) {
    if (is_readable(rule)) continue;
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "prefix '" + rule.digits + "' must be 1 to 12 hexadecimal digits",
                      "hotspot_tables");
  }
  for (const NameRule& rule : tables.names) {
    if (is_readable(rule)) continue;
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "name '" + rule.text + "' must be 1 to 32 bytes", "hotspot_tables");
  }
  return HotspotClassifier(tables);
}

HotspotClassifier::HotspotClassifier() : HotspotClassifier(HotspotTables::built_in()) {}

HotspotClassifier::Classification HotspotClassifier::classify(core::TransmitterId transmitter,
                                                              std::string_view ssid) const {
  if (transmitter.kind() != core::TransmitterId::Kind::kWifi) {
    return {Verdict::kUnsure, Reason::kNotWifi, VendorKind::kUnknown, NameKind::kOther};
  }
  return conclude(prefixes_.run(transmitter.address48() & ~kLocallyAdministered), names_.run(ssid),
                  transmitter.locally_administered());
}

const char* to_string(HotspotClassifier::Verdict verdict) {
  switch (verdict) {
    case Verdict::kMobile:
      return "mobile";
    case Verdict::kFixed:
      return "fixed";
    case Verdict::kUnsure:
      break;
  }
  return "unsure";
}

const char* to_string(HotspotClassifier::Reason reason) {
  switch (reason) {
    case Reason::kNotWifi:
      return "not_wifi";
    case Reason::kPhoneVendor:
      return "phone_vendor";
    case Reason::kPhoneName:
      return "phone_name";
    case Reason::kRouterVendor:
      return "router_vendor";
    case Reason::kNameAlone:
      return "name_alone";
    case Reason::kConflict:
      return "conflict";
    case Reason::kNothing:
      break;
  }
  return "nothing";
}

}  // namespace waylode::radio
