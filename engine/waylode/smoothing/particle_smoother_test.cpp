// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/particle_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/fused_fixture.hpp"
#include "waylode/fusion/testing/particle_model.hpp"

namespace waylode::smoothing {
namespace {

using core::FloorId;
using core::Vector2;
using fusion::testing::at_s;
using fusion::testing::Heard;
using fusion::testing::heard;
using fusion::testing::step_of;
using fusion::testing::three_floor_site;
using fusion::testing::with_rasters;

constexpr std::optional<FloorId> kKnownFloor = FloorId{0};

fusion::ParticleTracker::Options tracker_options(std::size_t particles = 400) {
  fusion::ParticleTracker::Options options;
  options.particles = fusion::testing::particle_options();
  options.particles.particles = particles;
  options.particles.heading_offset_sigma_rad = 0.1;
  options.particles.position_walk_m_per_sqrt_s = 0.2;
  options.floor = fusion::testing::fused_options().floor;
  options.state = fusion::testing::fused_options().state;
  return options;
}

ParticleSmoother::Options smoother_options() {
  return {.tracker = tracker_options(), .particles = 400, .horizon_s = 1000.0};
}

Event scan_at(double time_s, const Vector2& place_m, std::uint16_t floor = 0,
              double known_share_ratio = 1.0) {
  return with_rasters(heard(time_s, {{floor, 0.0, place_m}}, known_share_ratio));
}

/// A scan, then two steps of 0.7 m a second, slowly turning, with a scan every third second.
std::vector<Event> noisy_walk(int seconds, std::uint64_t seed) {
  core::Rng rng(seed);
  Vector2 place_m(5.0, 5.0);
  std::vector<Event> events = {scan_at(0.0, place_m)};
  for (int i = 0; i < 2 * seconds; ++i) {
    const double heading_rad = 0.03 * i;
    place_m += 0.7 * Vector2(std::cos(heading_rad), std::sin(heading_rad));
    events.emplace_back(step_of(0.5 * i, 0.5 * (i + 1), 0.7, heading_rad));
    if (i % 6 != 5) continue;
    const Vector2 noise_m(rng.normal(0.0, 4.0), rng.normal(0.0, 4.0));
    events.push_back(scan_at(0.5 * (i + 1), place_m + noise_m));
  }
  return events;
}

FixedLagParticles lagging(core::Duration lag, std::optional<FloorId> known_floor = kKnownFloor) {
  return {three_floor_site(), {}, tracker_options(), known_floor, lag};
}

TEST(FixedLagParticles, EqualTheWholeTrackWhenTheLagCoversIt) {
  ParticleSmoother whole(three_floor_site(), {}, smoother_options(), kKnownFloor);
  FixedLagParticles late = lagging(std::chrono::seconds(100));
  for (const Event& event : noisy_walk(40, 4)) {
    whole.add(event);
    late.add(event);
  }
  for (const double time_s : {0.0, 0.7, 13.0, 30.25}) {
    ASSERT_TRUE(whole.belief_at(at_s(time_s)));
    EXPECT_EQ(late.belief_at(at_s(time_s)), whole.belief_at(at_s(time_s))) << time_s;
  }
}

TEST(FixedLagParticles, EqualTheCausalTrackerForTheNewestInstant) {
  fusion::ParticleTracker causal(three_floor_site(), {}, tracker_options(), std::nullopt);
  FixedLagParticles late = lagging(std::chrono::seconds(10), std::nullopt);
  double newest_s = 0.0;
  for (const Event& event : noisy_walk(30, 5)) {
    std::visit([&](const auto& value) { causal.add(value); }, event);
    late.add(event);
    if (const auto* motion = std::get_if<observation::MotionDelta>(&event)) {
      newest_s = core::to_seconds(motion->end - at_s(0.0));
    }
    for (const double later_s : {0.01, 0.2, 5.0}) {
      ASSERT_TRUE(causal.belief_at(at_s(newest_s + later_s)));
      EXPECT_EQ(late.belief_at(at_s(newest_s + later_s)),
                causal.belief_at(at_s(newest_s + later_s)));
    }
  }
}

TEST(FixedLagParticles, ForgetNothingThatTheirLagNeeds) {
  FixedLagParticles forgetful = lagging(std::chrono::seconds(5));
  FixedLagParticles mindful = lagging(std::chrono::hours(1));
  for (const Event& event : noisy_walk(40, 6)) {
    forgetful.add(event);
    mindful.add(event);
    const auto* motion = std::get_if<observation::MotionDelta>(&event);
    if (motion == nullptr || motion->end < at_s(5.0)) continue;
    for (const double lag_s : {0.1, 2.4, 5.0}) {
      const core::DeviceTime time = motion->end - core::from_seconds(lag_s);
      EXPECT_EQ(forgetful.belief_at(time), mindful.belief_at(time));
    }
  }
}

TEST(FixedLagParticles, KnowMoreThanTheCausalTracker) {
  // The same walks, judged 8 s later: the mean squared error shrinks.
  double causal_m2 = 0.0;
  double late_m2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    FixedLagParticles late = lagging(std::chrono::seconds(8));
    for (const Event& event : noisy_walk(20, seed)) {
      late.add(event);
      const auto* motion = std::get_if<observation::MotionDelta>(&event);
      if (motion == nullptr) continue;
      const auto error_m2 = [&](double time_s) {
        Vector2 truth_m(5.0, 5.0);
        for (int i = 0; i < std::lround(2.0 * time_s); ++i) {
          truth_m += 0.7 * Vector2(std::cos(0.03 * i), std::sin(0.03 * i));
        }
        return (late.belief_at(at_s(time_s))->position_m - truth_m).squaredNorm();
      };
      if (motion->end == at_s(10.0)) causal_m2 += error_m2(10.0);
      if (motion->end == at_s(18.0)) late_m2 += error_m2(10.0);
    }
  }
  EXPECT_GT(causal_m2, 0.0);
  EXPECT_LT(late_m2, 0.85 * causal_m2);
}

TEST(FixedLagParticles, HaveNoBeliefBeforeAScan) {
  FixedLagParticles late = lagging(std::chrono::seconds(5));
  late.add(step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_EQ(late.belief_at(at_s(0.0)), std::nullopt);
  EXPECT_EQ(late.belief_at(at_s(0.5)), std::nullopt);
}

TEST(FixedLagParticles, JudgeEachInstantByTheScanNearestInTime) {
  FixedLagParticles late = lagging(std::chrono::seconds(10));
  for (int i = 0; i <= 10; ++i) late.add(scan_at(2.0 * i, {1.0, 1.0}));
  for (int i = 11; i <= 15; ++i) late.hear_unknown(at_s(2.0 * i));
  const core::Belief belief = *late.belief_at(at_s(20.0));
  EXPECT_NE(late.state_at(at_s(20.0), belief), core::FixState::kOutside);
  EXPECT_EQ(late.state_at(at_s(21.5), belief), core::FixState::kOutside);
  EXPECT_EQ(late.state_at(at_s(30.0), belief), core::FixState::kOutside);
}

TEST(ParticleSmoother, HasNoBeliefWithoutAScanOfItsFloor) {
  ParticleSmoother smoother(three_floor_site(), {}, smoother_options(), FloorId{1});
  EXPECT_EQ(smoother.belief_at(at_s(0.0)), std::nullopt);
  smoother.add(step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_EQ(smoother.belief_at(at_s(0.5)), std::nullopt);
  smoother.add(scan_at(1.0, {1.0, 1.0}, /*floor=*/0));
  EXPECT_EQ(smoother.belief_at(at_s(1.0)), std::nullopt);
  smoother.add(scan_at(2.0, {3.0, 4.0}, /*floor=*/1));
  EXPECT_TRUE(smoother.belief_at(at_s(0.0)));
}

TEST(ParticleSmoother, KnowsTheWayToTheFirstScan) {
  ParticleSmoother smoother(three_floor_site(), {}, smoother_options(), kKnownFloor);
  for (int i = 0; i < 10; ++i) smoother.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.0));
  for (int i = 0; i < 20; ++i) smoother.add(scan_at(5.0 + 0.1 * i, {20.0, 10.0}));
  // Ten steps of 0.7 m east end at the scans' place; five of them were yet to come at 2.5 s.
  const auto belief = smoother.belief_at(at_s(2.5));
  ASSERT_TRUE(belief);
  EXPECT_NEAR(belief->position_m.x(), 20.0 - 3.5, 1.0);
  EXPECT_NEAR(belief->position_m.y(), 10.0, 1.0);
}

TEST(ParticleSmoother, FollowsFloorsThroughTheSiteFrame) {
  // Floor 1 lies 10 m west and turned by a right angle: the same place, other coordinates.
  ParticleSmoother smoother(three_floor_site(), {}, smoother_options(), std::nullopt);
  const auto site = three_floor_site();
  const Vector2 place_m(12.0, 7.0);
  for (int i = 0; i < 20; ++i) {
    const std::uint16_t floor = i < 10 ? 0 : 1;
    smoother.add(scan_at(2.0 * i, site->floor_from_site(FloorId{floor}, place_m), floor));
  }
  for (const double time_s : {4.0, 34.0}) {
    const auto belief = smoother.belief_at(at_s(time_s));
    ASSERT_TRUE(belief);
    EXPECT_EQ(belief->floor, FloorId{static_cast<std::uint16_t>(time_s < 20.0 ? 0 : 1)});
    EXPECT_LT((site->site_from_floor(belief->floor, belief->position_m) - place_m).norm(), 2.5);
  }
}

TEST(ParticleSmoother, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(smoother_options().validate());
  ParticleSmoother::Options few = smoother_options();
  few.particles = 49;
  EXPECT_FALSE(few.validate());
  ParticleSmoother::Options blind = smoother_options();
  blind.horizon_s = 0.0;
  EXPECT_FALSE(blind.validate());
}

}  // namespace
}  // namespace waylode::smoothing
