// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/site.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "waylode/core/angle.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::FloorId;
using core::GeoPoint;
using core::Vector2;

constexpr GeoPoint kHangzhou{30.2895, 120.0731};

core::Affine2 rotation_and_shift(double angle_rad, const Vector2& shift_m) {
  return {Eigen::Rotation2Dd(angle_rad).toRotationMatrix(), shift_m};
}

SiteParts two_floors() {
  SiteParts parts;
  parts.name = "hall";
  parts.origin = kHangzhou;
  parts.floors.resize(2);
  parts.floors[0].name = "F1";
  parts.floors[1].name = "B1";
  parts.floors[1].site_from_floor = rotation_and_shift(0.5 * core::kPi, Vector2(67.0, 54.0));
  return parts;
}

TEST(TangentPlane, AgreesWithTheEllipsoidAtTheEquator) {
  // Meridian radius a (1 - e^2) = 6335439.327 m and equatorial radius 6378137 m of WGS-84.
  const Vector2 north_m = enu_from_geo({0, 10}, {0.001, 10});
  EXPECT_NEAR(north_m.y(), 6335439.327 * core::radians_from_degrees(0.001), 1e-4);
  EXPECT_NEAR(north_m.y(), 110.574, 5e-4);
  EXPECT_NEAR(north_m.x(), 0.0, 1e-9);
  const Vector2 east_m = enu_from_geo({0, 10}, {0, 10.001});
  EXPECT_NEAR(east_m.x(), 6378137.0 * std::sin(core::radians_from_degrees(0.001)), 1e-6);
  EXPECT_NEAR(east_m.y(), 0.0, 1e-9);
}

TEST(TangentPlane, ComesBackWithinMicrometres) {
  for (const Vector2& point_m : {Vector2(0, 0), Vector2(500, -320), Vector2(-17, 444)}) {
    const Vector2 again_m = enu_from_geo(kHangzhou, geo_from_enu(kHangzhou, point_m));
    EXPECT_LT((again_m - point_m).norm(), 5e-6);
  }
}

TEST(TangentPlane, KnowsWhatIsNoPosition) {
  EXPECT_TRUE(is_valid_geo_point({-90, 180}));
  EXPECT_FALSE(is_valid_geo_point({90.5, 0}));
  EXPECT_FALSE(is_valid_geo_point({0, -181}));
  EXPECT_FALSE(is_valid_geo_point({std::nan(""), 0}));
}

TEST(Site, FindsFloorsByName) {
  const Site site(two_floors());
  EXPECT_EQ(site.find_floor("B1"), FloorId{1});
  EXPECT_EQ(site.find_floor("F9"), std::nullopt);
}

TEST(Site, MapsFloorsBothWays) {
  const Site site(two_floors());
  // A quarter turn takes (10, 2) to (-2, 10), then the shift.
  const Vector2 site_m = site.site_from_floor(FloorId{1}, Vector2(10, 2));
  EXPECT_LT((site_m - Vector2(65, 64)).norm(), 1e-12);
  EXPECT_LT((site.floor_from_site(FloorId{1}, site_m) - Vector2(10, 2)).norm(), 1e-12);
}

TEST(Site, MeasuresBetweenFloorsInTheCommonFrame) {
  const Site site(two_floors());
  EXPECT_NEAR(site.horizontal_distance_m(FloorId{0}, Vector2(65, 64), FloorId{1}, Vector2(10, 2)),
              0.0, 1e-12);
  EXPECT_NEAR(site.horizontal_distance_m(FloorId{0}, Vector2(68, 68), FloorId{1}, Vector2(10, 2)),
              5.0, 1e-12);
}

