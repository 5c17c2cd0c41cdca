// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/fused_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/fusion/testing/fused_fixture.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::FixState;
using core::FloorId;
using core::Vector2;
using testing::at_s;
using testing::fused_options;
using testing::heard;
using testing::three_floor_site;

core::Belief belief_of(double sigma_x_m, double sigma_y_m, double floor_probability) {
  core::Belief belief;
  belief.floor_probability = floor_probability;
  belief.covariance_m2 =
      Vector2(sigma_x_m * sigma_x_m, sigma_y_m * sigma_y_m).asDiagonal().toDenseMatrix();
  return belief;
}

StateRules rules() {
  StateRules result;
  result.ok_radius_m = 10.0;
  result.show_radius_m = 30.0;
  result.floor_probability = 0.8;
  result.known_share_ratio = 0.4;
  result.stale_after_s = 20.0;
  result.lost_after_s = 60.0;
  return result;
}

FixState judged(const core::Belief& belief, double known_share_ratio, double age_s = 0.0) {
  return state_of(belief, at_s(100.0), HeardScan{at_s(100.0 - age_s), known_share_ratio}, rules());
}

TEST(StateOf, FollowsTheWidestAxisOfTheRegion) {
  // The 95 % ellipse of two dimensions reaches sqrt(-2 ln 0.05) = 2.4477 sigma.
  EXPECT_EQ(judged(belief_of(4.08, 1.0, 1.0), 1.0), FixState::kOk);
  EXPECT_EQ(judged(belief_of(1.0, 4.09, 1.0), 1.0), FixState::kLowConfidence);
  EXPECT_EQ(judged(belief_of(12.25, 1.0, 1.0), 1.0), FixState::kLowConfidence);
  EXPECT_EQ(judged(belief_of(1.0, 12.26, 1.0), 1.0), FixState::kUnknown);
}

TEST(StateOf, LacksConfidenceWhenTheFloorIsInDoubt) {
  EXPECT_EQ(judged(belief_of(1.0, 1.0, 0.8), 1.0), FixState::kOk);
  EXPECT_EQ(judged(belief_of(1.0, 1.0, 0.79), 1.0), FixState::kLowConfidence);
  EXPECT_EQ(judged(belief_of(20.0, 1.0, 0.79), 1.0), FixState::kUnknown);
}

TEST(StateOf, IsOutsideWhereTheMapKnowsLittleWhateverTheRegion) {
  EXPECT_EQ(judged(belief_of(1.0, 1.0, 1.0), 0.4), FixState::kOk);
  EXPECT_EQ(judged(belief_of(1.0, 1.0, 1.0), 0.39), FixState::kOutside);
  EXPECT_EQ(judged(belief_of(50.0, 1.0, 0.1), 0.39), FixState::kOutside);
}

TEST(StateOf, LosesConfidenceAsTheNearestScanAges) {
  const core::Belief sharp = belief_of(1.0, 1.0, 1.0);
  for (const double sign : {1.0, -1.0}) {  // A smoothed instant may be before its scan.
    EXPECT_EQ(judged(sharp, 1.0, sign * 20.0), FixState::kOk);
    EXPECT_EQ(judged(sharp, 1.0, sign * 20.1), FixState::kLowConfidence);
    EXPECT_EQ(judged(sharp, 1.0, sign * 60.0), FixState::kLowConfidence);
    EXPECT_EQ(judged(sharp, 1.0, sign * 60.1), FixState::kUnknown);
  }
  EXPECT_EQ(judged(belief_of(50.0, 1.0, 1.0), 1.0, 20.1), FixState::kUnknown);
  EXPECT_EQ(judged(sharp, 0.0, 1000.0), FixState::kOutside);
}

TEST(StateOf, GoesByTheCovarianceAloneWhereNoScanIsUsed) {
  EXPECT_EQ(state_of(belief_of(1.0, 1.0, 1.0), at_s(1e4), std::nullopt, rules()), FixState::kOk);
  EXPECT_EQ(state_of(belief_of(50.0, 1.0, 1.0), at_s(0.0), std::nullopt, rules()),
            FixState::kUnknown);
}

