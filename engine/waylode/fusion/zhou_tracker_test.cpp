// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/zhou_tracker.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using testing::at_s;
using testing::scan_of;
using testing::step_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The blends without the filter behind them, everything else set so that hands can follow.
ZhouTracker::Options blend_options() {
  ZhouTracker::Options options;
  options.start_scans = 1;
  options.start_within_s = 0.0;
  options.robust_filter = false;
  options.filter_blend = false;
  options.correction_ratio = 0.25;
  options.magnetic_sigma_scale = 1.0;
  options.magnetic_floor_sigma_m = 0.0;
  options.magnetic_gate = kInfinity;
  options.weighting.mode = WeightingMode::kIntervalsMoreWifi;
  options.weighting.first_interval_s = 4.0;
  options.weighting.second_interval_s = 20.0;
  options.weighting.magnetic_share_ratio = 0.7;
  options.weighting.magnetic_share_late_ratio = 0.5;
  return options;
}

ZhouTracker::Options robust_options() {
  ZhouTracker::Options options = blend_options();
  options.robust_filter = true;
  options.magnetic_gate = 9.0;
  return options;
}

PlanarEstimate place_of(double time_s, const Vector2& position_m, double sigma_m) {
  return {at_s(time_s), position_m, sigma_m * sigma_m * Matrix2::Identity()};
}

TEST(ZhouTracker, BeginsByWifiAndWalks) {
  for (const auto& options : {blend_options(), robust_options()}) {
    ZhouTracker tracker(options);
    EXPECT_FALSE(tracker.add(step_of(-1.0, -0.5, 0.7, 0.0)));
    EXPECT_FALSE(tracker.add_magnetic(place_of(0.0, {1.0, 1.0}, 1.0)));
    EXPECT_FALSE(tracker.started());
    ASSERT_TRUE(tracker.add_radio(scan_of(0.0, {3.0, 2.0}, 2.0)));
    ASSERT_TRUE(tracker.started());
    EXPECT_EQ(tracker.at(at_s(0.0)).position_m, Vector2(3.0, 2.0));
    ASSERT_TRUE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
    // The mean of cos over a Gaussian heading is exp(-sigma^2 / 2).
    const double sigma_rad = options.robust_filter ? options.filter.heading_offset_sigma_rad : 0.0;
    const double ahead_m = 0.7 * std::exp(-0.5 * sigma_rad * sigma_rad);
    EXPECT_NEAR(tracker.at(at_s(0.5)).position_m.x(), 3.0 + ahead_m, 0.01);
    EXPECT_NEAR(tracker.at(at_s(0.5)).position_m.y(), 2.0, 1e-9);
  }
}

TEST(ZhouTracker, AveragesTheFirstScansWalkedOn) {
  ZhouTracker::Options options = blend_options();
  options.start_scans = 3;
  options.start_within_s = 10.0;
  ZhouTracker tracker(options);
  ASSERT_TRUE(tracker.add_radio(scan_of(0.0, {0.0, 0.0}, 2.0)));
  ASSERT_TRUE(tracker.add_radio(scan_of(1.0, {4.0, 2.0}, 4.0)));
  EXPECT_LT((tracker.at(at_s(1.0)).position_m - Vector2(2.0, 1.0)).norm(), 1e-12);
  EXPECT_NEAR(tracker.at(at_s(1.0)).covariance_m2(0, 0), 10.0, 1e-9);
  tracker.add(step_of(1.0, 1.5, 0.6, 0.0));
  ASSERT_TRUE(tracker.add_radio(scan_of(1.5, {8.6, 1.0}, 2.0)));
  // Two thirds of (2.6, 1) and a third of (8.6, 1).
  EXPECT_LT((tracker.at(at_s(1.5)).position_m - Vector2(4.6, 1.0)).norm(), 1e-9);
  // The fourth corrects: a quarter of the way.
  ASSERT_TRUE(tracker.add_radio(scan_of(1.5, {8.6, 1.0}, 2.0)));
  EXPECT_LT((tracker.at(at_s(1.5)).position_m - Vector2(5.6, 1.0)).norm(), 1e-9);
}

