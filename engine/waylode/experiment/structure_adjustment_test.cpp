// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/structure_adjustment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::experiment {
namespace {

TEST(StructureAdjustment, SimulatesWalksWithTheStatisticsAskedFor) {
  core::Rng rng(4);
  const StructureRoute route;
  const WalkStatistics statistics;
  double ratio = 0.0;
  double squares = 0.0;
  double corner_deg = 0.0;
  constexpr int kWalks = 4000;
  for (const structure::Walk& walk : simulate_walks(route, statistics, kWalks, rng)) {
    ASSERT_EQ(walk.segments.size(), 3U);
    const double of_first = walk.segments[0].length_m / 20.0;
    ratio += of_first / kWalks;
    squares += (of_first - 0.975) * (of_first - 0.975) / kWalks;
    corner_deg +=
        std::abs(core::degrees_from_radians(core::wrap_angle(
            walk.segments[1].direction_rad - walk.segments[0].direction_rad - 0.5 * core::kPi))) /
        kWalks;
  }
  // Four standard errors.
  EXPECT_NEAR(ratio, 0.975, 0.0023);
  EXPECT_NEAR(std::sqrt(squares), std::hypot(0.03, 0.02), 0.0017);
  EXPECT_NEAR(corner_deg, 2.6, 0.125);
}

TEST(StructureAdjustment, FindsNoErrorInWalksWithoutAny) {
  core::Rng rng(8);
  StructureAdjustmentOptions options;
  options.walks_per_draw = 2;
  options.draws = 2;
  const WalkStatistics exact{0.0, 0.0, 1e-6, 1e-4};
  const auto study =
      study_structure_adjustment(simulate_walks(options.route, exact, 3, rng), options);
  ASSERT_TRUE(study) << core::to_string(study.error());
  for (const RouteErrors& errors :
       {study->single, study->mean, study->scaled_mean, study->evidence, study->adjusted}) {
    EXPECT_LT(errors.length_pct.value, 1e-3);
    EXPECT_LT(errors.corner_deg.value, 1e-3);
  }
}

TEST(StructureAdjustment, ReachesTheBarsOnTenSimulatedWalks) {
  core::Rng rng(2017);
  StructureAdjustmentOptions options;
  options.draws = 8;
  const auto study = study_structure_adjustment(
      simulate_walks(options.route, WalkStatistics{}, 80, rng), options);
  ASSERT_TRUE(study) << core::to_string(study.error());
  // What does not average out: the common -2.5 % bias.
  EXPECT_NEAR(study->mean.length_pct.value, 2.5, 0.8);
  EXPECT_LT(study->evidence.unknown_length_pct.value, 2.0);
  EXPECT_LT(study->evidence.corner_deg.value, 1.4);
  EXPECT_LT(study->adjusted.length_pct.value, study->single.length_pct.value);
  EXPECT_LT(study->adjusted.corner_deg.value, study->evidence.corner_deg.value);
  const Outcome outcome = structure_adjustment_outcome(*study, options, "simulation");
  EXPECT_EQ(tally({outcome}).reached, tally({outcome}).judged);
}

TEST(StructureAdjustment, LeavesOutWalksOfAnotherRouteAndRefusesTooFew) {
  core::Rng rng(5);
  StructureAdjustmentOptions options;
  options.walks_per_draw = 3;
  options.draws = 1;
  std::vector<structure::Walk> walks = simulate_walks(options.route, WalkStatistics{}, 3, rng);
  StructureRoute other = options.route;
  other.turns_deg[1] = -90.0;
  walks.push_back(simulate_walks(other, WalkStatistics{}, 1, rng).front());
  walks.emplace_back();
  const auto study = study_structure_adjustment(walks, options);
  ASSERT_TRUE(study);
  EXPECT_EQ(study->walks, 3U);
  EXPECT_EQ(study->left_out, 2U);
  options.walks_per_draw = 4;
  EXPECT_EQ(study_structure_adjustment(walks, options).error().code,
            core::ErrorCode::kInvalidArgument);
  options.known_segment = 3;
  EXPECT_EQ(study_structure_adjustment(walks, options).error().code,
            core::ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace waylode::experiment
