// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/plan_geojson.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "test_support.hpp"
#include "waylode/core/file.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using core::ErrorCode;
using core::Vector2;
using testing::HasSubstr;

constexpr double kMillimetre_m = 0.001;

std::string plan(const std::string& head, const std::string& features = "") {
  return R"({"type": "FeatureCollection", "waylode": {)" + head + R"(}, "features": [)" + features +
         "]}";
}
std::string area(const std::string& kind, const std::string& coordinates) {
  return R"({"type": "Feature", "properties": {"kind": ")" + kind +
         R"("}, "geometry": {"type": "Polygon", "coordinates": )" + coordinates + "}}";
}
std::string line(const std::string& coordinates) {
  return R"({"type": "Feature", "properties": {"kind": "wall"}, "geometry": {"type": "LineString",
             "coordinates": )" +
         coordinates + "}}";
}
const std::string kHead = R"("format_version": 1, "floor": "F2", "bounds_m": [[0, 0], [40, 20]])";
const std::string kSquare = "[[[1, 1], [4, 1], [4, 5], [1, 5], [1, 1]]]";

void expect_close(const Ring& a, const Ring& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), kMillimetre_m);
}

void expect_close(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    expect_close(a[i].outer, b[i].outer);
    ASSERT_EQ(a[i].holes.size(), b[i].holes.size());
    for (std::size_t j = 0; j < a[i].holes.size(); ++j) {
      expect_close(a[i].holes[j], b[i].holes[j]);
    }
  }
}

void expect_round_trip(const FloorDraft& draft) {
  const auto again = parse_plan(format_plan(draft), "again");
  ASSERT_TRUE(again) << core::to_string(again.error());
  EXPECT_EQ(again->floor.name, draft.floor.name);
  EXPECT_EQ(again->floor.level, draft.floor.level);
  EXPECT_EQ(again->floor.elevation_m, draft.floor.elevation_m);
  expect_close(again->floor.plan.walkable, draft.floor.plan.walkable);
  expect_close(again->floor.plan.obstacles, draft.floor.plan.obstacles);
  ASSERT_EQ(again->floor.plan.walls.size(), draft.floor.plan.walls.size());
  for (std::size_t i = 0; i < draft.floor.plan.walls.size(); ++i) {
    const Wall& a = again->floor.plan.walls[i];
    const Wall& b = draft.floor.plan.walls[i];
    expect_close(Ring{a.from_m, a.to_m}, Ring{b.from_m, b.to_m});
  }
  ASSERT_EQ(again->origin.has_value(), draft.origin.has_value());
  if (!draft.origin) return;
  for (const Vector2& corner_m : {draft.floor.bounds.min_m, draft.floor.bounds.max_m}) {
    const core::GeoPoint geo = geo_from_enu(*draft.origin, draft.enu_from_floor * corner_m);
    const Vector2 expected_m = enu_from_geo(*again->origin, geo);
    EXPECT_LT((again->enu_from_floor * corner_m - expected_m).norm(), kMillimetre_m);
  }
}

TEST(PlanFormat, ReadsTheExample) {
  const auto path = test::source_root() / "contract/samples/plan.geojson";
  const auto draft = parse_plan(core::read_file(path).value(), path.string());
  ASSERT_TRUE(draft) << core::to_string(draft.error());
  EXPECT_EQ(draft->floor.name, "Ground floor");
  EXPECT_EQ(draft->floor.level, 0);
  EXPECT_EQ(draft->floor.elevation_m, 0.15);
  EXPECT_EQ(draft->floor.bounds, (core::Bounds2{Vector2(0, 0), Vector2(30, 12)}));
  EXPECT_EQ(draft->floor.plan.walkable.size(), 1U);
  EXPECT_EQ(draft->floor.plan.obstacles.size(), 1U);
  EXPECT_EQ(draft->floor.plan.walls, (std::vector<Wall>{{Vector2(10, 0), Vector2(10, 5)},
                                                        {Vector2(10, 5), Vector2(14, 5)}}));
  ASSERT_EQ(draft->floor.plan.rooms.size(), 1U);
  EXPECT_EQ(draft->floor.plan.rooms[0].name, "Reception");
  // Its two control points are 30 m apart on the floor and due east of each other on Earth.
  ASSERT_TRUE(draft->origin);
  EXPECT_NEAR(draft->enu_from_floor.linear(0, 0), 1.0, 1e-3);
  EXPECT_NEAR(draft->enu_from_floor.linear(1, 0), 0.0, 1e-3);
  expect_round_trip(*draft);
}