TEST(ZhouTracker, CorrectsByTheWeightedPoint) {
  ZhouTracker tracker(blend_options());
  tracker.start(place_of(0.0, {0.0, 0.0}, 2.0));
  ASSERT_TRUE(tracker.add_radio(scan_of(5.0, {4.0, 8.0}, 2.0)));
  ASSERT_TRUE(tracker.weighted_point());
  EXPECT_EQ(tracker.weighted_point()->position_m, Vector2(4.0, 8.0));
  EXPECT_LT((tracker.at(at_s(5.0)).position_m - Vector2(1.0, 2.0)).norm(), 1e-12);
  ASSERT_TRUE(tracker.add_magnetic(place_of(6.0, {14.0, -2.0}, 1.0)));
  // 0.7 magnetic and 0.3 Wi-Fi: (11, 1); a quarter of the way there.
  EXPECT_LT((tracker.weighted_point()->position_m - Vector2(11.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((tracker.at(at_s(6.0)).position_m - Vector2(3.5, 1.75)).norm(), 1e-12);
  // Late: half and half, (9, 3).
  ASSERT_TRUE(tracker.add_radio(scan_of(21.0, {4.0, 8.0}, 2.0)));
  EXPECT_LT((tracker.weighted_point()->position_m - Vector2(9.0, 3.0)).norm(), 1e-12);
}

TEST(ZhouTracker, WalksOldPositionsOnBeforeItWeighsThem) {
  ZhouTracker tracker(blend_options());
  tracker.start(place_of(0.0, {0.0, 0.0}, 2.0));
  for (int i = 0; i < 10; ++i) tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.8, 0.0));
  // Measured two seconds and 3.2 m ago.
  ASSERT_TRUE(tracker.add_radio(scan_of(5.0, {6.0, 1.0}, 2.0, /*delay_s=*/2.0)));
  EXPECT_LT((tracker.weighted_point()->position_m - Vector2(9.2, 1.0)).norm(), 1e-9);
  tracker.add(step_of(5.0, 5.5, 0.8, 0.0));
  ASSERT_TRUE(tracker.add_magnetic(place_of(5.5, {9.0, 0.0}, 1.0)));
  EXPECT_LT((tracker.weighted_point()->position_m - Vector2(0.7 * 9.0 + 0.3 * 10.0, 0.3)).norm(),
            1e-9);
}

TEST(ZhouTracker, TurnsWithItsSensorsAtOnce) {
  ZhouTracker tracker(blend_options());
  tracker.start(place_of(0.0, {0.0, 0.0}, 2.0));
  for (int i = 0; i < 6; ++i) tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.0));
  const Vector2 before_m = tracker.at(at_s(3.0)).position_m;
  tracker.add(step_of(3.0, 3.5, 0.7, std::acos(-1.0)));
  EXPECT_LT((tracker.at(at_s(3.5)).position_m - before_m - Vector2(-0.7, 0.0)).norm(), 1e-9);
}

/// Walks east 0.7 m a step; Wi-Fi every six steps, magnetic positions every step from `slip_m`
/// beside the truth.
Vector2 error_after_a_walk_m(const ZhouTracker::Options& options, double slip_m) {
  ZhouTracker tracker(options);
  core::Rng rng(5);
  tracker.start(place_of(0.0, {0.0, 0.0}, 1.0));
  for (int i = 1; i <= 60; ++i) {
    tracker.add(step_of(0.5 * (i - 1), 0.5 * i, 0.7, 0.0, 0.05, 0.02));
    const Vector2 truth_m(0.7 * i, 0.0);
    if (i % 6 == 0) {
      tracker.add_radio(
          scan_of(0.5 * i, truth_m + Vector2(rng.normal(0.0, 1.5), rng.normal(0.0, 1.5)), 1.5));
    }
    tracker.add_magnetic(place_of(0.5 * i, truth_m - Vector2(slip_m, 0.0), 0.5));
  }
  return tracker.at(at_s(30.0)).position_m - Vector2(42.0, 0.0);
}

TEST(ZhouTracker, LeavesAMagneticMatchThatContradictsWifiAndSteps) {
  EXPECT_LT(error_after_a_walk_m(robust_options(), 0.0).norm(), 0.5);
  EXPECT_LT(error_after_a_walk_m(robust_options(), 15.0).norm(), 2.0);
  ZhouTracker::Options credulous = robust_options();
  credulous.magnetic_gate = kInfinity;
  credulous.filter.lost_failures = 0;
  EXPECT_GT(error_after_a_walk_m(credulous, 15.0).norm(), 10.0);
}

TEST(ZhouTracker, RecoversFromAStartInTheWrongDirection) {
  ZhouTracker tracker(robust_options());
  tracker.start(place_of(0.0, {0.0, 0.0}, 1.0));
  for (int i = 1; i <= 100; ++i) {
    tracker.add(step_of(0.5 * (i - 1), 0.5 * i, 0.7, 0.5 * std::acos(-1.0), 0.05, 0.02));
    if (i % 4 == 0) tracker.add_radio(scan_of(0.5 * i, {0.7 * i, 0.0}, 1.5));
  }
  EXPECT_LT((tracker.at(at_s(50.0)).position_m - Vector2(70.0, 0.0)).norm(), 2.0);
}

TEST(ZhouTracker, StaysWhereStepsAndPositionsEnd) {
  for (const bool filtered : {false, true}) {
    ZhouTracker::Options options = blend_options();
    options.filter_blend = filtered;
    ZhouTracker tracker(options);
    tracker.start(place_of(0.0, {0.0, 0.0}, 1.0));
    for (int i = 1; i <= 20; ++i) tracker.add(step_of(0.5 * (i - 1), 0.5 * i, 0.7, 0.0));
    const PlanarEstimate later = tracker.at(at_s(3610.0));
    EXPECT_LT(std::abs(later.position_m.x() - 14.0), 3.0) << filtered;
    EXPECT_GT(later.covariance_m2(0, 0), 100.0);
    EXPECT_TRUE(core::is_valid_covariance(later.covariance_m2));
  }
}

