// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/bundle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "test_support.hpp"
#include "waylode/core/crc32.hpp"
#include "waylode/core/file.hpp"
#include "waylode/site/detail/bundle_layout.hpp"

namespace waylode::site {
namespace {

using core::ErrorCode;
using core::TransmitterId;
using core::Vector2;
using testing::HasSubstr;

SiteParts small_site() {
  SiteParts parts;
  parts.name = "hall";
  parts.origin = core::GeoPoint{30.1234567890123, 120.2};
  parts.floors.resize(2);
  Floor& floor = parts.floors[0];
  floor.name = "F1";
  floor.level = -3;
  floor.elevation_m = 0.1;
  floor.bounds = {Vector2(-1, -2), Vector2(20.5, 10.25)};
  floor.site_from_floor = {Eigen::Rotation2Dd(0.3).toRotationMatrix(), Vector2(1.0 / 3.0, 7)};
  floor.heading_offset_rad = -0.0123;
  const Polygon square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 2}}}};
  floor.plan.walkable = {square};
  floor.plan.obstacles = {{{{8, 8}, {9, 8}, {9, 9}}, {}}};
  floor.plan.walls = {{Vector2(0, 0), Vector2(4, 0.1)}};
  floor.plan.rooms = {{"caf\xC3\xA9", square}};
  parts.floors[1].name = "F2";
  RadioMapBuilder builder;
  builder.add({1.5F, 2.5F, 0.5F, 1, 0, 0}, {{TransmitterId::wifi(0xA), -40.0F, 0.3F}});
  builder.add({3.5F, 4.5F, 0.5F, 2, 1, 0},
              {{TransmitterId::wifi(0xB), -70.5F, 0.0F}, {TransmitterId::wifi(0xA), -60.0F, 0.0F}});
  parts.radio_map = builder.build();
  parts.magnetic_map.points = {{1.25F, -2.5F, 21.5F, -43.25F, 0.75F, 0, 9},
                               {3.5F, 4.25F, 30.0F, 12.0F, 0.0F, 1, 1}};
  return parts;
}

core::Result<std::shared_ptr<const Site>> parse(const std::string& bytes) {
  // Not std::string's own storage: short strings may sit at any address.
  const auto storage = std::make_shared<std::vector<std::uint64_t>>(bytes.size() / 8 + 1);
  std::memcpy(storage->data(), bytes.data(), bytes.size());
  return parse_bundle(std::as_bytes(std::span(*storage)).first(bytes.size()), storage, "x.wlsite");
}

/// Makes the checksums fit whatever was changed.
std::string resealed(std::string bytes, std::uint32_t format_version = kBundleFormatVersion) {
  detail::BundleHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  header.format_version = format_version;
  header.file_size = bytes.size();
  header.content_crc = core::crc32(std::as_bytes(std::span(bytes).subspan(sizeof(header))));
  header.header_crc = detail::header_crc(header);
  std::memcpy(bytes.data(), &header, sizeof(header));
  return bytes;
}

detail::SectionEntry entry_of(const std::string& bytes, std::string_view name) {
  for (std::size_t i = 0; i < 6; ++i) {
    detail::SectionEntry entry;
    std::memcpy(&entry, bytes.data() + 64 + 64 * i, sizeof(entry));
    if (name == entry.name.data()) return entry;
  }
  ADD_FAILURE() << "no section " << name;
  return {};
}

void expect_corrupt(const std::string& bytes, const std::string& words) {
  const auto site = parse(bytes);
  ASSERT_FALSE(site) << words;
  EXPECT_EQ(site.error().code, ErrorCode::kBundleCorrupt);
  EXPECT_THAT(site.error().message, HasSubstr(words));
  EXPECT_THAT(site.error().place, HasSubstr("x.wlsite"));
}