TEST(PlanFormat, TakesLevelFromTheNameWhenNotGiven) {
  const auto draft = parse_plan(plan(kHead), "p");
  ASSERT_TRUE(draft);
  EXPECT_EQ(draft->floor.level, 1);
  EXPECT_EQ(draft->floor.elevation_m, 0.0);
  EXPECT_FALSE(draft->origin);
  EXPECT_TRUE(draft->floor.plan.walkable.empty());
}

std::string passage(const std::string& properties, const std::string& geometry) {
  return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {)" + geometry +
         "}}";
}
const std::string kPoint = R"("type": "Point", "coordinates": [7, 3.5])";

TEST(PlanFormat, ReadsDoorsAndConnectors) {
  const std::string head = R"("format_version": 2, "floor": "F2", "bounds_m": [[0, 0], [40, 20]])";
  const auto draft = parse_plan(
      plan(head, passage(R"("kind": "door", "width_m": 0.9)", kPoint) + "," +
                     passage(R"("kind": "door")",
                             R"("type": "LineString", "coordinates": [[1, 2], [4, 6]])") +
                     "," + passage(R"("kind": "stairs", "name": "S", "levels": [-1, 1])", kPoint) +
                     "," + passage(R"("kind": "lift")", kPoint)),
      "p");
  ASSERT_TRUE(draft) << core::to_string(draft.error());
  EXPECT_EQ(draft->floor.plan.doors,
            (std::vector<Door>{{Vector2(7, 3.5), 0.9}, {Vector2(2.5, 4), 5.0}}));
  EXPECT_EQ(draft->floor.plan.connectors,
            (std::vector<Connector>{{ConnectorKind::kStairs, "S", Vector2(7, 3.5), {-1, 1}},
                                    {ConnectorKind::kLift, "", Vector2(7, 3.5), {}}}));
  EXPECT_THAT(format_plan(*draft), HasSubstr(R"("format_version":2)"));
  const auto again = parse_plan(format_plan(*draft), "again");
  ASSERT_TRUE(again) << core::to_string(again.error());
  EXPECT_EQ(again->floor.plan, draft->floor.plan);
}

TEST(PlanFormat, RefusesDoorsAndConnectorsThatMakeNoSense) {
  const std::string line_of_three =
      R"("type": "LineString", "coordinates": [[1, 1], [2, 2], [3, 3]])";
  const std::string no_line = R"("type": "LineString", "coordinates": [[1, 1], [1, 1]])";
  const std::string outside = R"("type": "Point", "coordinates": [7, 30])";
  const std::array<std::array<std::string, 3>, 11> kCases = {{
      {R"("kind": "door")", kPoint, "no width_m"},
      {R"("kind": "door", "width_m": 0)", kPoint, "no width_m"},
      {R"("kind": "door", "width_m": 101)", kPoint, "no width_m"},
      {R"("kind": "door", "width_m": "1")", kPoint, "no width_m"},
      {R"("kind": "door")", line_of_three, "jamb to jamb"},
      {R"("kind": "door")", no_line, "not above 0"},
      {R"("kind": "door")", R"("type": "Polygon", "coordinates": [])", "Point or LineString"},
      {R"("kind": "lift")", no_line, "must be a Point"},
      {R"("kind": "lift")", outside, "outside bounds_m"},
      {R"("kind": "lift", "levels": 3)", kPoint, "levels"},
      {R"("kind": "lift", "levels": [1.5])", kPoint, "levels"},
  }};
  for (const auto& [properties, geometry, words] : kCases) {
    const auto draft = parse_plan(plan(kHead, passage(properties, geometry)), "p");
    ASSERT_FALSE(draft) << words;
    EXPECT_EQ(draft.error().code, ErrorCode::kPlanInvalid);
    EXPECT_THAT(draft.error().message, HasSubstr(words));
    EXPECT_THAT(draft.error().place, HasSubstr("feature 0"));
  }
}

