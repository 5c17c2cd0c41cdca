// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/smoothed_tracker.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "waylode/fusion/testing/fused_fixture.hpp"

namespace waylode::smoothing {
namespace {

using core::FloorId;
using core::Vector2;
using fusion::testing::at_s;
using fusion::testing::fused_options;
using fusion::testing::heard;
using fusion::testing::Heard;
using fusion::testing::step_of;
using fusion::testing::three_floor_site;

TrackSmoother::Options smoother_options(int rounds = 3) {
  TrackSmoother::Options options;
  options.fused = fused_options();
  options.rounds = rounds;
  return options;
}

TEST(TrackSmoother, HasNoBeliefWithoutAScanOfItsFloor) {
  TrackSmoother smoother(three_floor_site(), smoother_options(), FloorId{1});
  EXPECT_EQ(smoother.belief_at(at_s(0.0)), std::nullopt);
  smoother.add(step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_EQ(smoother.belief_at(at_s(0.5)), std::nullopt);
  smoother.add(heard(1.0, {{0, 0.0, {1.0, 1.0}}}));
  EXPECT_EQ(smoother.belief_at(at_s(1.0)), std::nullopt);
  smoother.add(heard(2.0, {{1, 0.0, {3.0, 4.0}}}));
  EXPECT_TRUE(smoother.belief_at(at_s(0.0)));
}

TEST(TrackSmoother, KnowsThePlaceBeforeTheFirstScan) {
  // Ten metres east (floor 0 lies as the site does) before the only scan: the start lies ten
  // metres west of it.
  TrackSmoother::Options options = smoother_options();
  options.fused.planar.heading_offset_sigma_rad = options.fused.planar.log_scale_sigma = 1e-4;
  TrackSmoother smoother(three_floor_site(), options, FloorId{0});
  for (int i = 0; i < 10; ++i) smoother.add(step_of(0.5 * i, 0.5 * (i + 1), 1.0, 0.0));
  smoother.add(heard(5.0, {{0, 0.0, {30.0, 7.0}}}));
  const double p_m2 = 400.0;  // Of the start, around the first scan's place.
  const double noise_m2 = 0.04 * 5.0 + 10.0 * 0.05 * 0.05;
  const double pull = p_m2 / (p_m2 + noise_m2 + 9.0 + 16.0);
  EXPECT_NEAR(smoother.belief_at(at_s(0.0))->position_m.x(), 30.0 - 10.0 * pull, 1e-2);
  EXPECT_NEAR(smoother.belief_at(at_s(0.0))->position_m.y(), 7.0, 1e-2);
}

TEST(TrackSmoother, DoubtsAScanThatTheFutureContradicts) {
  const auto error_m = [](double degrees_of_freedom) {
    TrackSmoother::Options options = smoother_options(5);
    options.fused.planar.radio_degrees_of_freedom = degrees_of_freedom;
    TrackSmoother smoother(three_floor_site(), options, FloorId{0});
    for (int i = 0; i < 20; ++i) {
      smoother.add(heard(3.0 * i, {{0, 0.0, {i == 8 ? 60.0 : 10.0, 10.0}}}));
    }
    return (smoother.belief_at(at_s(24.0))->position_m - Vector2(10.0, 10.0)).norm();
  };
  EXPECT_LT(error_m(3.0), 0.5);
  EXPECT_GT(error_m(1e15), 3.0 * error_m(3.0));
}

/// The posterior of every scan by going through all ways over the floors.
template <std::size_t kScans>
std::array<std::array<double, 3>, kScans> enumerate(
    const std::array<std::array<double, 3>, kScans>& likelihoods, double change_probability) {
  std::array<std::array<double, 3>, kScans> posterior{};
  const auto ways = static_cast<std::size_t>(std::pow(3, kScans) + 0.5);
  for (std::size_t way = 0; way < ways; ++way) {
    std::array<std::size_t, kScans> floors{};
    double probability = 1.0 / 3.0;
    for (std::size_t i = 0, rest = way; i < kScans; ++i, rest /= 3) {
      floors[i] = rest % 3;
      probability *= likelihoods[i][floors[i]];
      if (i == 0) continue;
      const bool stays = floors[i] == floors[i - 1];
      probability *= change_probability / 3.0 + (stays ? 1.0 - change_probability : 0.0);
    }
    for (std::size_t i = 0; i < kScans; ++i) posterior[i][floors[i]] += probability;
  }
  for (auto& scan : posterior) {
    const double total = scan[0] + scan[1] + scan[2];
    for (double& value : scan) value /= total;
  }
  return posterior;
}

TEST(TrackSmoother, SmoothsFloorsAsEnumerationOfAllWaysDoes) {
  constexpr std::size_t kScans = 5;
  constexpr double kVoteWeight = 0.7;
  TrackSmoother::Options options = smoother_options();
  options.fused.floor.change_probability = 0.15;
  options.fused.floor.vote_weight = kVoteWeight;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    core::Rng rng(seed);
    TrackSmoother smoother(three_floor_site(), options, std::nullopt);
    std::array<std::array<double, 3>, kScans> likelihoods{};
    for (std::size_t i = 0; i < kScans; ++i) {
      std::vector<Heard> floors;
      for (std::uint16_t floor = 0; floor < 3; ++floor) {
        const double vote = rng.uniform(-4.0, 0.0);
        floors.push_back({floor, vote, {5.0, 5.0}});
        likelihoods[i][floor] = std::exp(kVoteWeight * vote);
      }
      smoother.add(heard(2.0 * static_cast<double>(i), floors));
    }
    const auto expected = enumerate(likelihoods, 0.15);
    for (std::size_t i = 0; i < kScans; ++i) {
      const auto belief = smoother.belief_at(at_s(2.0 * static_cast<double>(i)));
      ASSERT_TRUE(belief);
      const auto best = std::ranges::max_element(expected[i]);
      EXPECT_EQ(belief->floor.index, best - expected[i].begin()) << seed << " " << i;
      EXPECT_NEAR(belief->floor_probability, *best, 1e-9) << seed << " " << i;
    }
  }
}

TEST(TrackSmoother, SeesAFloorChangeWhenItHappensNotWhenItIsBelieved) {
  TrackSmoother::Options options = smoother_options();
  options.fused.floor.change_probability = 0.001;
  TrackSmoother smoother(three_floor_site(), options, std::nullopt);
  fusion::FusedTracker causal(three_floor_site(), options.fused, std::nullopt);
  for (int i = 0; i < 20; ++i) {
    const std::uint16_t here = i < 10 ? 0 : 1;
    const std::uint16_t there = i < 10 ? 1 : 0;
    const auto scan = heard(2.0 * i, {{here, 0.0, {7.0, 2.0}}, {there, -4.0, {7.0, 2.0}}});
    smoother.add(scan);
    causal.add(scan);
    if (i == 10) {
      EXPECT_EQ(causal.floor(), FloorId{0});
    }
  }
  EXPECT_EQ(smoother.belief_at(at_s(18.0))->floor, FloorId{0});
  EXPECT_EQ(smoother.belief_at(at_s(20.0))->floor, FloorId{1});
}

TEST(SmoothFloors, TakesTheNewestReportOfAClimbAsTheWayBetweenScans) {
  fusion::FloorFilter::Options options;
  options.storey_m = 4.0;
  options.storey_sigma_m = 0.1;
  options.false_climb_ratio = 0.01;
  options.change_probability = 1e-12;
  const auto climb = [](double climb_m) {
    return observation::VerticalMotion{at_s(2.0), at_s(5.0), climb_m, 0.1};
  };
  const std::vector<Event> events = {heard(1.0, {{0, 0.0, {5.0, 5.0}}, {1, -2.0, {5.0, 5.0}}}),
                                     climb(1.8), climb(4.0),
                                     heard(6.0, {{0, 0.0, {5.0, 5.0}}, {1, 0.0, {5.0, 5.0}}})};
  const auto floors = smooth_floors(events, std::nullopt, {0, 1}, options);
  ASSERT_EQ(floors.size(), 2U);
  // From the lower floor all ways lead on (0.99 up, 0.01 staying), from the upper 0.01 of them.
  const double wrong = 0.01 * std::exp(-2.0);
  EXPECT_EQ(floors[0].floor, FloorId{0});
  EXPECT_NEAR(floors[0].probability, 1.0 / (1.0 + wrong), 1e-9);
  EXPECT_EQ(floors[1].floor, FloorId{1});
  EXPECT_NEAR(floors[1].probability, (0.99 + wrong) / (1.0 + wrong), 1e-9);
}

TEST(TrackSmoother, JudgesTheStateByItsRules) {
  TrackSmoother smoother(three_floor_site(), smoother_options(), FloorId{0});
  smoother.add(heard(0.0, {{0, 0.0, {1.0, 1.0}}}, /*known_share_ratio=*/0.9));
  core::Belief belief = *smoother.belief_at(at_s(0.0));
  belief.covariance_m2 = core::Matrix2::Identity();
  EXPECT_EQ(smoother.state_at(at_s(0.0), belief), core::FixState::kOk);
  belief.covariance_m2 *= 10'000.0;
  EXPECT_EQ(smoother.state_at(at_s(0.0), belief), core::FixState::kUnknown);
}

/// Indoors till 20 s, then a scan every two seconds that the map does not know.
template <typename Tracker>
void leave_after_20_s(Tracker& tracker) {
  for (int i = 0; i <= 10; ++i) tracker.add(heard(2.0 * i, {{0, 0.0, {1.0, 1.0}}}));
  for (int i = 11; i <= 15; ++i) tracker.hear_unknown(at_s(2.0 * i));
}

TEST(TrackSmoother, JudgesEachInstantByTheScanNearestInTime) {
  TrackSmoother smoother(three_floor_site(), smoother_options(), FloorId{0});
  leave_after_20_s(smoother);
  const core::Belief belief = *smoother.belief_at(at_s(10.0));
  for (const double time_s : {0.0, 10.0, 20.9}) {
    EXPECT_NE(smoother.state_at(at_s(time_s), belief), core::FixState::kOutside) << time_s;
  }
  for (const double time_s : {21.1, 30.0}) {
    EXPECT_EQ(smoother.state_at(at_s(time_s), belief), core::FixState::kOutside) << time_s;
  }
}

TEST(TrackSmoother, JudgesByTheShareKnownOfTheNearestScan) {
  TrackSmoother smoother(three_floor_site(), smoother_options(), FloorId{0});
  smoother.add(heard(0.0, {{0, 0.0, {1.0, 1.0}}}, /*known_share_ratio=*/0.1));
  for (int i = 1; i < 6; ++i) smoother.add(heard(4.0 * i, {{0, 0.0, {1.0, 1.0}}}));
  const core::Belief belief = *smoother.belief_at(at_s(0.0));
  EXPECT_EQ(smoother.state_at(at_s(1.0), belief), core::FixState::kOutside);
  EXPECT_NE(smoother.state_at(at_s(3.0), belief), core::FixState::kOutside);
}

TEST(TrackSmoother, RejectsRoundsOutOfRange) {
  EXPECT_TRUE(smoother_options(1).validate());
  EXPECT_TRUE(smoother_options(50).validate());
  for (const int rounds : {0, -1, 51}) {
    const auto valid = smoother_options(rounds).validate();
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::smoothing