TEST(NearestScan, IsTheNearestBeforeOrAfter) {
  EXPECT_FALSE(nearest_scan({}, at_s(0.0)));
  const std::vector<HeardScan> scans = {{at_s(0.0), 0.1}, {at_s(10.0), 0.2}, {at_s(20.0), 0.3}};
  const auto share_at = [&](double time_s) {
    return nearest_scan(scans, at_s(time_s))->known_share_ratio;
  };
  EXPECT_EQ(share_at(-5.0), 0.1);
  EXPECT_EQ(share_at(5.0), 0.1);
  EXPECT_EQ(share_at(5.1), 0.2);
  EXPECT_EQ(share_at(10.0), 0.2);
  EXPECT_EQ(share_at(14.9), 0.2);
  EXPECT_EQ(share_at(99.0), 0.3);
}

TEST(StateRules, RejectAgesInTheWrongOrder) {
  StateRules bad = rules();
  bad.lost_after_s = 19.0;
  EXPECT_FALSE(bad.validate());
  bad = rules();
  bad.stale_after_s = 0.0;
  EXPECT_FALSE(bad.validate());
}

TEST(StateRules, RejectRadiiInTheWrongOrder) {
  EXPECT_TRUE(rules().validate());
  StateRules bad = rules();
  bad.show_radius_m = 9.0;
  ASSERT_FALSE(bad.validate());
  EXPECT_EQ(bad.validate().error().code, core::ErrorCode::kInvalidOptions);
}

TEST(FusedFrames, CarryAScanToATurnedFloorsSiteFrameByHand) {
  const auto site = three_floor_site();
  const auto scan = heard(4.0, {{1, 0.0, {2.0, 3.0}}}, 1.0, 0.5);
  observation::FloorHypothesis hypothesis = scan.floors.front();
  hypothesis.covariance_m2 << 4.0, 1.0, 1.0, 9.0;
  const PlanarMeasurement measurement = to_site_frame(*site, scan, hypothesis);
  // Floor 1: turned by +90 degrees, then moved by (10, 0). (2, 3) -> (-3, 2) -> (7, 2).
  EXPECT_LT((measurement.position_m - Vector2(7.0, 2.0)).norm(), 1e-12);
  core::Matrix2 expected_m2;
  expected_m2 << 9.0, -1.0, -1.0, 4.0;
  EXPECT_LT((measurement.covariance_m2 - expected_m2).norm(), 1e-12);
  EXPECT_EQ(measurement.measured, at_s(3.5));
  EXPECT_EQ(measurement.delivered, at_s(4.0));
}

TEST(FusedFrames, ComeBackFromTheSiteToTheFloor) {
  const auto site = three_floor_site();
  const auto scan = heard(4.0, {{2, 0.0, {2.5, -3.5}}});
  observation::FloorHypothesis hypothesis = scan.floors.front();
  hypothesis.covariance_m2 << 4.0, 1.0, 1.0, 9.0;
  const PlanarMeasurement measurement = to_site_frame(*site, scan, hypothesis);
  PlanarState state;
  state.mean.head<2>() = measurement.position_m;
  state.covariance.topLeftCorner<2, 2>() = measurement.covariance_m2;
  const core::Belief belief = to_floor_frame(*site, FloorId{2}, 0.6, state);
  EXPECT_EQ(belief.floor, FloorId{2});
  EXPECT_EQ(belief.floor_probability, 0.6);
  EXPECT_LT((belief.position_m - hypothesis.position_m).norm(), 1e-12);
  EXPECT_LT((belief.covariance_m2 - hypothesis.covariance_m2).norm(), 1e-12);
}