TEST(Bundle, GivesBackEveryPartExactly) {
  const test::TemporaryFolder folder;
  const SiteParts parts = small_site();
  const auto version = write_bundle(parts, folder.path() / "a.wlsite");
  ASSERT_TRUE(version);
  const auto site = load_bundle(folder.path() / "a.wlsite");
  ASSERT_TRUE(site) << core::to_string(site.error());
  EXPECT_EQ((*site)->name(), parts.name);
  EXPECT_EQ((*site)->origin(), parts.origin);
  EXPECT_EQ((*site)->floors(), parts.floors);
  EXPECT_EQ((*site)->version(), *version);
  const RadioMap& map = (*site)->radio_map();
  EXPECT_TRUE(std::ranges::equal(map.fingerprints, parts.radio_map.fingerprints));
  EXPECT_TRUE(std::ranges::equal(map.transmitters, parts.radio_map.transmitters));
  EXPECT_TRUE(std::ranges::equal(map.posting_begin, parts.radio_map.posting_begin));
  EXPECT_TRUE(std::ranges::equal(map.postings, parts.radio_map.postings));
  EXPECT_TRUE(std::ranges::equal((*site)->magnetic_map().points, parts.magnetic_map.points));
}

SiteParts site_with_passages() {
  SiteParts parts = small_site();
  parts.floors[0].plan.doors = {{Vector2(1.0 / 3.0, 2.25), 0.9}, {Vector2(4, 0), 1.8}};
  parts.floors[0].plan.connectors = {
      {ConnectorKind::kEscalator, "caf\xC3\xA9", Vector2(0.1, -2.5), {-2, 4}},
      {ConnectorKind::kLift, "", Vector2(7, 8), {}}};
  return parts;
}

std::uint32_t format_version_of(const std::string& bytes) {
  detail::BundleHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  return header.format_version;
}

TEST(Bundle, GivesBackDoorsAndConnectors) {
  const std::string bytes = format_bundle(site_with_passages()).value();
  EXPECT_EQ(format_version_of(bytes), 2U);
  const auto site = parse(bytes);
  ASSERT_TRUE(site) << core::to_string(site.error());
  EXPECT_EQ((*site)->floors(), site_with_passages().floors);
}

TEST(Bundle, StatesTheOldestFormatThatHoldsIt) {
  EXPECT_EQ(format_version_of(format_bundle(small_site()).value()), 1U);
  SiteParts parts = site_with_passages();
  parts.floors[0].plan.doors.clear();
  EXPECT_EQ(format_version_of(format_bundle(parts).value()), 2U);
}

TEST(Bundle, ReadsAFileOfFormat1) {
  // Written by the program that knew no other.
  const auto site = load_bundle(test::source_root() / "testdata/site_bundle/format_1.wlsite");
  ASSERT_TRUE(site) << core::to_string(site.error());
  EXPECT_EQ((*site)->floors(), small_site().floors);
  EXPECT_EQ((*site)->radio_map().postings.size(), 3U);
  EXPECT_EQ((*site)->magnetic_map().points.size(), 2U);
}

TEST(Bundle, RefusesDoorsAndConnectorsThatMakeNoSense) {
  const auto expect_refused = [](const SiteParts& parts, const std::string& words) {
    const auto bytes = format_bundle(parts);
    ASSERT_FALSE(bytes) << words;
    EXPECT_THAT(bytes.error().message, HasSubstr(words));
  };
  SiteParts parts = site_with_passages();
  parts.floors[0].plan.doors[1].width_m = 0.0;
  expect_refused(parts, "a door has no width");
  parts = site_with_passages();
  parts.floors[0].plan.doors[0].position_m.x() = std::nan("");
  expect_refused(parts, "no finite number");
  parts = site_with_passages();
  parts.floors[0].plan.connectors[1].position_m.y() = std::numeric_limits<double>::infinity();
  expect_refused(parts, "no finite number");
  parts = site_with_passages();
  parts.floors[0].plan.connectors[0].name = "\xFF";
  expect_refused(parts, "not UTF-8");
  std::string bytes = format_bundle(site_with_passages()).value();
  bytes.replace(bytes.find("escalator"), 9, "elevators");
  expect_corrupt(resealed(bytes), "a connector is of no known kind");
}

TEST(Bundle, HasOneVersionPerContent) {
  const SiteParts parts = small_site();
  EXPECT_EQ(format_bundle(parts).value(), format_bundle(parts).value());
  SiteParts other = small_site();
  other.floors[0].elevation_m += 1e-12;
  EXPECT_NE(parse(*format_bundle(parts)).value()->version(),
            parse(*format_bundle(other)).value()->version());
}

