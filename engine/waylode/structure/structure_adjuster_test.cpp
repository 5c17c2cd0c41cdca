// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/structure_adjuster.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "waylode/core/covariance.hpp"
#include "waylode/structure/testing/route_walks.hpp"

namespace waylode::structure {
namespace {

using core::radians_from_degrees;
using core::Vector2;
using testing::aligned;
using ::testing::Contains;
using testing::exact_walk;
using ::testing::HasSubstr;
using testing::noisy_walk;
using testing::Stop;
using testing::Walker;

using Options = StructureAdjuster::Options;

/// 20 m east, 15 m north, 14 m west: an open way with two right angles.
const std::vector<Stop> kHook = {
    {{0, 0}, "Door"}, {{20, 0}, "Lift"}, {{20, 15}, "Kiosk"}, {{6, 15}, "Stairs"}};

std::vector<Stop> unnamed(std::vector<Stop> stops) {
  for (Stop& stop : stops) stop.name.clear();
  return stops;
}

std::vector<Stop> backwards(std::vector<Stop> stops) {
  std::ranges::reverse(stops);
  return stops;
}

AdjustedStructure adjust(const Survey& survey, const Options& options = {}) {
  const auto structure = StructureAdjuster(options).adjust(survey);
  EXPECT_TRUE(structure) << core::to_string(structure.error());
  return structure.value_or(AdjustedStructure{});
}

/// Without what makes corners right and corridors parallel.
Options evidence_only() {
  Options options;
  options.corner_sigma_rad = 0.0;
  options.parallel_sigma_rad = 0.0;
  return options;
}

std::vector<Vector2> positions_of(const AdjustedStructure& structure) {
  std::vector<Vector2> positions_m;
  for (const StructureNode& node : structure.nodes) positions_m.push_back(node.position_m);
  return positions_m;
}

std::vector<Vector2> positions_of(const std::vector<Stop>& stops) {
  std::vector<Vector2> positions_m;
  for (const Stop& stop : stops) positions_m.push_back(stop.position_m);
  return positions_m;
}

void expect_nodes(const AdjustedStructure& structure, const std::vector<Stop>& stops,
                  double tolerance_m) {
  ASSERT_EQ(structure.nodes.size(), stops.size());
  for (std::size_t i = 0; i < stops.size(); ++i) {
    EXPECT_NEAR((structure.nodes[i].position_m - stops[i].position_m).norm(), 0.0, tolerance_m)
        << i;
  }
}

double turn_rad(const AdjustedStructure& structure, std::size_t edge) {
  return core::wrap_angle(structure.edges[edge].direction_rad -
                          structure.edges[edge - 1].direction_rad);
}

TEST(StructureAdjuster, GivesBackOneWalkScaledByTheKnownDistance) {
  const Walker walker{.offset_rad = 0.8, .reading_ratio = 0.97, .length_sigma_ratio = 1e-5};
  const Survey survey{{exact_walk(kHook, walker)}, {{"Lift", "Kiosk", 15.0, 0.001}}, {}};
  const AdjustedStructure structure = adjust(survey);
  EXPECT_TRUE(structure.converged);
  EXPECT_TRUE(structure.scale_known);
  // The prior of the scale, 3 % off its mean of one, pulls with 5 % against some 0.01 %.
  expect_nodes(structure, kHook, 1e-4);
  ASSERT_EQ(structure.walks.size(), 1U);
  EXPECT_NEAR(structure.walks[0].heading_offset_rad, 0.8, 1e-6);
  EXPECT_NEAR(structure.walks[0].scale_ratio, 1.0 / 0.97, 1e-5);
  EXPECT_THAT(structure.walks[0].nodes, ::testing::ElementsAre(0, 1, 2, 3));
  ASSERT_EQ(structure.edges.size(), 3U);
  EXPECT_NEAR(structure.edges[2].length_m, 14.0, 1e-4);
  EXPECT_NEAR(turn_rad(structure, 1), radians_from_degrees(90), 1e-6);
}

TEST(StructureAdjuster, RecoversManyExactWalksOfDifferentPeople) {
  Options options;
  options.landmark_sigma_m = 0.001;
  const auto person = [](double offset_rad, double reading_ratio) {
    return Walker{offset_rad, reading_ratio, 1e-5, 1e-4};
  };
  const Survey survey{{exact_walk(kHook, person(3.1, 0.97)), exact_walk(kHook, person(-2.0, 1.04)),
                       exact_walk(backwards(kHook), person(0.3, 0.91))},
                      {{"Door", "Stairs", std::hypot(6.0, 15.0), 0.001}},
                      {}};
  const AdjustedStructure structure = adjust(survey, options);
  // The priors of the scales, up to 9 % off, pull with 5 % against some 0.01 %.
  expect_nodes(structure, kHook, 1e-3);
  EXPECT_NEAR(structure.walks[1].scale_ratio, 1.0 / 1.04, 1e-4);
  EXPECT_NEAR(core::wrap_angle(structure.walks[1].heading_offset_rad -
                               structure.walks[0].heading_offset_rad),
              core::wrap_angle(-5.1), 2e-3);
  EXPECT_THAT(structure.walks[2].nodes, ::testing::ElementsAre(3, 2, 1, 0));
  EXPECT_EQ(structure.edges.size(), 3U);
  EXPECT_EQ(structure.edges[1].walked, 3U);
  EXPECT_EQ(structure.nodes[1].visits, 3U);
  EXPECT_TRUE(structure.rejected.empty());
}

TEST(StructureAdjuster, TellsWhenTheScaleIsNotKnown) {
  const std::vector<Walk> walks = {exact_walk(kHook, {.reading_ratio = 0.95}),
                                   exact_walk(kHook, {.offset_rad = 1.0, .reading_ratio = 0.95})};
  const AdjustedStructure loose = adjust({walks, {}, {}});
  EXPECT_FALSE(loose.scale_known);
  EXPECT_THAT(loose.notes, Contains(HasSubstr("no known distance")));
  // 5 % in common, and the mean of two persons' 3 %.
  EXPECT_NEAR(loose.scale_sigma_ratio, std::hypot(0.05, 0.03 / std::sqrt(2.0)), 1e-3);
  const AdjustedStructure bound = adjust({walks, {{"Door", "Lift", 20.0, 0.05}}, {}});
  EXPECT_TRUE(bound.scale_known);
  EXPECT_LT(bound.scale_sigma_ratio, 0.02);
  EXPECT_NEAR(bound.edges[0].length_m, 20.0, 0.01);
}

TEST(StructureAdjuster, LevelsContradictoryLengthsByTheirAccuracy) {
  // One straight corridor measured as 10 m +- 0.1 and 12 m +- 0.3, scales known to be one: the
  // weighted mean is (10 / 0.01 + 12 / 0.09) / (1 / 0.01 + 1 / 0.09) = 10.2.
  Survey survey{{exact_walk({{{0, 0}, "A"}, {{10, 0}, "B"}}, {}),
                 exact_walk({{{0, 0}, "A"}, {{12, 0}, "B"}}, {})},
                {},
                {}};
  survey.walks[0].segments[0].length_sigma_m = 0.1;
  survey.walks[1].segments[0].length_sigma_m = 0.3;
  Options options = evidence_only();
  options.scale_sigma_ratio = 0.001;
  options.person_sigma_ratio = 0.001;
  options.landmark_sigma_m = 0.001;
  options.segment_loss_sigma = 100.0;
  const AdjustedStructure structure = adjust(survey, options);
  ASSERT_EQ(structure.edges.size(), 1U);
  EXPECT_NEAR(structure.edges[0].length_m, 10.2, 0.01);
  // The weighted mean's own: 1 / sqrt(1 / 0.01 + 1 / 0.09).
  EXPECT_NEAR(structure.edges[0].length_sigma_m, 0.0949, 0.001);
}

TEST(StructureAdjuster, ClosesALoopByItsName) {
  // Back at the start, 1 m off by the last segment's length.
  std::vector<Stop> loop = {
      {{0, 0}, "Door"}, {{12, 0}, ""}, {{12, 9}, ""}, {{0, 9}, ""}, {{0, 0}, "Door"}};
  Survey survey{{exact_walk(loop, {.direction_sigma_rad = 0.001})}, {}, {}};
  survey.walks[0].segments[3].length_m = 8.0;
  Options options = evidence_only();
  options.landmark_sigma_m = 0.001;
  const AdjustedStructure structure = adjust(survey, options);
  ASSERT_EQ(structure.nodes.size(), 4U);
  EXPECT_EQ(structure.nodes[0].visits, 2U);
  ASSERT_EQ(structure.edges.size(), 4U);
  EXPECT_EQ(structure.edges[3].to, 0U);
  // Both north-south segments are equally exact and share the metre.
  EXPECT_NEAR(structure.edges[1].length_m, 8.5, 0.01);
  EXPECT_NEAR(structure.edges[3].length_m, 8.5, 0.01);
  EXPECT_TRUE(structure.rejected.empty());
}

TEST(StructureAdjuster, FindsThatAWalkCameBackWithoutNames) {
  core::Rng rng(7);
  const std::vector<Stop> loop = {
      {{0, 0}, ""}, {{22, 0}, ""}, {{22, 13}, ""}, {{0, 13}, ""}, {{0, 0}, ""}};
  const Survey survey{{noisy_walk(loop, {}, rng)}, {}, {}};
  const AdjustedStructure structure = adjust(survey);
  ASSERT_EQ(structure.found.size(), 1U);
  EXPECT_EQ(structure.found[0].first, (Visit{0, 0}));
  EXPECT_EQ(structure.found[0].second, (Visit{0, 4}));
  EXPECT_EQ(structure.nodes.size(), 4U);
  EXPECT_EQ(structure.edges.size(), 4U);
  Options options;
  options.find_closures = false;
  EXPECT_EQ(adjust(survey, options).nodes.size(), 5U);
}

TEST(StructureAdjuster, DoesNotCloseWhatLiesApart) {
  // Ends 4 m from its start: known to 2 % of some 70 m, a gap that cannot be chance.
  const std::vector<Stop> spiral = {
      {{0, 0}, ""}, {{22, 0}, ""}, {{22, 13}, ""}, {{0, 13}, ""}, {{0, 4.5}, ""}};
  const AdjustedStructure structure = adjust(
      {{exact_walk(spiral, {.length_sigma_ratio = 0.01, .direction_sigma_rad = 0.01})}, {}, {}});
  EXPECT_TRUE(structure.found.empty());
  EXPECT_EQ(structure.nodes.size(), 5U);
}

TEST(StructureAdjuster, RejectsALoopThatIsNone) {
  // The end is called like the start, 15 m away from it.
  std::vector<Stop> hook = kHook;
  hook.back().name = "Door";
  const AdjustedStructure structure =
      adjust({{exact_walk(hook, {})}, {{"Door", "Lift", 20.0, 0.01}}, {}});
  ASSERT_EQ(structure.rejected.size(), 1U);
  EXPECT_EQ(structure.rejected[0].landmark, "Door");
  EXPECT_EQ(structure.rejected[0].first, (Visit{0, 0}));
  EXPECT_EQ(structure.rejected[0].second, (Visit{0, 3}));
  EXPECT_NEAR(structure.rejected[0].gap_m, std::hypot(6.0, 15.0), 0.1);
  ASSERT_EQ(structure.nodes.size(), 4U);
  EXPECT_EQ(structure.nodes[0].landmark, "Door");
  EXPECT_EQ(structure.nodes[3].landmark, "");
  expect_nodes(structure, kHook, 0.05);
}

TEST(StructureAdjuster, RejectsAWrongNameAmongManyWalks) {
  // On one of ten walks the third stop is given the name of the second.
  core::Rng rng(11);
  Survey survey{{}, {{"Door", "Lift", 20.0, 0.02}}, {}};
  std::vector<Stop> mistaken = unnamed(kHook);
  mistaken[0].name = "Door";
  mistaken[2].name = "Lift";
  mistaken[3].name = "Stairs";
  for (int i = 0; i < 10; ++i) {
    const Walker walker{.offset_rad = rng.uniform(-3.0, 3.0),
                        .reading_ratio = rng.normal(0.975, 0.03)};
    survey.walks.push_back(noisy_walk(i == 4 ? mistaken : kHook, walker, rng));
  }
  Options options;
  options.match_routes = false;
  const AdjustedStructure structure = adjust(survey, options);
  ASSERT_EQ(structure.rejected.size(), 1U);
  EXPECT_EQ(structure.rejected[0].second, (Visit{4, 2}));
  EXPECT_EQ(structure.rejected[0].landmark, "Lift");
  const std::vector<Vector2> truth_m = positions_of(kHook);
  std::vector<Vector2> found_m = positions_of(structure);
  ASSERT_GE(found_m.size(), 4U);
  found_m.resize(4);
  const auto on_truth_m = aligned(found_m, truth_m);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((on_truth_m[i] - truth_m[i]).norm(), 0.6) << i;
}

TEST(StructureAdjuster, JoinsWalksOverOneRouteWithoutNames) {
  core::Rng rng(3);
  Survey survey;
  for (int i = 0; i < 6; ++i) {
    const Walker walker{.offset_rad = rng.uniform(-3.0, 3.0),
                        .reading_ratio = rng.normal(0.97, 0.03)};
    const std::vector<Stop> way = i % 2 == 0 ? kHook : backwards(kHook);
    survey.walks.push_back(noisy_walk(unnamed(way), walker, rng));
  }
  const AdjustedStructure structure = adjust(survey);
  ASSERT_EQ(structure.nodes.size(), 4U);
  EXPECT_EQ(structure.edges.size(), 3U);
  EXPECT_EQ(structure.edges[1].walked, 6U);
  EXPECT_THAT(structure.walks[1].nodes, ::testing::ElementsAre(3, 2, 1, 0));
  Options options;
  options.match_routes = false;
  EXPECT_LT(adjust(survey, options).edges[0].walked, 6U);
}

TEST(StructureAdjuster, DoesNotJoinRoutesThatTurnTheOtherWay) {
  std::vector<Stop> mirrored = kHook;
  for (Stop& stop : mirrored) stop.position_m.y() *= -1.0;
  const Survey survey{{exact_walk(unnamed(kHook), {}), exact_walk(unnamed(mirrored), {})}, {}, {}};
  const AdjustedStructure structure = adjust(survey);
  EXPECT_TRUE(structure.walks[0].used);
  EXPECT_FALSE(structure.walks[1].used);
  EXPECT_THAT(structure.notes, Contains(HasSubstr("walk 1 shares fewer than two places")));
}

TEST(StructureAdjuster, SaysWhenARouteFitsBothWays) {
  // 10 m, left, 10 m, right, 10 m looks the same from its other end.
  const std::vector<Stop> step = {{{0, 0}, ""}, {{10, 0}, ""}, {{10, 10}, ""}, {{20, 10}, ""}};
  const AdjustedStructure structure =
      adjust({{exact_walk(step, {}), exact_walk(step, {})}, {}, {}});
  EXPECT_EQ(structure.nodes.size(), 4U);
  EXPECT_THAT(structure.notes, Contains(HasSubstr("both ways")));
}

TEST(StructureAdjuster, JoinsUnnamedCornersBetweenNamedEnds) {
  std::vector<Stop> ends = unnamed(kHook);
  ends.front().name = "Door";
  ends.back().name = "Stairs";
  // The second walk goes on; as a whole it is another route.
  std::vector<Stop> longer = ends;
  longer.push_back({{6, 40}, "Roof"});
  const AdjustedStructure structure =
      adjust({{exact_walk(ends, {}), exact_walk(longer, {.offset_rad = 2.0})}, {}, {}});
  EXPECT_EQ(structure.nodes.size(), 5U);
  EXPECT_EQ(structure.edges.size(), 4U);
  EXPECT_EQ(structure.edges[1].walked, 2U);
}

TEST(StructureAdjuster, MakesNearlyRightCornersRightAndLeavesObliqueOnes) {
  Survey survey{{exact_walk(kHook, {})}, {}, {}};
  survey.walks[0].segments[1].direction_rad += radians_from_degrees(3);
  survey.walks[0].segments[2].direction_rad += radians_from_degrees(2);
  // One right angle is bound to 1 degree, one walk's turn to 2.4: most of the 3 degrees go.
  const AdjustedStructure structure = adjust(survey);
  EXPECT_NEAR(turn_rad(structure, 1), radians_from_degrees(90), radians_from_degrees(0.8));
  EXPECT_NEAR(turn_rad(adjust(survey, evidence_only()), 1), radians_from_degrees(93), 1e-6);

  survey.walks[0].segments[1].direction_rad = radians_from_degrees(60);
  survey.walks[0].segments[2].direction_rad = radians_from_degrees(130);
  EXPECT_NEAR(turn_rad(adjust(survey), 1), radians_from_degrees(60), 1e-3);
}

TEST(StructureAdjuster, LetsManyWalksOutvoteTheWishForRightAngles) {
  // A corner of 81 degrees is within the tolerance of a right one; ten good walks say otherwise.
  const Vector2 out(std::cos(radians_from_degrees(81)), std::sin(radians_from_degrees(81)));
  const std::vector<Stop> bend = {
      {{0, 0}, "A"}, {{20, 0}, "B"}, {Vector2(20, 0) + 15.0 * out, "C"}};
  core::Rng rng(5);
  Survey survey;
  for (int i = 0; i < 10; ++i) {
    survey.walks.push_back(noisy_walk(bend, {.offset_rad = rng.uniform(-3.0, 3.0)}, rng));
  }
  EXPECT_NEAR(turn_rad(adjust(survey), 1), radians_from_degrees(81), radians_from_degrees(2.0));
}

TEST(StructureAdjuster, BearsDirectionsAcrossFullTurns) {
  // The same walk told with directions near +-180 and beyond 360 degrees.
  const Walk plain = exact_walk(kHook, {.offset_rad = 1e-3});
  Walk wrapped = exact_walk(kHook, {.offset_rad = 1e-3 + core::kPi});
  wrapped.segments[1].direction_rad += 4.0 * core::kPi;
  wrapped.segments[2].direction_rad -= 2.0 * core::kPi;
  const AdjustedStructure structure = adjust({{plain, wrapped}, {{"Door", "Lift", 20, 0.01}}, {}});
  expect_nodes(structure, kHook, 1e-6);
  EXPECT_NEAR(structure.cost, 0.0, 1e-12);
}

TEST(StructureAdjuster, KeepsLandmarksNotesAtTheirNodes) {
  const Survey survey{{exact_walk(kHook, {})},
                      {},
                      {{"Lift", "to all floors"}, {"Nowhere", "x"}, {"Lift", "photo 17.jpg"}}};
  const AdjustedStructure structure = adjust(survey);
  EXPECT_THAT(structure.nodes[1].notes, ::testing::ElementsAre("to all floors", "photo 17.jpg"));
  EXPECT_THAT(structure.notes, Contains(HasSubstr("Nowhere")));
}

TEST(StructureAdjuster, TakesASegmentOfNoLengthForStanding) {
  std::vector<Stop> stops = kHook;
  stops.insert(stops.begin() + 1, {kHook[1].position_m, ""});
  const AdjustedStructure structure =
      adjust({{exact_walk(stops, {}), exact_walk(kHook, {})}, {{"Door", "Lift", 20, 0.01}}, {}});
  expect_nodes(structure, kHook, 1e-3);
  EXPECT_THAT(structure.walks[0].nodes, ::testing::ElementsAre(0, 1, 1, 2, 3));
}

TEST(StructureAdjuster, KeepsTwoNamesForOnePlaceApartWithoutHarm) {
  std::vector<Stop> stops = kHook;
  stops.insert(stops.begin() + 1, {kHook[1].position_m, "Lift door"});
  const AdjustedStructure structure =
      adjust({{exact_walk(stops, {})}, {{"Lift door", "Lift", 0.4, 0.01}}, {}});
  ASSERT_EQ(structure.nodes.size(), 5U);
  for (const StructureNode& node : structure.nodes) EXPECT_TRUE(node.position_m.allFinite());
}

TEST(StructureAdjuster, LeavesOutWhatHangsByOnePlace) {
  const Survey survey{
      {exact_walk(kHook, {}), Walk{}, exact_walk({{{0, 0}, "Lift"}, {{5, 9}, "Cellar"}}, {})},
      {{"Lift", "Cellar", 10.0, 0.1}},
      {}};
  const AdjustedStructure structure = adjust(survey);
  EXPECT_FALSE(structure.walks[1].used);
  EXPECT_FALSE(structure.walks[2].used);
  EXPECT_FALSE(structure.scale_known);
  EXPECT_THAT(structure.notes, Contains(HasSubstr("walk 1 has no segment")));
  EXPECT_THAT(structure.notes, Contains(HasSubstr("walk 2 shares fewer")));
  EXPECT_THAT(structure.notes, Contains(HasSubstr("Lift:Cellar")));
  EXPECT_GT(structure.nodes[2].covariance_m2.trace(), 0.0);
}

TEST(StructureAdjuster, RefusesToBuildFromNothing) {
  const StructureAdjuster adjuster{Options{}};
  EXPECT_EQ(adjuster.adjust({}).error().code, core::ErrorCode::kSurveyInsufficient);
  EXPECT_EQ(adjuster.adjust({{Walk{}}, {}, {}}).error().code, core::ErrorCode::kSurveyInsufficient);
  const Walk standing = exact_walk({{{0, 0}, "A"}, {{0, 0}, "B"}}, {});
  EXPECT_EQ(adjuster.adjust({{standing}, {}, {}}).error().code,
            core::ErrorCode::kSurveyInsufficient);
}

TEST(StructureAdjuster, RefusesASurveyThatIsNotValid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Survey good{{exact_walk(kHook, {})}, {{"Door", "Lift", 20, 0.01}}, {}};
  const auto code_of = [](const Survey& survey) {
    return StructureAdjuster(Options{}).adjust(survey).error().code;
  };
  for (double WalkedSegment::* const number :
       {&WalkedSegment::length_m, &WalkedSegment::length_sigma_m, &WalkedSegment::direction_rad,
        &WalkedSegment::direction_sigma_rad}) {
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
      Survey survey = good;
      survey.walks[0].segments[1].*number = bad;
      EXPECT_EQ(code_of(survey), core::ErrorCode::kInvalidArgument);
    }
  }
  for (const double bad : {nan, 0.0, -3.0}) {
    Survey survey = good;
    survey.known_distances[0].metres = bad;
    EXPECT_EQ(code_of(survey), core::ErrorCode::kInvalidArgument);
  }
  Survey survey = good;
  survey.walks[0].segments[0].length_m = -1.0;
  EXPECT_EQ(code_of(survey), core::ErrorCode::kInvalidArgument);
  survey = good;
  survey.walks[0].segments[1].begin_landmark = "Not the lift";
  EXPECT_EQ(code_of(survey), core::ErrorCode::kInvalidArgument);
  survey = good;
  std::swap(survey.walks[0].segments[1].begin, survey.walks[0].segments[1].end);
  EXPECT_EQ(code_of(survey), core::ErrorCode::kInvalidArgument);
  survey = good;
  survey.known_distances[0].to = "Nowhere";
  EXPECT_EQ(code_of(survey), core::ErrorCode::kInvalidArgument);
}

TEST(StructureAdjuster, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Options{}.validate());
  Options options;
  options.scale_sigma_ratio = 0.0;
  EXPECT_EQ(options.validate().error().code, core::ErrorCode::kInvalidOptions);
  options = {};
  options.closure_reach_m = nan;
  EXPECT_EQ(StructureAdjuster(options).adjust({{exact_walk(kHook, {})}, {}, {}}).error().code,
            core::ErrorCode::kInvalidOptions);
  options = {};
  options.starts = 0;
  EXPECT_FALSE(options.validate());
}

