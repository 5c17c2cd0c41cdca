// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/hotspot_classifier.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>

namespace waylode::radio {
namespace {

using core::TransmitterId;
using Verdict = HotspotClassifier::Verdict;
using Reason = HotspotClassifier::Reason;
using Place = NameRule::Place;

// Prefixes as the IEEE's list has them.
constexpr std::uint64_t kOppo = 0x1C48'CE12'3456ULL;
constexpr std::uint64_t kCisco = 0x0000'0C12'3456ULL;
constexpr std::uint64_t kApple = 0x0003'9312'3456ULL;
constexpr std::uint64_t kNobody = 0x0000'0012'3456ULL;  // Xerox: in none of the groups.
constexpr std::uint64_t kLocal = 0x0200'0000'0000ULL;

HotspotClassifier::Classification classify(std::uint64_t address, std::string_view ssid) {
  return HotspotClassifier().classify(TransmitterId::wifi(address), ssid);
}

struct Expected {
  std::uint64_t address;
  const char* ssid;
  Verdict verdict;
  Reason reason;
};

TEST(HotspotClassifier, ConcludesFromVendorNameAndLocalBit) {
  for (const Expected& expected : {
           Expected{kOppo, "", Verdict::kMobile, Reason::kPhoneVendor},
           Expected{kOppo, "cafe", Verdict::kMobile, Reason::kPhoneVendor},
           Expected{kOppo, "OPPO A5", Verdict::kMobile, Reason::kPhoneName},
           Expected{kOppo | kLocal, "cafe", Verdict::kUnsure, Reason::kNothing},
           Expected{kApple, "Eva's iPhone", Verdict::kMobile, Reason::kPhoneName},
           Expected{kApple, "cafe", Verdict::kUnsure, Reason::kNothing},
           Expected{kApple, "HUAWEI-77", Verdict::kUnsure, Reason::kNothing},
           Expected{kNobody | kLocal, "iPhone", Verdict::kMobile, Reason::kPhoneName},
           Expected{kNobody | kLocal, "cafe", Verdict::kUnsure, Reason::kNothing},
           Expected{kNobody, "iPhone", Verdict::kUnsure, Reason::kNameAlone},
           Expected{kCisco, "eduroam", Verdict::kFixed, Reason::kRouterVendor},
           Expected{kCisco, "", Verdict::kFixed, Reason::kRouterVendor},
           Expected{kCisco, "iPhone", Verdict::kUnsure, Reason::kConflict},
           Expected{kCisco | kLocal, "eduroam", Verdict::kUnsure, Reason::kNothing},
           Expected{kCisco | kLocal, "iPhone", Verdict::kMobile, Reason::kPhoneName},
       }) {
    const auto seen = classify(expected.address, expected.ssid);
    EXPECT_EQ(to_string(seen.verdict), std::string(to_string(expected.verdict))) << expected.ssid;
    EXPECT_EQ(to_string(seen.reason), std::string(to_string(expected.reason))) << expected.ssid;
  }
}

TEST(HotspotClassifier, TakesALocalAddressForAHintOnly) {
  EXPECT_EQ(classify(kCisco | kLocal, "eduroam").vendor, VendorKind::kRouter);
  EXPECT_EQ(classify(kApple | kLocal, "").vendor, VendorKind::kMixed);
}

TEST(HotspotClassifier, LeavesBluetoothAndColumnsAlone) {
  const HotspotClassifier classifier;
  EXPECT_EQ(classifier.classify(TransmitterId::bluetooth(kOppo), "iPhone").reason,
            Reason::kNotWifi);
  EXPECT_EQ(classifier.classify(TransmitterId::column(17), "").verdict, Verdict::kUnsure);
}

TEST(HotspotClassifier, KnowsTheNamesThatPhonesGive) {
  for (const char* name :
       {"AndroidAP", "AndroidAP_7731", "iPhone von Eva", "Eva's iPhone", "DIRECT-roku-12",
        "Galaxy S21 5G", "Galaxy A52", "Galaxy Note9", "Redmi Note 9", "HUAWEI P40", "vivo 1907"}) {
    EXPECT_EQ(classify(kNobody, name).name, NameKind::kPhone) << name;
  }
  for (const char* name : {"HUAWEI-B315", "Redmi_77A1", "HONOR-0A0B"}) {
    EXPECT_EQ(classify(kNobody, name).name, NameKind::kMixed) << name;
  }
  for (const char* name : {"", "eduroam", "iphone", "MyAndroidAP", "mall-free-wifi", "Galaxy Mall",
                           "my iPhone 7 shop", "HUAWE"}) {
    EXPECT_EQ(classify(kNobody, name).name, NameKind::kOther) << name;
  }
}

HotspotClassifier of_prefixes(std::vector<PrefixRule> rules) {
  return *HotspotClassifier::create({std::move(rules), {}});
}

TEST(HotspotClassifier, LetsTheLongestPrefixHold) {
  const HotspotClassifier classifier = of_prefixes({{"70B3D5", VendorKind::kMixed},
                                                    {"70b3d5a", VendorKind::kRouter},
                                                    {"70B3D5A12", VendorKind::kPhone}});
  const auto vendor = [&](std::uint64_t address) {
    return classifier.classify(TransmitterId::wifi(address), "").vendor;
  };
  EXPECT_EQ(vendor(0x70B3'D512'3456ULL), VendorKind::kMixed);
  EXPECT_EQ(vendor(0x70B3'D5A0'3456ULL), VendorKind::kRouter);
  EXPECT_EQ(vendor(0x70B3'D5A1'2456ULL), VendorKind::kPhone);
  EXPECT_EQ(vendor(0x70B3'D5A1'3456ULL), VendorKind::kRouter);
  EXPECT_EQ(vendor(0x70B3'D6A1'2456ULL), VendorKind::kUnknown);
}

TEST(HotspotClassifier, CanBeTaughtMore) {
  HotspotTables tables = HotspotTables::built_in();
  tables.prefixes.push_back({"00000C", VendorKind::kPhone});  // The last of equals holds.
  tables.names.push_back({"-van-", Place::kAnywhere, NameKind::kPhone});
  const auto classifier = HotspotClassifier::create(tables);
  ASSERT_TRUE(classifier);
  EXPECT_EQ(classifier->classify(TransmitterId::wifi(kCisco), "").verdict, Verdict::kMobile);
  EXPECT_EQ(classifier->classify(TransmitterId::wifi(kNobody | kLocal), "a-van-12").verdict,
            Verdict::kMobile);
}

TEST(HotspotClassifier, RefusesRulesThatCannotBeRead) {
  const auto refused = [](HotspotTables tables) { return !HotspotClassifier::create(tables); };
  EXPECT_FALSE(refused({}));
  EXPECT_FALSE(refused(HotspotTables::built_in()));
  EXPECT_TRUE(refused({{{"", VendorKind::kPhone}}, {}}));
  EXPECT_TRUE(refused({{{"00:11", VendorKind::kPhone}}, {}}));
  EXPECT_TRUE(refused({{{"0123456789ABC", VendorKind::kPhone}}, {}}));
  EXPECT_TRUE(refused({{}, {{"", Place::kStart, NameKind::kPhone}}}));
  EXPECT_TRUE(refused({{}, {{std::string(33, 'x'), Place::kStart, NameKind::kPhone}}}));
}

TEST(HotspotTables, NameEveryPrefixOnce) {
  std::vector<std::string> digits;
  for (const PrefixRule& rule : HotspotTables::built_in().prefixes) digits.push_back(rule.digits);
  std::ranges::sort(digits);
  EXPECT_GT(digits.size(), 1000U);
  EXPECT_EQ(std::ranges::adjacent_find(digits), digits.end());
}

RC_GTEST_PROP(HotspotClassifier, FindsTextsAsASlowSearchDoes, ()) {
  // Few letters, so that texts overlap and contain each other.
  const auto any_text = [](int longest) {
    std::string text;
    const int length = *rc::gen::inRange(1, longest + 1);
    for (int i = 0; i < length; ++i) text += *rc::gen::element('a', 'b', 'c');
    return text;
  };
  std::vector<NameRule> rules;
  for (int i = 0; i < 5; ++i) {
    rules.push_back({any_text(4), *rc::gen::element(Place::kAnywhere, Place::kStart, Place::kEnd),
                     *rc::gen::element(NameKind::kMixed, NameKind::kPhone)});
  }
  const std::string name = any_text(9);
  NameKind expected = NameKind::kOther;
  for (const NameRule& rule : rules) {
    const bool fits = rule.place == Place::kStart ? name.starts_with(rule.text)
                      : rule.place == Place::kEnd ? name.ends_with(rule.text)
                                                  : name.find(rule.text) != std::string::npos;
    if (fits) expected = std::max(expected, rule.kind);
  }
  const auto classifier = HotspotClassifier::create({{}, rules});
  RC_ASSERT(classifier.has_value());
  RC_ASSERT(classifier->classify(TransmitterId::wifi(1), name).name == expected);
}

}  // namespace
}  // namespace waylode::radio
