// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/hotspot_tables.hpp"

#include <string_view>

namespace waylode::radio {
namespace {

#include "waylode/radio/detail/oui_table.inc"

constexpr std::string_view kPhoneStarts[] = {"iPhone",      "iPad",
                                             "AndroidAP",   "AndroidShare",
                                             "DIRECT-",     "Galaxy S",
                                             "Galaxy Note", "Galaxy Z",
                                             "SM-",         "Redmi ",
                                             "POCO ",       "OPPO ",
                                             "vivo ",       "realme ",
                                             "OnePlus ",    "Pixel ",
                                             "HUAWEI P",    "HUAWEI Mate",
                                             "HUAWEI nova", "HONOR ",
                                             "moto ",       "HTC Portable Hotspot",
                                             "Xperia",      "MiFi"};
constexpr std::string_view kPhoneEnds[] = {"iPhone", "iPad"};
constexpr std::string_view kMixedStarts[] = {"HUAWEI-", "HONOR-", "Redmi_", "Xiaomi_", "ZTE_"};

void append(std::vector<PrefixRule>& rules, std::string_view digits, VendorKind kind) {
  constexpr std::size_t kDigits = 6;
  for (std::size_t i = 0; i + kDigits <= digits.size(); i += kDigits) {
    rules.push_back({std::string(digits.substr(i, kDigits)), kind});
  }
}

}  // namespace

HotspotTables HotspotTables::built_in() {
  HotspotTables tables;
  append(tables.prefixes, kPhonePrefixes, VendorKind::kPhone);
  append(tables.prefixes, kRouterPrefixes, VendorKind::kRouter);
  append(tables.prefixes, kMixedPrefixes, VendorKind::kMixed);
  for (const std::string_view text : kPhoneStarts) {
    tables.names.push_back({std::string(text), NameRule::Place::kStart, NameKind::kPhone});
  }
  for (const char model : std::string_view("AM")) {  // "Galaxy A5", but not "Galaxy Mall".
    for (const char digit : std::string_view("0123456789")) {
      tables.names.push_back(
          {std::string("Galaxy ") + model + digit, NameRule::Place::kStart, NameKind::kPhone});
    }
  }
  for (const std::string_view text : kPhoneEnds) {
    tables.names.push_back({std::string(text), NameRule::Place::kEnd, NameKind::kPhone});
  }
  for (const std::string_view text : kMixedStarts) {
    tables.names.push_back({std::string(text), NameRule::Place::kStart, NameKind::kMixed});
  }
  return tables;
}

}  // namespace waylode::radio