TEST(PlanFormat, RoundTripsToTheMillimetre) {
  FloorDraft draft = bare_floor("B2", {Vector2(-10.25, 3), Vector2(90.5, 61)});
  draft.floor.elevation_m = -7.3;
  draft.floor.plan.walkable = {{{{-10.12345, 3.1}, {90.0, 3.33333}, {89.98765, 60.0}, {-9.0, 59.0}},
                                {{{10.0, 10.0}, {10.0, 20.0}, {20.1, 20.2}}}}};
  draft.floor.plan.walls = {{Vector2(1.00004, 30.5), Vector2(22.2, 44.44444)}};
  draft.floor.plan.rooms = {{"\"Lab\" 7", {{{0, 30}, {5, 30}, {5, 35}}, {}}}};
  draft.origin = core::GeoPoint{-33.8568, 151.2153};
  draft.enu_from_floor = {Eigen::Rotation2Dd(2.1).toRotationMatrix(), Vector2(12, -40)};
  expect_round_trip(draft);
  const auto again = parse_plan(format_plan(draft), "again");
  EXPECT_EQ(again->floor.plan.rooms, draft.floor.plan.rooms);
}

TEST(PlanFormat, RoundTripsARealFloor) {
  const auto root = test::data_root();
  if (!root) GTEST_SKIP() << test::kNoData;
  for (const char* floor : {"site1/B1", "site1/F1", "site2/F4"}) {
    const auto folder = *root / "ilc" / floor;
    const auto geojson = core::read_file(folder / "geojson_map.json");
    const auto size = core::read_file(folder / "floor_info.json");
    const auto draft = parse_ilc_floor(geojson.value(), size.value(), "F1", floor);
    ASSERT_TRUE(draft);
    expect_round_trip(*draft);
  }
}

TEST(PlanFormat, FitsControlPoints) {
  // Three points, floor x pointing north: east = -y, north = x. 0.0001 deg of latitude at the
  // equator are 11.0574 m, of longitude 11.1319 m.
  const auto draft =
      parse_plan(plan(kHead + R"(, "control_points": [{"floor_m": [0, 0], "wgs84": [10, 0]},
                      {"floor_m": [11.0574, 0], "wgs84": [10, 0.0001]},
                      {"floor_m": [0, 11.1319], "wgs84": [9.9999, 0]}])"),
                 "p");
  ASSERT_TRUE(draft) << core::to_string(draft.error());
  core::Matrix2 expected;
  expected << 0, -1, 1, 0;
  EXPECT_LT((draft->enu_from_floor.linear - expected).norm(), 1e-4);
  // The origin is the centre of the bounds.
  EXPECT_LT((draft->enu_from_floor * Vector2(20, 10)).norm(), 1e-3);
}

struct BadPlan {
  std::string text;
  std::string words;
  std::string place;
};

void expect_refused(const BadPlan& bad) {
  const auto draft = parse_plan(bad.text, "plan.geojson");
  ASSERT_FALSE(draft) << bad.words;
  EXPECT_EQ(draft.error().code, ErrorCode::kPlanInvalid);
  EXPECT_THAT(draft.error().message, HasSubstr(bad.words));
  EXPECT_EQ(draft.error().place, bad.place);
}

