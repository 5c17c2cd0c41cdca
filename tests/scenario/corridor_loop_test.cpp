// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "scenario_world.hpp"
#include "waylode/core/covariance.hpp"

namespace waylode::test {
namespace {

/// Two storeys with a corridor all around, stairs in the middle of the west side.
constexpr std::string_view kDrawing =
    "floor F1 level 0 elevation_m 0\n"
    "################################\n"
    "#1......A..........B..........2#\n"
    "#..............................#\n"
    "#..##########################..#\n"
    "#..#.^^^.####################..#\n"
    "#..+.^^^.####################..#\n"
    "#C.#.^^^.####################.D#\n"
    "#..##########################..#\n"
    "#..............................#\n"
    "#4......E..........F..........3#\n"
    "################################\n"
    "floor F2 level 1 elevation_m 4\n"
    "################################\n"
    "#1.........A.............B....2#\n"
    "#..............................#\n"
    "#..##########################..#\n"
    "#..#.^^^.####################.D#\n"
    "#..+.^^^.####################..#\n"
    "#..#.^^^.####################..#\n"
    "#C.##########################..#\n"
    "#..............................#\n"
    "#4....E..........F............3#\n"
    "################################\n";

class CorridorLoop : public ::testing::Test {
 protected:
  /// Simulated and surveyed once for all tests; nobody changes it.
  static const World& world() {
    static const World kWorld =
        make_world(kDrawing, {{"survey-1", true, {"F1/1", "F1/2", "F1/3", "F1/4", "F1/1"}},
                              {"survey-2", true, {"F1/4", "F1/3", "F1/2", "F1/1", "F1/4"}},
                              {"survey-3", true, {"F2/1", "F2/2", "F2/3", "F2/4", "F2/1"}},
                              {"survey-4", true, {"F2/4", "F2/3", "F2/2", "F2/1", "F2/4"}},
                              {"loop", false, {"F1/3", "F1/4", "F1/1", "F1/2", "F1/3"}},
                              {"stairs", false, {"F1/2", "F1/1", "F2/1", "F2/4", "F2/3"}},
                              {"back", false, {"F1/2", "F1/1", "F1/4", "F1/3", "F1/2"}},
                              {"above", false, {"F2/4", "F2/1", "F2/2", "F2/3", "F2/4"}},
                              {"turner", false, {"F1/4", "F1/3", "F1/4", "F1/1", "F1/2"}},
                              {"down", false, {"F2/2", "F2/1", "F1/1", "F1/4", "F1/3"}}});
    return kWorld;
  }
  static double mean_error_m(std::string_view method) {
    double sum_m = 0.0;
    std::size_t count = 0;
    for (const sim::SimulatedRecording& walk : world().walks) {
      for (const TruthAndFix& one : run_method(world(), walk, method)) {
        sum_m += (one.fix.belief.value().position_m - one.truth.position_m).norm();
        ++count;
      }
    }
    return sum_m / static_cast<double>(count);
  }
  static const sim::SimulatedRecording& loop() { return world().walks[0]; }
  static const sim::SimulatedRecording& stairs() { return world().walks[1]; }
};

TEST_F(CorridorLoop, IsFollowedWithinThreeMetresByTheFusedMethod) {
  const auto fixes = run_method(world(), loop(), "fused");
  ASSERT_GT(fixes.size(), 40U);
  EXPECT_LT(median_error_m(fixes), 3.0);
  EXPECT_GT(floor_hit_ratio(fixes), 0.95);
}

TEST_F(CorridorLoop, IsFollowedBetterTheMoreOfTheFutureIsKnown) {
  // The mean over six walks: of a single one's, chance decides.
  const double fused_m = mean_error_m("fused");
  const double lagging_m = mean_error_m("smoothed_lag10");
  const double smoothed_m = mean_error_m("smoothed");
  EXPECT_LT(lagging_m, fused_m);
  EXPECT_LT(smoothed_m, fused_m);
}

TEST_F(CorridorLoop, IsFollowedBetterByFusionThanByScansAlone) {
  const double wknn_m = median_error_m(run_method(world(), loop(), "wknn"));
  EXPECT_LT(median_error_m(run_method(world(), loop(), "fused")), wknn_m);
}

TEST_F(CorridorLoop, LiesMostlyInsideTheRegionsStated) {
  // Loose both ways: most truths of one walk, with regions that still say something.
  const auto fixes = run_method(world(), loop(), "smoothed");
  std::size_t inside = 0;
  for (const TruthAndFix& one : fixes) {
    const core::Vector2 error_m = one.fix.belief->position_m - one.truth.position_m;
    const double square = core::squared_mahalanobis(error_m, one.fix.belief->covariance_m2);
    inside += square <= core::chi_square_2_quantile(0.95) ? 1 : 0;
    EXPECT_LT(core::confidence_ellipse(one.fix.belief->covariance_m2, 0.95).semi_major_m, 30.0);
  }
  EXPECT_GT(inside, fixes.size() * 7 / 10);
}

TEST_F(CorridorLoop, LosesAndRegainsTheFloorOverTheStairs) {
  for (const char* method : {"fused", "smoothed_lag10", "smoothed"}) {
    const auto fixes = run_method(world(), stairs(), method);
    EXPECT_EQ(fixes.front().truth.floor, core::FloorId{0});
    EXPECT_EQ(fixes.back().truth.floor, core::FloorId{1});
    EXPECT_GT(floor_hit_ratio(fixes), 0.85) << method;
    // Well before and well after the stairs there is no doubt.
    const std::size_t ends = 10;
    for (std::size_t i = 0; i < ends; ++i) {
      EXPECT_EQ(fixes[fixes.size() - 1 - i].fix.belief->floor, core::FloorId{1}) << method;
    }
    EXPECT_EQ(fixes[ends].fix.belief->floor, core::FloorId{0}) << method;
  }
}

TEST_F(CorridorLoop, IsWalkedByDeadReckoningWithoutWifi) {
  const auto fixes = run_method(world(), loop(), "pdr");
  // A minute without any help: a tenth of the way may be lost, not all of it.
  EXPECT_LT(median_error_m(fixes), 10.0);
}

TEST_F(CorridorLoop, KeepsTheSecretOfTheFuture) {
  for (const char* name : {"wknn", "fused", "smoothed_lag5"}) {
    const pipeline::Method method = *pipeline::find_method(name);
    const auto& samples = loop().samples;
    const core::DeviceTime until = loop().truth[300].time;  // Thirty seconds in.
    const auto heard = std::ranges::upper_bound(samples, until + method.lag, {}, sample::time_of);
    const std::vector<sample::Sample> cut(samples.begin(), heard);
    ASSERT_LT(cut.size(), samples.size());
    std::vector<core::DeviceTime> instants;
    for (std::size_t i = 0; i <= 300; i += 7) instants.push_back(loop().truth[i].time);
    auto whole_session = *pipeline::Session::create(world().model, method, {});
    auto cut_session = *pipeline::Session::create(world().model, method, {});
    EXPECT_EQ(pipeline::replay(whole_session, method, samples, instants),
              pipeline::replay(cut_session, method, cut, instants))
        << name;
  }
}

}  // namespace
}  // namespace waylode::test