TEST(StructureAdjusterConsistency, StatesNodeErrorsHonestly) {
  // Walks as the model has them: scales and segments Gaussian, landmarks met exactly.
  Options options = evidence_only();
  options.landmark_sigma_m = 0.001;
  options.segment_loss_sigma = 100.0;
  const std::vector<Vector2> truth_m = positions_of(kHook);
  constexpr int kRuns = 150;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    core::Rng rng(900 + static_cast<std::uint64_t>(run));
    Survey survey{{}, {{"Door", "Lift", rng.normal(20.0, 0.1), 0.1}}, {}};
    const double common_ratio = rng.normal(1.0, 0.05);
    for (int i = 0; i < 4; ++i) {
      const Walker walker{.offset_rad = rng.uniform(-3.0, 3.0),
                          .reading_ratio = common_ratio + rng.normal(0.0, 0.03)};
      survey.walks.push_back(noisy_walk(kHook, walker, rng));
    }
    const AdjustedStructure structure = adjust(survey, options);
    ASSERT_EQ(structure.nodes.size(), 4U);
    const auto on_truth_m = aligned(positions_of(structure), truth_m);
    // Bring each covariance into the true frame: the structure's first edge lies along +x.
    const Vector2 along_m = on_truth_m[1] - on_truth_m[0];
    const core::Matrix2 rotation =
        Eigen::Rotation2Dd(std::atan2(along_m.y(), along_m.x())).toRotationMatrix();
    for (std::size_t i = 0; i < 4; ++i) {
      const core::Matrix2 covariance_m2 =
          rotation * structure.nodes[i].covariance_m2 * rotation.transpose();
      sum += core::squared_mahalanobis(on_truth_m[i] - truth_m[i], covariance_m2) / 4.0;
    }
  }
  // Two degrees of freedom; the mean over four nodes has at most the variance 4 of one: 3.3 sigmas
  // of the mean over 150 runs are 0.54.
  EXPECT_NEAR(sum / kRuns, 2.0, 0.54);
}

}  // namespace
}  // namespace waylode::structure