TEST(PlanFormat, RefusesABadHead) {
  const std::string head = "plan.geojson member waylode";
  const std::string start = R"("format_version": 1, "floor": "F2", )";
  const BadPlan cases[] = {
      {"", "not valid JSON", "plan.geojson at byte 1"},
      {"[]", "no Waylode plan", "plan.geojson"},
      {R"({"features": []})", "no Waylode plan", "plan.geojson"},
      {plan(""), "no format_version", head},
      {plan(R"("format_version": 3)"), "format_version is not 1", head},
      {plan(R"("format_version": 1)"), "no floor", head},
      {plan(start + R"("bounds": 1)"), "unknown member bounds", head},
      {plan(start + R"("level": 1)"), "no bounds_m", head},
      {plan(start + R"("bounds_m": [[0, 0], [1]])"), "no two positions", head},
      {plan(start + R"("bounds_m": [[0, 5], [9, 5]])"), "enclose nothing", head},
      {plan(start + R"("bounds_m": [[0, 0], [1e9, 5]])"), "too much", head},
      {plan(kHead + R"(, "level": 1.5)"), "level is no integer", head},
      {plan(kHead + R"(, "level": 1e300)"), "level is no usable number", head},
      {plan(kHead + R"(, "elevation_m": "3")"), "elevation_m is no usable number", head},
      {plan(kHead + R"(, "elevation_m": 1e999)"), "out of range", "plan.geojson"}};
  for (const BadPlan& bad : cases) expect_refused(bad);
}

TEST(PlanFormat, RefusesBadControlPoints) {
  const auto with = [](const std::string& points) {
    return plan(kHead + R"(, "control_points": )" + points);
  };
  const std::string head = "plan.geojson member waylode";
  const std::string first = head + " control point 0";
  const std::string origin = R"({"floor_m": [0, 0], "wgs84": [10, 0]})";
  const BadPlan cases[] = {
      {with("[" + origin + "]"), "fewer than two", head},
      {with("[{}, {}]"), "lacks floor_m or wgs84", first},
      {with(R"([{"floor_m": 1, "wgs84": [1, 2]}, {}])"), "no usable pair", first},
      {with(R"([{"floor_m": [1, 2], "wgs84": [1, 91]}, {}])"), "longitude, latitude", first},
      {with("[" + origin + "," + origin + "]"), "coincide", head},
      {with("[" + origin + R"(, {"floor_m": [10, 0], "wgs84": [11, 0]}])"), "stretched", head},
      {with("[" + origin + R"(, {"floor_m": [11.1, 0], "wgs84": [9.9999, 0]},
                              {"floor_m": [0, 11.1], "wgs84": [10, 0.0001]}])"),
       "mirrored", head},
      {with("[" + origin + R"(, {"floor_m": [5, 5], "wgs84": [10.0001, 0]},
                              {"floor_m": [10, 10], "wgs84": [10, 0.0001]}])"),
       "one line", head}};
  for (const BadPlan& bad : cases) expect_refused(bad);
}

TEST(PlanFormat, RefusesABadFeatureAndNamesIt) {
  const auto after_a_good_one = [](const std::string& feature) {
    return plan(kHead, area("obstacle", kSquare) + "," + feature);
  };
  const std::string place = "plan.geojson feature 1";
  const BadPlan cases[] = {
      {after_a_good_one("3"), "no geometry", place},
      {after_a_good_one(area("gate", kSquare)), "kind is not", place},
      {after_a_good_one(area("room", kSquare)), "no name", place},
      {after_a_good_one(area("wall", kSquare)), "must be a LineString", place},
      {after_a_good_one(area("walkable", "[]")), "no ring", place},
      {after_a_good_one(area("walkable", "[[[1, 1], [2, 1], [1, 1]]]")), "fewer than four", place},
      {after_a_good_one(area("walkable", "[[[1, 1], [4, 1], [4, 5], [1, 5]]]")), "open", place},
      {after_a_good_one(area("walkable", "[[[1, 1], [4, 1], [4, \"5\"], [1, 1]]]")), "not [x, y]",
       place},
      {after_a_good_one(area("walkable", "[[[1, 1], [44, 1], [4, 5], [1, 1]]]")), "outside bounds",
       place},
      {after_a_good_one(area("walkable", "[[[1, 1], [5, 5], [5, 1], [1, 4], [1, 1]]]")),
       "crosses itself", place},
      {after_a_good_one(area("walkable", "[[[1, 1], [5, 5], [3, 3], [1, 1]]]")), "a polygon",
       place},
      {after_a_good_one(line("[[1, 1]]")), "fewer than two", place},
      {after_a_good_one(line("[[1, 1], [1, 1]]")), "repeats a position", place}};
  for (const BadPlan& bad : cases) expect_refused(bad);
}

}  // namespace
}  // namespace waylode::site