TEST(Bundle, HoldsASiteWithoutMapOrFloors) {
  SiteParts parts;
  parts.name = "empty";
  const auto bytes = format_bundle(parts);
  ASSERT_TRUE(bytes);
  const auto site = parse(*bytes);
  ASSERT_TRUE(site);
  EXPECT_TRUE((*site)->radio_map().empty());
  EXPECT_TRUE((*site)->radio_map().postings_of(TransmitterId::wifi(1)).empty());
}

TEST(Bundle, HasNoMagneticSectionWhereTheFieldWasNotSurveyed) {
  SiteParts parts = small_site();
  parts.magnetic_map.points.clear();
  const std::string bytes = format_bundle(parts).value();
  // As bundles were before there were magnetic maps: five sections.
  std::uint32_t section_count = 0;
  std::memcpy(&section_count, bytes.data() + 12, sizeof(section_count));
  EXPECT_EQ(section_count, 5U);
  const auto site = parse(bytes);
  ASSERT_TRUE(site);
  EXPECT_TRUE((*site)->magnetic_map().empty());
  EXPECT_FALSE((*site)->radio_map().empty());
}

TEST(Bundle, NoticesAChangeOfAnyByte) {
  const std::string bytes = format_bundle(small_site()).value();
  ASSERT_LT(bytes.size(), 10'000U);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    const auto site = parse(damaged);
    ASSERT_FALSE(site) << "byte " << i;
    ASSERT_EQ(site.error().code, ErrorCode::kBundleCorrupt) << "byte " << i;
  }
}

TEST(Bundle, NoticesTruncationAnywhere) {
  const std::string bytes = format_bundle(small_site()).value();
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const auto site = parse(bytes.substr(0, size));
    ASSERT_FALSE(site) << size;
    ASSERT_EQ(site.error().code, ErrorCode::kBundleCorrupt) << size;
  }
  expect_corrupt(bytes + "x", "bytes where its header says");
}

TEST(Bundle, SurvivesChangesThatTheChecksumsHide) {
  // Whatever such a file is taken for, it is read within its bounds (run under ASan in CI).
  const std::string bytes = format_bundle(small_site()).value();
  std::size_t refused = 0;
  for (std::size_t i = 64; i < bytes.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      const auto site = parse(resealed(changed));
      if (!site) {
        ++refused;
        ASSERT_EQ(site.error().code, ErrorCode::kBundleCorrupt);
      }
    }
  }
  EXPECT_GT(refused, 0U);
}

TEST(Bundle, NamesANewerFormatAsSuch) {
  expect_corrupt(resealed(format_bundle(small_site()).value(), kBundleFormatVersion + 1),
                 "use a newer waylode");
  expect_corrupt(resealed(format_bundle(small_site()).value(), 0), "never existed");
}

TEST(Bundle, ChecksEveryIndexOfTheRadioMap) {
  const std::string bytes = format_bundle(small_site()).value();
  const auto with = [&](std::string_view section, std::size_t at, auto value) {
    std::string changed = bytes;
    std::memcpy(changed.data() + entry_of(bytes, section).offset + at, &value, sizeof(value));
    return resealed(changed);
  };
  // Two fingerprints (floors 0, 1), transmitters A, B, lists [0, 2, 3], postings 0 1 | 1.
  expect_corrupt(with(detail::kFingerprintSection, 16, std::uint16_t{2}), "floor that does not");
  expect_corrupt(with(detail::kFingerprintSection, 36, std::uint16_t{9}), "floor that does not");
  expect_corrupt(with(detail::kFingerprintSection, 4, std::nanf("")), "no finite position");
  expect_corrupt(with(detail::kFingerprintSection, 8, -1.0F), "position sigma");
  expect_corrupt(with(detail::kTransmitterSection, 8, std::uint64_t{0xA}), "ascending");
  expect_corrupt(with(detail::kPostingBeginSection, 0, std::uint32_t{1}), "does not span");
  expect_corrupt(with(detail::kPostingBeginSection, 4, std::uint32_t{4}), "ascending");
  expect_corrupt(with(detail::kPostingBeginSection, 8, std::uint32_t{4}), "does not span");
  expect_corrupt(with(detail::kPostingSection, 16, std::uint32_t{2}), "fingerprint that does not");
  expect_corrupt(with(detail::kPostingSection, 8, std::uint32_t{0}), "order of fingerprints");
}

