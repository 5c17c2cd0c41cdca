// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "test_support.hpp"
#include "waylode/core/file.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::ErrorCode;
using core::Vector2;
using testing::HasSubstr;

constexpr const char* kSize = R"({"map_info": {"height": 20, "width": 40}})";

std::string collection(const std::string& features) {
  return R"({"type": "FeatureCollection", "features": [)" + features + "]}";
}
std::string polygon(const std::string& rings) {
  return R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": )" +
         rings + "}}";
}
const std::string kOutline =
    R"({"type": "Feature", "properties": {"category": "floor"}, "geometry": {"type": "MultiPolygon",
        "coordinates": [[[[120, 30], [120.0004, 30], [120.0004, 30.0002], [120, 30.0002],
                          [120, 30]]]]}})";
// Two shops side by side; they share the edge at longitude 120.0002.
const std::string kLeftShop = polygon(
    "[[[120.0001, 30.0001], [120.0002, 30.0001], [120.0002, 30.0002], [120.0001, 30.0002], "
    "[120.0001, 30.0001]]]");
const std::string kRightShop = polygon(
    "[[[120.0002, 30.0001], [120.0003, 30.0001], [120.0003, 30.0002], [120.0002, 30.0002], "
    "[120.0002, 30.0001]]]");

TEST(IlcFloor, ScalesTheOutlinesBoxToThePlansSize) {
  const auto draft =
      parse_ilc_floor(collection(kOutline + "," + kLeftShop), kSize, "F2", "map.json");
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->floor.name, "F2");
  EXPECT_EQ(draft->floor.level, 1);
  EXPECT_EQ(draft->floor.bounds, (core::Bounds2{Vector2(0, 0), Vector2(40, 20)}));
  ASSERT_EQ(draft->floor.plan.walkable.size(), 1U);
  ASSERT_EQ(draft->floor.plan.obstacles.size(), 1U);
  const Ring& shop = draft->floor.plan.obstacles[0].outer;
  ASSERT_EQ(shop.size(), 4U);
  // A quarter and a half of the way east, half and all of the way north.
  EXPECT_LT((shop[0] - Vector2(10, 10)).norm(), 1e-6);
  EXPECT_LT((shop[2] - Vector2(20, 20)).norm(), 1e-6);
  EXPECT_TRUE(draft->notes.empty());
}

TEST(IlcFloor, DrawsASharedEdgeOnce) {
  const auto draft = parse_ilc_floor(collection(kOutline + "," + kLeftShop + "," + kRightShop),
                                     kSize, "F1", "map.json");
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->floor.plan.walls.size(), 4U + 4U + 3U);
}

TEST(IlcFloor, IsGeoreferencedAtTheBoxCentre) {
  const auto draft = parse_ilc_floor(collection(kOutline), kSize, "F1", "map.json");
  ASSERT_TRUE(draft && draft->origin);
  EXPECT_NEAR(draft->origin->latitude_deg, 30.0001, 1e-9);
  EXPECT_NEAR(draft->origin->longitude_deg, 120.0002, 1e-9);
  const Vector2 corner_m = enu_from_geo(*draft->origin, {30.0002, 120.0004});
  EXPECT_LT((draft->enu_from_floor * Vector2(40, 20) - corner_m).norm(), 1e-3);
}

TEST(IlcFloor, LeavesOutWhatIsNoSoundPolygonAndSaysSo) {
  const std::string bow_tie = polygon(
      "[[[120.0001, 30.0001], [120.0002, 30.0002], [120.0002, 30.0001], [120.0001, 30.00018], "
      "[120.0001, 30.0001]]]");
  const std::string no_geometry = R"({"type": "Feature", "properties": {}, "geometry": null})";
  const auto draft =
      parse_ilc_floor(collection(kOutline + "," + bow_tie + "," + no_geometry + ", 7," + kLeftShop),
                      kSize, "F1", "map.json");
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->floor.plan.obstacles.size(), 1U);
  EXPECT_THAT(draft->notes, testing::UnorderedElementsAre(HasSubstr("feature 1 crosses itself"),
                                                          HasSubstr("feature 2 is no polygon"),
                                                          HasSubstr("feature 3 is no polygon")));
}

TEST(IlcFloor, RefusesFilesThatAreNoPlan) {
  const std::pair<std::string, std::string> cases[] = {
      {"", kSize},
      {"{", kSize},
      {"[]", kSize},
      {R"({"features": 3})", kSize},
      {collection(""), kSize},
      {collection(polygon("[[[1, 1], [1, 1]]]")), kSize},
      {collection(polygon("[[[1, 1], [2, 1], [3, 1]]]")), kSize},
      {collection(polygon("[[[1, 1], [200, 1], [3, 91]]]")), kSize},
      {collection(kOutline), "{}"},
      {collection(kOutline), R"({"map_info": {"height": 0, "width": 40}})"},
      {collection(kOutline), R"({"map_info": {"height": "x", "width": 40}})"},
      {collection(kOutline), R"({"map_info": {"height": 1e999, "width": 40}})"}};
  for (const auto& [geojson, size] : cases) {
    const auto draft = parse_ilc_floor(geojson, size, "F1", "map.json");
    ASSERT_FALSE(draft) << geojson << size;
    EXPECT_EQ(draft.error().code, ErrorCode::kPlanInvalid);
    EXPECT_THAT(draft.error().place, HasSubstr("map.json"));
  }
}

FloorDraft read_floor(const std::filesystem::path& folder) {
  const auto geojson = core::read_file(folder / "geojson_map.json");
  const auto size = core::read_file(folder / "floor_info.json");
  return parse_ilc_floor(geojson.value(), size.value(), folder.filename().string(), folder.string())
      .value();
}

TEST(IlcFloor, ReadsTheCompetitionsFloors) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  for (const char* site : {"site1", "site2"}) {
    for (const char* floor : {"B1", "F1", "F2", "F3", "F4"}) {
      const FloorDraft draft = read_floor(*root / "ilc" / site / floor);
      EXPECT_GE(draft.floor.plan.walkable.size(), 1U) << site << floor;
      EXPECT_GE(draft.floor.plan.obstacles.size(), 100U) << site << floor;
      EXPECT_TRUE(draft.notes.empty()) << draft.notes.front();
      // Published: plan size and geographic box agree within 2 m.
      const Vector2 box_m =
          draft.enu_from_floor.linear.diagonal().cwiseProduct(draft.floor.bounds.size_m());
      EXPECT_LT((box_m - draft.floor.bounds.size_m()).cwiseAbs().maxCoeff(), 2.0);
    }
  }
}

TEST(IlcFloor, BasementOfSite1HasItsOwnOrigin) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  std::optional<core::GeoPoint> origin;
  const auto floors =
      join_floors({read_floor(*root / "ilc/site1/F1"), read_floor(*root / "ilc/site1/B1")}, origin);
  ASSERT_TRUE(floors);
  const Vector2 offset_m =
      (*floors)[1].site_from_floor * Vector2(0, 0) - (*floors)[0].site_from_floor * Vector2(0, 0);
  // By hand from the outlines' least longitudes and latitudes: B1 starts west and south of F1.
  EXPECT_NEAR(offset_m.x(), -67.7, 1.5);
  EXPECT_NEAR(offset_m.y(), -54.0, 1.5);
}

}  // namespace
}  // namespace waylode::site