TEST(Site, ConvertsThroughWgs84) {
  const Site site(two_floors());
  const auto geo = site.geo_from_floor(FloorId{1}, Vector2(10, 2));
  ASSERT_TRUE(geo);
  const Vector2 enu_m = enu_from_geo(kHangzhou, *geo);
  EXPECT_LT((enu_m - Vector2(65, 64)).norm(), 1e-5);
  const auto again_m = site.floor_from_geo(FloorId{1}, *geo);
  ASSERT_TRUE(again_m);
  EXPECT_LT((*again_m - Vector2(10, 2)).norm(), 1e-5);
}

TEST(Site, HasNoWgs84WithoutOrigin) {
  SiteParts parts = two_floors();
  parts.origin.reset();
  const Site site(std::move(parts));
  EXPECT_FALSE(site.geo_from_floor(FloorId{0}, Vector2(1, 2)));
  EXPECT_FALSE(site.floor_from_geo(FloorId{0}, kHangzhou));
}

TEST(Site, KeepsItsRadioMapWhenMoved) {
  SiteParts parts = two_floors();
  parts.radio_map.fingerprints.push_back({1.5F, 2.5F, 0.5F, 3, 1, 0});
  Site first(std::move(parts));
  const Site second(std::move(first));
  ASSERT_EQ(second.radio_map().fingerprints.size(), 1U);
  EXPECT_EQ(second.radio_map().fingerprints[0].recording, 3U);
}

FloorDraft draft_at(const std::string& name, const GeoPoint& origin, double angle_rad) {
  FloorDraft draft = bare_floor(name, {Vector2(0, 0), Vector2(500, 400)});
  draft.origin = origin;
  draft.enu_from_floor = rotation_and_shift(angle_rad, Vector2(-250, -200));
  return draft;
}

TEST(JoinFloors, MeetThroughWgs84WithinACentimetreOver500m) {
  const GeoPoint other{kHangzhou.latitude_deg + 0.003, kHangzhou.longitude_deg - 0.004};
  std::optional<GeoPoint> origin;
  const std::vector<FloorDraft> drafts{bare_floor("bare", {}), draft_at("F1", kHangzhou, 0.2),
                                       draft_at("F2", other, -0.7)};
  auto floors = join_floors(drafts, origin);
  ASSERT_TRUE(floors);
  ASSERT_EQ(origin, kHangzhou);
  EXPECT_EQ((*floors)[0].site_from_floor, core::Affine2{});
  EXPECT_EQ((*floors)[1].site_from_floor, drafts[1].enu_from_floor);
  for (const Vector2& point_m : {Vector2(0, 0), Vector2(500, 400), Vector2(250, 200)}) {
    const GeoPoint geo = geo_from_enu(other, drafts[2].enu_from_floor * point_m);
    const Vector2 expected_m = enu_from_geo(*origin, geo);
    EXPECT_LT(((*floors)[2].site_from_floor * point_m - expected_m).norm(), 0.01);
  }
}

TEST(JoinFloors, RefusesAnAmbiguousName) {
  std::optional<GeoPoint> origin;
  const auto floors = join_floors({bare_floor("F1", {}), bare_floor("F1", {})}, origin);
  ASSERT_FALSE(floors);
  EXPECT_EQ(floors.error().code, core::ErrorCode::kPlanInvalid);
  EXPECT_EQ(floors.error().place, "F1");
}

TEST(LevelOfFloorName, ReadsTheUsualSpellings) {
  const std::pair<const char*, int> cases[] = {
      {"F1", 0},   {"F2", 1},  {"f12", 11}, {"1F", 0},   {"3F", 2},  {"L1", 0},
      {"L2", 1},   {"B1", -1}, {"b2", -2},  {"B1F", -1}, {"-2", -2}, {"0", 0},
      {"3", 3},    {"+1", 1},  {"G", 0},    {"GF", 0},   {"LG", -1}, {"", 0},
      {"Roof", 0}, {"F", 0},   {"B", 0},    {"B-1", 0},  {"F1x", 0}, {"99999999999", 0}};
  for (const auto& [name, level] : cases) EXPECT_EQ(level_of_floor_name(name), level) << name;
}

}  // namespace
}  // namespace waylode::site