TEST(ZhouTracker, PassesOverWhatItCannotUse) {
  for (const auto& options : {blend_options(), robust_options()}) {
    ZhouTracker tracker(options);
    EXPECT_FALSE(tracker.add_radio(scan_of(0.0, {kNan, 2.0}, 2.0)));
    tracker.start(place_of(0.0, {3.0, 2.0}, 2.0));
    ASSERT_TRUE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
    ASSERT_TRUE(tracker.add_radio(scan_of(1.0, {3.0, 2.0}, 2.0)));
    ASSERT_TRUE(tracker.add_magnetic(place_of(1.0, {3.0, 2.0}, 2.0)));
    const PlanarEstimate before = tracker.at(at_s(1.0));
    EXPECT_FALSE(tracker.add_radio(scan_of(2.0, {3.0, kNan}, 2.0)));
    EXPECT_FALSE(tracker.add_radio(scan_of(2.0, {3.0, 2.0}, 0.0)));
    EXPECT_FALSE(tracker.add_radio(scan_of(0.9, {9.0, 2.0}, 2.0)));
    EXPECT_FALSE(tracker.add_magnetic(place_of(2.0, {3.0, kNan}, 2.0)));
    EXPECT_FALSE(tracker.add_magnetic(place_of(0.9, {9.0, 2.0}, 2.0)));
    EXPECT_FALSE(tracker.add(step_of(1.0, 1.5, kNan, 0.0)));
    EXPECT_FALSE(tracker.add(step_of(0.0, 0.4, 0.7, 0.0)));
    EXPECT_EQ(tracker.at(at_s(1.0)), before);
  }
}

RC_GTEST_PROP(ZhouTracker, KeepsItsCovarianceValid, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  ZhouTracker::Options options = rng.below(2) == 0 ? robust_options() : blend_options();
  options.filter_blend = rng.below(2) == 0;
  options.start_scans = 1 + static_cast<int>(rng.below(4));
  options.start_within_s = 5.0;
  options.weighting.mode = static_cast<WeightingMode>(rng.below(3));
  ZhouTracker tracker(options);
  double now_s = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double begin_s = now_s;
    now_s += rng.below(20) == 0 ? rng.uniform(2.0, 400.0) : rng.uniform(0.0, 0.8);
    const Vector2 somewhere_m(rng.normal(0.0, 9.0), rng.normal(0.0, 9.0));
    switch (rng.below(3)) {
      case 0:
        tracker.add(step_of(begin_s, now_s, rng.uniform(0.0, 1.2), rng.uniform(-3.1, 3.1), 0.0));
        break;
      case 1:
        tracker.add_radio(
            scan_of(now_s, somewhere_m, rng.uniform(0.01, 9.0), rng.uniform(0.0, 40.0)));
        break;
      default:
        tracker.add_magnetic(place_of(now_s, somewhere_m, rng.uniform(0.01, 9.0)));
    }
    if (!tracker.started()) continue;
    const PlanarEstimate estimate = tracker.at(at_s(now_s + rng.uniform(0.0, 3.0)));
    RC_ASSERT(estimate.position_m.allFinite());
    RC_ASSERT(core::is_valid_covariance(estimate.covariance_m2));
  }
}

TEST(ZhouTracker, RejectsOptionsThatMakeNoSense) {
  using Options = ZhouTracker::Options;
  EXPECT_TRUE(Options{}.validate());
  EXPECT_TRUE(robust_options().validate());
  for (const auto member : {&Options::start_within_s, &Options::correction_ratio,
                            &Options::fused_velocity_s, &Options::magnetic_sigma_scale,
                            &Options::magnetic_floor_sigma_m, &Options::magnetic_gate}) {
    for (const double bad : {-0.1, kNan}) {
      Options wrong = robust_options();
      wrong.*member = bad;
      EXPECT_FALSE(wrong.validate());
    }
  }
  Options wrong = robust_options();
  wrong.start_scans = 0;
  EXPECT_FALSE(wrong.validate());
  wrong = robust_options();
  wrong.blend.turn_rad = 0.0;
  EXPECT_FALSE(wrong.validate());
  wrong = robust_options();
  wrong.weighting.magnetic_share_ratio = 2.0;
  EXPECT_FALSE(wrong.validate());
  wrong = robust_options();
  wrong.velocity_filter.start_speed_sigma_mps = 0.0;
  EXPECT_FALSE(wrong.validate());
  wrong = robust_options();
  wrong.filter.gate = -1.0;
  EXPECT_FALSE(wrong.validate());
}

}  // namespace
}  // namespace waylode::fusion