TEST(Bundle, ChecksEveryPointOfTheMagneticMap) {
  const std::string bytes = format_bundle(small_site()).value();
  const auto with = [&](std::size_t at, auto value) {
    std::string changed = bytes;
    std::memcpy(changed.data() + entry_of(bytes, detail::kMagneticSection).offset + at, &value,
                sizeof(value));
    return resealed(changed);
  };
  // Two points of 24 bytes, floors 0 and 1.
  expect_corrupt(with(0, std::nanf("")), "magnetic.points entry 0 has no finite position");
  expect_corrupt(with(28, std::numeric_limits<float>::infinity()),
                 "entry 1 has no finite position");
  expect_corrupt(with(8, -1.0F), "no usable field");
  expect_corrupt(with(36, std::nanf("")), "entry 1 has no usable field");
  expect_corrupt(with(16, -0.5F), "no usable sigma");
  expect_corrupt(with(44, std::uint16_t{2}), "entry 1 names a floor that does not exist");
  expect_corrupt(with(46, std::uint16_t{0}), "entry 1 averages no reading");
  SiteParts parts = small_site();
  std::swap(parts.magnetic_map.points[0], parts.magnetic_map.points[1]);
  const auto refused = format_bundle(parts);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("magnetic.points entry 1 is not in the order"));
}

TEST(Bundle, ChecksTheSectionTable) {
  const std::string bytes = format_bundle(small_site()).value();
  const auto with = [&](std::size_t at, std::uint64_t value) {
    std::string changed = bytes;
    std::memcpy(changed.data() + at, &value, sizeof(value));
    return resealed(changed);
  };
  expect_corrupt(with(64 + 32, 65), "not aligned");
  expect_corrupt(with(64 + 32, 64), "outside");  // within the table itself
  expect_corrupt(with(64 + 32, std::uint64_t{1} << 40U), "outside");
  expect_corrupt(with(64 + 40, std::numeric_limits<std::uint64_t>::max()), "outside");
  expect_corrupt(with(64, 0), "section site.json is missing");
  expect_corrupt(with(64 + 64 + 40, 39), "within an entry");
  expect_corrupt(with(64 + 5 * 64 + 40, 47), "magnetic.points ends within an entry");
}

TEST(Bundle, RefusesToWriteWhatCannotBeLoaded) {
  const auto expect_refused = [](const SiteParts& parts) {
    const auto bytes = format_bundle(parts);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().code, ErrorCode::kInvalidArgument);
  };
  SiteParts parts = small_site();
  parts.floors[0].elevation_m = std::nan("");
  expect_refused(parts);
  parts = small_site();
  parts.floors[0].name = "\xFF";
  expect_refused(parts);
  parts = small_site();
  parts.floors[1].name = parts.floors[0].name;
  expect_refused(parts);
  parts = small_site();
  parts.floors.pop_back();  // the radio map still names it
  expect_refused(parts);
  parts = small_site();
  parts.magnetic_map.points[1].floor = 2;
  expect_refused(parts);
  parts = small_site();
  parts.magnetic_map.points[0].count = 0;
  expect_refused(parts);
  parts = small_site();
  parts.floors[0].site_from_floor.linear.setZero();
  expect_refused(parts);
}

TEST(Bundle, LeavesNothingBehindWhenItCannotBeWritten) {
  const test::TemporaryFolder folder;
  const auto version = write_bundle(small_site(), folder.path() / "no" / "such" / "a.wlsite");
  ASSERT_FALSE(version);
  EXPECT_EQ(version.error().code, ErrorCode::kFileUnwritable);
  EXPECT_EQ(load_bundle(folder.path() / "a.wlsite").error().code, ErrorCode::kFileNotFound);
  ASSERT_TRUE(core::write_file_atomically(folder.path() / "e.wlsite", ""));
  EXPECT_EQ(load_bundle(folder.path() / "e.wlsite").error().code, ErrorCode::kBundleCorrupt);
}

}  // namespace
}  // namespace waylode::site
