// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <variant>
#include <vector>

#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using observation::MotionDelta;
using testing::at_s;

using PlanarEvent = std::variant<MotionDelta, PlanarMeasurement>;

Matrix2 random_covariance(core::Rng& rng) {
  const Matrix2 turn = testing::rotation(rng.uniform(-3.0, 3.0));
  const Vector2 variances_m2(rng.uniform(0.5, 30.0), rng.uniform(0.5, 30.0));
  return turn * variances_m2.asDiagonal() * turn.transpose();
}

/// Steps, pauses, scans in time and late, one in ten of them far off.
std::vector<PlanarEvent> random_events(std::uint64_t seed, int count) {
  core::Rng rng(seed);
  std::vector<PlanarEvent> events;
  double now_s = 5.0;
  Vector2 place_m = Vector2::Zero();
  for (int i = 0; i < count; ++i) {
    const double begin_s = now_s;
    now_s += rng.below(20) == 0 ? rng.uniform(2.0, 60.0) : rng.uniform(0.0, 0.8);
    if (rng.below(3) != 0) {
      const double length_m = rng.below(8) == 0 ? 0.0 : rng.uniform(0.1, 1.2);
      const double heading_rad = rng.uniform(-3.1, 3.1);
      place_m += testing::rotation(heading_rad) * Vector2(length_m, 0.0);
      events.emplace_back(testing::step_of(begin_s, now_s, length_m, heading_rad,
                                           rng.uniform(0.0, 0.2), rng.uniform(0.0, 0.3)));
    } else {
      const double off_m = rng.below(10) == 0 ? 60.0 : 4.0;
      const double delay_s = rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, 40.0);
      events.emplace_back(
          PlanarMeasurement{at_s(now_s - delay_s), at_s(now_s),
                            place_m + Vector2(rng.normal(0.0, off_m), rng.normal(0.0, off_m)),
                            random_covariance(rng)});
    }
  }
  return events;
}

void add(PlanarTracker& tracker, const PlanarEvent& event) {
  std::visit([&](const auto& value) { tracker.add(value); }, event);
}

PlanarTracker run(const std::vector<PlanarEvent>& events) {
  PlanarTracker tracker(testing::robust_options(), false);
  for (const PlanarEvent& event : events) add(tracker, event);
  return tracker;
}

PlanarEvent shifted(PlanarEvent event, core::Duration by) {
  if (auto* motion = std::get_if<MotionDelta>(&event)) {
    motion->begin += by;
    motion->end += by;
  } else {
    auto& scan = std::get<PlanarMeasurement>(event);
    scan.measured += by;
    scan.delivered += by;
  }
  return event;
}

PlanarEvent carried(PlanarEvent event, double angle_rad, const Vector2& offset_m) {
  const Matrix2 turn = testing::rotation(angle_rad);
  if (auto* motion = std::get_if<MotionDelta>(&event)) {
    motion->heading_rad += angle_rad;
  } else {
    auto& scan = std::get<PlanarMeasurement>(event);
    scan.position_m = turn * scan.position_m + offset_m;
    scan.covariance_m2 = (turn * scan.covariance_m2 * turn.transpose()).eval();
  }
  return event;
}

TEST(PlanarTrackerProperty, KeepsItsCovarianceSymmetricAndPositiveDefinite) {
  PlanarTracker tracker(testing::robust_options(), false);
  core::DeviceTime latest;
  for (const PlanarEvent& event : random_events(3, 10'000)) {
    add(tracker, event);
    if (!tracker.started()) continue;
    const PlanarMatrix& covariance = tracker.state().covariance;
    ASSERT_EQ((covariance - covariance.transpose()).cwiseAbs().maxCoeff(), 0.0);
    const Eigen::SelfAdjointEigenSolver<PlanarMatrix> solver(covariance, Eigen::EigenvaluesOnly);
    ASSERT_GT(solver.eigenvalues()(0), 0.0);
    ASSERT_TRUE(tracker.state().mean.allFinite());
    ASSERT_GE(tracker.state().time, latest);
    latest = tracker.state().time;
  }
}

RC_GTEST_PROP(PlanarTrackerProperty, TurnsAndMovesWithTheWorld, ()) {
  const auto events = random_events(*rc::gen::arbitrary<std::uint32_t>(), 80);
  const double angle_rad = 0.001 * *rc::gen::inRange(-3141, 3142);
  const Vector2 offset_m(*rc::gen::inRange(-1000, 1000), *rc::gen::inRange(-1000, 1000));
  std::vector<PlanarEvent> elsewhere;
  for (const PlanarEvent& event : events) {
    elsewhere.push_back(carried(event, angle_rad, offset_m));
  }
  const PlanarState here = run(events).state();
  const PlanarState there = run(elsewhere).state();
  PlanarMatrix turn = PlanarMatrix::Identity();
  turn.topLeftCorner<2, 2>() = turn.bottomRightCorner<2, 2>() = testing::rotation(angle_rad);
  PlanarVector expected = turn * here.mean;
  expected.head<2>() += offset_m;
  RC_ASSERT((there.mean - expected).norm() < 1e-6);
  const PlanarMatrix expected_covariance = turn * here.covariance * turn.transpose();
  RC_ASSERT((there.covariance - expected_covariance).norm() <
            1e-6 * (1.0 + expected_covariance.norm()));
}

RC_GTEST_PROP(PlanarTrackerProperty, KnowsNoAbsoluteTime, ()) {
  const auto events = random_events(*rc::gen::arbitrary<std::uint32_t>(), 80);
  const core::Duration by = std::chrono::milliseconds(*rc::gen::inRange(-1'000'000, 1'000'000'000));
  std::vector<PlanarEvent> later;
  for (const PlanarEvent& event : events) later.push_back(shifted(event, by));
  const PlanarState now = run(events).state();
  const PlanarState then = run(later).state();
  RC_ASSERT(then.mean == now.mean);
  RC_ASSERT(then.covariance == now.covariance);
}

RC_GTEST_PROP(PlanarTrackerProperty, NeverRunsFartherThanOneStepBetweenEvents, ()) {
  const PlanarTracker tracker = run(random_events(*rc::gen::arbitrary<std::uint32_t>(), 60));
  RC_PRE(tracker.started());
  const double later_s = 0.01 * *rc::gen::inRange(0, 1000);
  const PlanarState state = tracker.at(tracker.state().time + core::from_seconds(later_s));
  const double longest_m = 1.2 * std::exp(tracker.state().mean(3));
  RC_ASSERT((state.position_m() - tracker.state().position_m()).norm() <= longest_m + 1e-9);
  const Matrix2 grown_m2 =
      state.position_covariance_m2() - tracker.state().position_covariance_m2();
  RC_ASSERT((grown_m2 - 0.2 * 0.2 * later_s * Matrix2::Identity()).norm() < 1e-9);
}

}  // namespace
}  // namespace waylode::fusion