TEST(FusedFrames, TurnAStepByTheFloorsHeadingOffset) {
  site::Floor floor;
  floor.heading_offset_rad = 1.0;
  auto step = testing::step_of(0.0, 0.5, 0.7, 3.0);
  const auto turned = on_site_frame(step, floor);
  EXPECT_NEAR(turned.heading_rad, 4.0 - 2.0 * core::kPi, 1e-12);
  step.heading_rad = turned.heading_rad;
  EXPECT_EQ(turned, step);
}

TEST(FindHypothesis, IsNullForAFloorTheScanDoesNotName) {
  const auto scan = heard(1.0, {{0, 0.0, {1.0, 1.0}}, {2, -1.0, {5.0, 1.0}}});
  EXPECT_EQ(find_hypothesis(scan, FloorId{2}), &scan.floors[1]);
  EXPECT_EQ(find_hypothesis(scan, FloorId{1}), nullptr);
}

TEST(FusedTracker, HasNoBeliefBeforeAScan) {
  FusedTracker tracker(three_floor_site(), fused_options(), std::nullopt);
  EXPECT_EQ(tracker.belief_at(at_s(1.0)), std::nullopt);
  tracker.add(testing::step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_EQ(tracker.belief_at(at_s(1.0)), std::nullopt);
  EXPECT_EQ(tracker.floor(), std::nullopt);
  tracker.add(heard(2.0, {{0, 0.0, {4.0, 5.0}}}));
  const auto belief = tracker.belief_at(at_s(2.0));
  ASSERT_TRUE(belief);
  EXPECT_LT((belief->position_m - Vector2(4.0, 5.0)).norm(), 1e-9);
}

TEST(FusedTracker, HasNoBeliefWhileTheKnownFloorIsNotHeard) {
  FusedTracker tracker(three_floor_site(), fused_options(), FloorId{2});
  tracker.add(heard(2.0, {{0, 0.0, {4.0, 5.0}}}));
  EXPECT_EQ(tracker.belief_at(at_s(2.0)), std::nullopt);
  EXPECT_EQ(tracker.floor(), FloorId{2});
}

TEST(FusedTracker, NeverDoubtsAKnownFloor) {
  FusedTracker tracker(three_floor_site(), fused_options(), FloorId{1});
  for (int i = 0; i < 20; ++i) {
    tracker.add(heard(2.0 * i, {{0, 0.0, {4.0, 5.0}}, {1, -50.0, {6.0, 7.0}}}));
  }
  const auto belief = tracker.belief_at(at_s(38.0));
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_EQ(belief->floor_probability, 1.0);
  EXPECT_LT((belief->position_m - Vector2(6.0, 7.0)).norm(), 1e-6);
}

TEST(FusedTracker, StartsWhereTold) {
  FusedTracker tracker(three_floor_site(), fused_options(), std::nullopt);
  tracker.start(at_s(0.0), FloorId{1}, {3.0, 4.0}, 2.0);
  const auto belief = tracker.belief_at(at_s(0.0));
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_LT((belief->position_m - Vector2(3.0, 4.0)).norm(), 1e-12);
  EXPECT_LT((belief->covariance_m2 - 4.0 * core::Matrix2::Identity()).norm(), 1e-12);
}

TEST(FusedTracker, WalksInTheFloorsOwnFrame) {
  // Floor 1 is turned by 90 degrees and learnt no heading offset: a step east on the site is a
  // step along -y there (east = (1, 0) = turned (0, -1)).
  FusedTracker tracker(three_floor_site(), fused_options(), std::nullopt);
  tracker.start(at_s(0.0), FloorId{1}, {3.0, 4.0}, 2.0);
  tracker.add(testing::step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_LT((tracker.belief_at(at_s(0.5))->position_m - Vector2(3.0, 3.3)).norm(), 1e-12);
}

TEST(FusedTracker, CarriesThePlaceToTheNextFloorThroughTheSiteFrame) {
  FusedTracker tracker(three_floor_site(), fused_options(), std::nullopt);
  // (7, 2) on floor 0 and (2, 3) on floor 1 are the same spot of the site.
  for (int i = 0; i < 5; ++i) {
    tracker.add(heard(2.0 * i, {{0, 0.0, {7.0, 2.0}}, {1, -3.0, {2.0, 3.0}}}));
  }
  EXPECT_LT((tracker.belief_at(at_s(8.0))->position_m - Vector2(7.0, 2.0)).norm(), 1e-6);
  for (int i = 5; i < 15; ++i) {
    tracker.add(heard(2.0 * i, {{1, 0.0, {2.0, 3.0}}, {0, -3.0, {7.0, 2.0}}}));
  }
  const auto belief = tracker.belief_at(at_s(28.0));
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_GT(belief->floor_probability, 0.95);
  EXPECT_LT((belief->position_m - Vector2(2.0, 3.0)).norm(), 1e-6);
}

TEST(FusedTracker, JudgesByTheShareKnownOfTheNewestScan) {
  FusedTracker tracker(three_floor_site(), fused_options(), FloorId{0});
  tracker.add(heard(0.0, {{0, 0.0, {4.0, 5.0}}}, /*known_share_ratio=*/0.9));
  EXPECT_NE(tracker.state_at(at_s(0.0), *tracker.belief_at(at_s(0.0))), FixState::kOutside);
  tracker.add(heard(2.0, {{0, 0.0, {4.0, 5.0}}}, /*known_share_ratio=*/0.1));
  EXPECT_EQ(tracker.state_at(at_s(2.0), *tracker.belief_at(at_s(2.0))), FixState::kOutside);
}

TEST(FusedTracker, IsOutsideFromAnUnknownScanToTheNextKnownOne) {
  FusedTracker tracker(three_floor_site(), fused_options(), FloorId{0});
  for (int i = 0; i < 5; ++i) tracker.add(heard(2.0 * i, {{0, 0.0, {4.0, 5.0}}}));
  const auto state_at = [&](double time_s) {
    return tracker.state_at(at_s(time_s), *tracker.belief_at(at_s(time_s)));
  };
  EXPECT_NE(state_at(9.0), FixState::kOutside);
  const auto before = tracker.belief_at(at_s(10.0));
  tracker.hear_unknown(at_s(10.0));
  EXPECT_EQ(tracker.belief_at(at_s(10.0)), before);
  EXPECT_EQ(state_at(10.0), FixState::kOutside);
  EXPECT_EQ(state_at(300.0), FixState::kOutside);
  tracker.add(heard(301.0, {{0, 0.0, {4.0, 5.0}}}));
  EXPECT_NE(state_at(301.0), FixState::kOutside);
}

TEST(FusedTracker, PassesOverStepsThatEndedByItsStart) {
  FusedTracker tracker(three_floor_site(), fused_options(), std::nullopt);
  tracker.start(at_s(10.0), FloorId{0}, {3.0, 4.0}, 2.0);
  tracker.add(testing::step_of(0.0, 0.5, 0.7, 0.0));
  tracker.add(testing::step_of(9.5, 10.0, 0.7, 0.0));
  EXPECT_LT((tracker.belief_at(at_s(10.0))->position_m - Vector2(3.0, 4.0)).norm(), 1e-12);
  tracker.add(testing::step_of(10.0, 10.5, 0.7, 0.0));
  EXPECT_LT((tracker.belief_at(at_s(10.5))->position_m - Vector2(3.7, 4.0)).norm(), 1e-12);
}

TEST(FusedTracker, RejectsOptionsOfAnyPartThatMakeNoSense) {
  EXPECT_TRUE(fused_options().validate());
  FusedTracker::Options bad = fused_options();
  bad.planar.radio_bias_tau_s = 0.0;
  EXPECT_FALSE(bad.validate());
  bad = fused_options();
  bad.floor.vote_weight = 0.0;
  EXPECT_FALSE(bad.validate());
  bad = fused_options();
  bad.state.ok_radius_m = 0.0;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace waylode::fusion
