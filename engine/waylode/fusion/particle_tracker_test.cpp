// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/particle_tracker.hpp"

#include <gtest/gtest.h>

#include "waylode/fusion/testing/fused_fixture.hpp"
#include "waylode/fusion/testing/particle_model.hpp"

namespace waylode::fusion {
namespace {

using core::FloorId;
using core::Vector2;
using testing::at_s;
using testing::heard;
using testing::step_of;
using testing::three_floor_site;
using testing::with_rasters;

ParticleTracker tracker(std::optional<FloorId> known_floor = std::nullopt) {
  ParticleTracker::Options options;
  options.particles = testing::particle_options();
  options.particles.particles = 1000;
  options.particles.position_walk_m_per_sqrt_s = 0.2;
  options.particles.jump_probability = 0.01;
  options.floor = testing::fused_options().floor;
  options.state = testing::fused_options().state;
  return {three_floor_site(), {}, options, known_floor};
}

TEST(ParticleTracker, KnowsNothingBeforeAScan) {
  ParticleTracker tracker = fusion::tracker();
  tracker.add(step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_EQ(tracker.belief_at(at_s(0.5)), std::nullopt);
  EXPECT_EQ(tracker.floor(), std::nullopt);
  // A scan without a raster tells the floor, but no place.
  tracker.add(heard(1.0, {{0, 0.0, {5.0, 5.0}}}));
  EXPECT_EQ(tracker.belief_at(at_s(1.0)), std::nullopt);
}

TEST(ParticleTracker, PassesOverARasterWithoutNodes) {
  ParticleTracker tracker = fusion::tracker();
  auto scan = heard(1.0, {{0, 0.0, {5.0, 5.0}}});
  scan.floors[0].raster = std::make_shared<const observation::LikelihoodRaster>();
  tracker.add(scan);
  EXPECT_EQ(tracker.belief_at(at_s(1.0)), std::nullopt);
}

TEST(ParticleTracker, WalksInTheFloorsFrame) {
  // Floor 1 is turned by +90 degrees: east on the site is (0, -1) on the floor.
  ParticleTracker tracker = fusion::tracker(FloorId{1});
  tracker.start(at_s(0.0), FloorId{1}, {20.0, 10.0}, 0.01);
  for (int i = 0; i < 10; ++i) tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.0));
  const auto belief = tracker.belief_at(at_s(5.0));
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_NEAR(belief->position_m.x(), 20.0, 0.7);
  EXPECT_NEAR(belief->position_m.y(), 3.0, 0.7);
}

TEST(ParticleTracker, ScansOverruleAToldStartAndItsFloor) {
  ParticleTracker tracker = fusion::tracker();
  tracker.start(at_s(0.0), FloorId{1}, {50.0, 30.0}, 1.0);
  EXPECT_EQ(tracker.belief_at(at_s(0.0))->floor, FloorId{1});
  EXPECT_LT((tracker.belief_at(at_s(0.0))->position_m - Vector2(50.0, 30.0)).norm(), 0.5);
  for (int i = 1; i <= 8; ++i) {
    tracker.add(with_rasters(heard(2.0 * i, {{0, 0.0, {5.0, 5.0}}, {1, -4.0, {6.0, 6.0}}})));
  }
  const auto belief = tracker.belief_at(at_s(16.0));
  EXPECT_EQ(belief->floor, FloorId{0});
  EXPECT_LT((belief->position_m - Vector2(5.0, 5.0)).norm(), 3.0);
}

TEST(ParticleTracker, AKnownFloorIsNeverDoubted) {
  ParticleTracker tracker = fusion::tracker(FloorId{2});
  for (int i = 0; i < 5; ++i) {
    tracker.add(with_rasters(heard(2.0 * i, {{0, 0.0, {5.0, 5.0}}, {2, -6.0, {8.0, 4.0}}})));
  }
  const auto belief = tracker.belief_at(at_s(8.0));
  EXPECT_EQ(belief->floor, FloorId{2});
  EXPECT_EQ(belief->floor_probability, 1.0);
  EXPECT_LT((belief->position_m - Vector2(8.0, 4.0)).norm(), 3.0);
}

TEST(ParticleTracker, AClimbMovesTheFloorAndKeepsThePlace) {
  ParticleTracker tracker = fusion::tracker();
  for (int i = 0; i < 5; ++i) tracker.add(with_rasters(heard(2.0 * i, {{0, 0.0, {20.0, 10.0}}})));
  const auto site = three_floor_site();
  const Vector2 before_m =
      site->site_from_floor(FloorId{0}, tracker.belief_at(at_s(8.0))->position_m);
  observation::VerticalMotion climb;
  climb.begin = at_s(9.0);
  climb.end = at_s(15.0);
  climb.climb_m = 4.2;
  climb.sigma_m = 0.6;
  tracker.add(climb);
  const auto belief = tracker.belief_at(at_s(15.0));
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_LT((site->site_from_floor(FloorId{1}, belief->position_m) - before_m).norm(), 1e-6);
}

TEST(ParticleTracker, IsOutsideAfterAScanThatTheMapDoesNotKnow) {
  ParticleTracker tracker = fusion::tracker();
  tracker.add(with_rasters(heard(0.0, {{0, 0.0, {5.0, 5.0}}})));
  tracker.hear_unknown(at_s(2.0));
  EXPECT_EQ(tracker.state_at(at_s(2.0), *tracker.belief_at(at_s(2.0))), core::FixState::kOutside);
}

}  // namespace
}  // namespace waylode::fusion
