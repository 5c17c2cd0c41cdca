// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/feedback_tracker.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

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
using Found = std::vector<std::optional<CircleMatch>>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

FeedbackTracker::Options options(FeedbackReading reading) {
  FeedbackTracker::Options result;
  result.reading = reading;
  result.blend_ratio = 0.4;
  result.guard_gate = 9.0;
  result.guard_failures = 2;
  result.guard_window = 3;
  result.circle_sigma_scale = 1.0;
  result.circle_floor_sigma_m = 0.0;
  // Heading and scale known: a mean over doubtful ones would shorten the way.
  result.filter.heading_offset_sigma_rad = result.filter.log_scale_sigma = 0.0;
  result.filter.heading_offset_walk_rad_per_sqrt_step = 0.0;
  result.filter.log_scale_walk_per_sqrt_step = 0.0;
  result.filter.radio_bias_sigma_m = 0.0;
  result.filter.radio_sigma_scale = 1.0;
  result.filter.radio_floor_sigma_m = 0.0;
  return result;
}

PlanarEstimate place_of(double time_s, const Vector2& position_m, double sigma_m) {
  return {at_s(time_s), position_m, sigma_m * sigma_m * Matrix2::Identity()};
}

Found match_at(double time_s, const Vector2& position_m, double sigma_m,
               double log_likelihood = 0.0, double delay_s = 0.0) {
  return {CircleMatch{scan_of(time_s, position_m, sigma_m, delay_s), log_likelihood}};
}

FeedbackTracker started(const FeedbackTracker::Options& options) {
  FeedbackTracker tracker(options);
  tracker.start(std::vector{place_of(0.0, {1.0, 2.0}, 1.0)});
  return tracker;
}

TEST(FeedbackTracker, StepsNextFromTheMatchWhenTheLoopIsClosed) {
  FeedbackTracker tracker = started(options(FeedbackReading::kClosedLoop));
  ASSERT_TRUE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
  ASSERT_EQ(tracker.centres().size(), 1U);
  EXPECT_LT((tracker.centres()[0] - Vector2(1.7, 2.0)).norm(), 1e-6);
  ASSERT_TRUE(tracker.correct(match_at(0.5, {2.0, 3.0}, 0.8)));
  EXPECT_LT((tracker.at(at_s(0.5)).position_m - Vector2(2.0, 3.0)).norm(), 1e-9);
  EXPECT_NEAR(tracker.at(at_s(0.5)).covariance_m2(0, 0), 0.64, 1e-9);
  ASSERT_TRUE(tracker.add(step_of(0.5, 1.0, 0.7, 0.0)));
  EXPECT_LT((tracker.centres()[0] - Vector2(2.7, 3.0)).norm(), 1e-6);
}

TEST(FeedbackTracker, OnlyAnswersByTheMatchWhenTheLoopIsOpen) {
  FeedbackTracker tracker = started(options(FeedbackReading::kOpenLoop));
  ASSERT_TRUE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
  ASSERT_TRUE(tracker.correct(match_at(0.5, {2.0, 3.0}, 0.8)));
  EXPECT_LT((tracker.at(at_s(0.5)).position_m - Vector2(2.0, 3.0)).norm(), 1e-9);
  ASSERT_TRUE(tracker.add(step_of(0.5, 1.0, 0.7, 0.0)));
  EXPECT_LT((tracker.centres()[0] - Vector2(2.4, 2.0)).norm(), 1e-6);
  // The answer walks on from the match until the next one.
  EXPECT_LT((tracker.at(at_s(1.0)).position_m - Vector2(2.7, 3.0)).norm(), 1e-6);
}

TEST(FeedbackTracker, StepsNextFromBetweenTheTwoWhenBlended) {
  FeedbackTracker tracker = started(options(FeedbackReading::kBlended));
  const Matrix2 before_m2 = tracker.at(at_s(0.0)).covariance_m2;
  ASSERT_TRUE(tracker.correct(match_at(0.0, {2.0, 3.0}, 0.5)));
  EXPECT_LT((tracker.at(at_s(0.0)).position_m - Vector2(1.4, 2.4)).norm(), 1e-9);
  EXPECT_LT(
      (tracker.at(at_s(0.0)).covariance_m2 - (0.36 * before_m2 + 0.16 * 0.25 * Matrix2::Identity()))
          .norm(),
      1e-9);
}

TEST(FeedbackTracker, WeighsTheMatchByCovariancesWhenFiltered) {
  FeedbackTracker tracker = started(options(FeedbackReading::kFiltered));
  ASSERT_TRUE(tracker.correct(match_at(0.0, {2.0, 3.0}, 0.5)));
  EXPECT_LT((tracker.at(at_s(0.0)).position_m - Vector2(1.8, 2.8)).norm(), 1e-6);
  EXPECT_NEAR(tracker.at(at_s(0.0)).covariance_m2(1, 1), 0.2, 1e-6);
}

TEST(FeedbackTracker, KeepsThePdrPositionWhereTheCircleIsEmpty) {
  for (const auto reading : {FeedbackReading::kClosedLoop, FeedbackReading::kFiltered}) {
    FeedbackTracker tracker = started(options(reading));
    ASSERT_TRUE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
    ASSERT_TRUE(tracker.correct(Found{std::nullopt}));
    EXPECT_LT((tracker.at(at_s(0.5)).position_m - Vector2(1.7, 2.0)).norm(), 1e-6);
  }
}

TEST(FeedbackTracker, WalksALateMatchOn) {
  FeedbackTracker tracker = started(options(FeedbackReading::kClosedLoop));
  for (int i = 0; i < 4; ++i) tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.0));
  ASSERT_TRUE(tracker.correct(match_at(2.0, {5.0, 5.0}, 0.8, 0.0, /*delay_s=*/1.0)));
  EXPECT_LT((tracker.at(at_s(2.0)).position_m - Vector2(6.4, 5.0)).norm(), 1e-6);
}

TEST(FeedbackTracker, BeginsAnewWhereTheWholeMapContradictsItAgainAndAgain) {
  FeedbackTracker tracker = started(options(FeedbackReading::kClosedLoop));
  const auto one_round = [&](double time_s, const Vector2& whole_map_m) {
    ASSERT_TRUE(tracker.compare(scan_of(time_s, whole_map_m, 1.0)));
    ASSERT_TRUE(tracker.correct(match_at(time_s, tracker.centres()[0], 0.5)));
  };
  one_round(1.0, {20.0, 2.0});
  EXPECT_EQ(tracker.restarts(), 0);
  EXPECT_LT((tracker.centres()[0] - Vector2(1.0, 2.0)).norm(), 1e-6);
  one_round(2.0, {2.0, 2.0});
  EXPECT_EQ(tracker.restarts(), 0);
  one_round(3.0, {21.0, 3.0});  // The second of three.
  EXPECT_EQ(tracker.restarts(), 1);
  EXPECT_LT((tracker.centres()[0] - Vector2(21.0, 3.0)).norm(), 1e-6);
}

TEST(FeedbackTracker, NeverBeginsAnewWithoutAGuard) {
  auto unguarded = options(FeedbackReading::kClosedLoop);
  unguarded.guard_gate = kInfinity;
  FeedbackTracker tracker = started(unguarded);
  for (int i = 1; i < 20; ++i) ASSERT_TRUE(tracker.compare(scan_of(i, {90.0, 2.0}, 1.0)));
  EXPECT_EQ(tracker.restarts(), 0);
  EXPECT_LT((tracker.centres()[0] - Vector2(1.0, 2.0)).norm(), 1e-6);
}

TEST(FeedbackTracker, FollowsSeveralStartsAndFindsTheOneTheWholeMapAgreesWith) {
  auto several = options(FeedbackReading::kClosedLoop);
  several.hypotheses = 3;
  several.guard_gate = kInfinity;
  FeedbackTracker tracker(several);
  tracker.start(std::vector{place_of(0.0, {0.0, 0.0}, 1.0), place_of(0.0, {10.0, 0.0}, 1.0),
                            place_of(0.0, {0.0, 8.0}, 1.0), place_of(0.0, {9.0, 9.0}, 1.0)});
  ASSERT_EQ(tracker.centres().size(), 3U);
  EXPECT_LT(tracker.at(at_s(0.0)).position_m.norm(), 1e-9);
  for (int i = 1; i <= 4; ++i) {
    tracker.add(step_of(i - 1.0, i, 0.5, 0.0));
    ASSERT_TRUE(tracker.compare(scan_of(i, {10.5 + 0.5 * i, 1.0}, 2.0)));
    Found found;
    for (const Vector2& centre_m : tracker.centres()) {
      found.push_back(CircleMatch{scan_of(i, centre_m, 1.0), 0.0});
    }
    ASSERT_TRUE(tracker.correct(found));
  }
  EXPECT_EQ(tracker.centres().size(), 3U);
  EXPECT_LT((tracker.at(at_s(4.0)).position_m - Vector2(12.0, 0.0)).norm(), 1e-6);
}

TEST(FeedbackTracker, ScoresHypothesesByHowWellTheirCirclesMatch) {
  auto several = options(FeedbackReading::kClosedLoop);
  several.hypotheses = 2;
  several.circle_score = 0.5;
  FeedbackTracker tracker(several);
  tracker.start(std::vector{place_of(0.0, {0.0, 0.0}, 1.0), place_of(0.0, {6.0, 0.0}, 1.0)});
  ASSERT_TRUE(tracker.correct(Found{CircleMatch{scan_of(0.0, {0.0, 0.0}, 1.0), -9.0},
                                    CircleMatch{scan_of(0.0, {6.0, 0.0}, 1.0), -1.0}}));
  const PlanarEstimate estimate = tracker.at(at_s(0.0));
  EXPECT_LT((estimate.position_m - Vector2(6.0, 0.0)).norm(), 1e-9);
  // The other one, exp(-4) as likely and 6 m away, is doubt about it.
  const double weight = std::exp(-4.0);
  EXPECT_NEAR(estimate.covariance_m2(0, 0), (1.0 + weight * 37.0) / (1.0 + weight), 1e-6);
  EXPECT_NEAR(estimate.covariance_m2(1, 1), 1.0, 1e-6);
}

TEST(FeedbackTracker, MergesHypothesesThatMeet) {
  auto several = options(FeedbackReading::kClosedLoop);
  several.hypotheses = 2;
  several.merge_within_m = 0.5;
  FeedbackTracker tracker(several);
  tracker.start(std::vector{place_of(0.0, {0.0, 0.0}, 1.0), place_of(0.0, {2.0, 0.0}, 1.0)});
  ASSERT_EQ(tracker.centres().size(), 2U);
  ASSERT_TRUE(tracker.correct(Found{CircleMatch{scan_of(0.0, {1.0, 0.0}, 1.0)},
                                    CircleMatch{scan_of(0.0, {1.3, 0.0}, 1.0)}}));
  EXPECT_EQ(tracker.centres().size(), 1U);
}

TEST(FeedbackTracker, BeginsWithTheFirstWholeMapFix) {
  FeedbackTracker tracker(options(FeedbackReading::kFiltered));
  EXPECT_FALSE(tracker.started());
  EXPECT_TRUE(tracker.centres().empty());
  EXPECT_FALSE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
  EXPECT_FALSE(tracker.correct(Found{}));
  ASSERT_TRUE(tracker.compare(scan_of(1.0, {3.0, 4.0}, 2.0)));
  ASSERT_TRUE(tracker.started());
  EXPECT_EQ(tracker.at(at_s(1.0)).position_m, Vector2(3.0, 4.0));
}

TEST(FeedbackTracker, PassesOverWhatItCannotUse) {
  FeedbackTracker tracker = started(options(FeedbackReading::kFiltered));
  ASSERT_TRUE(tracker.add(step_of(0.0, 0.5, 0.7, 0.0)));
  ASSERT_TRUE(tracker.compare(scan_of(1.0, {1.0, 2.0}, 2.0)));
  const PlanarEstimate before = tracker.at(at_s(1.0));
  EXPECT_FALSE(tracker.correct(Found{}));
  EXPECT_FALSE(tracker.correct(Found{std::nullopt, std::nullopt}));
  EXPECT_FALSE(tracker.correct(match_at(1.0, {kNan, 0.0}, 1.0)));
  EXPECT_FALSE(tracker.correct(match_at(1.0, {0.0, 0.0}, kNan)));
  EXPECT_FALSE(tracker.correct(match_at(1.0, {0.0, 0.0}, 1.0, kNan)));
  EXPECT_FALSE(tracker.correct(match_at(0.9, {0.0, 0.0}, 1.0)));
  EXPECT_FALSE(tracker.compare(scan_of(0.9, {0.0, 0.0}, 1.0)));
  EXPECT_FALSE(tracker.compare(scan_of(2.0, {0.0, kNan}, 1.0)));
  EXPECT_FALSE(tracker.add(step_of(0.0, 0.4, 0.7, 0.0)));
  EXPECT_FALSE(tracker.add(step_of(1.0, 1.5, kNan, 0.0)));
  EXPECT_EQ(tracker.at(at_s(1.0)), before);
}

RC_GTEST_PROP(FeedbackTracker, KeepsItsCovarianceValid, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  auto any = options(static_cast<FeedbackReading>(rng.below(4)));
  any.hypotheses = 1 + static_cast<int>(rng.below(4));
  any.filter = FeedbackTracker::Options::filter_defaults();
  FeedbackTracker tracker(any);
  double now_s = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double begin_s = now_s;
    now_s += rng.uniform(0.0, 1.0);
    tracker.add(step_of(begin_s, now_s, rng.uniform(0.0, 1.2), rng.uniform(-3.1, 3.1)));
    if (rng.below(3) == 0) {
      tracker.compare(scan_of(now_s, {rng.normal(0.0, 9.0), rng.normal(0.0, 9.0)},
                              rng.uniform(0.01, 9.0), rng.uniform(0.0, 4.0)));
    }
    Found found;
    for (const Vector2& centre_m : tracker.centres()) {
      if (rng.below(4) == 0) {
        found.push_back(std::nullopt);
      } else {
        const Vector2 place_m = centre_m + Vector2(rng.normal(), rng.normal());
        found.push_back(
            CircleMatch{scan_of(now_s, place_m, rng.uniform(0.01, 2.0)), rng.uniform(-50.0, 0.0)});
      }
    }
    if (!tracker.started()) continue;
    RC_ASSERT(tracker.correct(found));
    RC_ASSERT(tracker.centres().size() <= static_cast<std::size_t>(any.hypotheses));
    const PlanarEstimate estimate = tracker.at(at_s(now_s + rng.uniform(0.0, 3.0)));
    RC_ASSERT(estimate.position_m.allFinite());
    RC_ASSERT(core::is_valid_covariance(estimate.covariance_m2));
  }
}

TEST(FeedbackTracker, RejectsOptionsThatMakeNoSense) {
  using Options = FeedbackTracker::Options;
  EXPECT_TRUE(Options{}.validate());
  const Options good = options(FeedbackReading::kFiltered);
  EXPECT_TRUE(good.validate());
  for (const auto member :
       {&Options::blend_ratio, &Options::guard_gate, &Options::circle_sigma_scale,
        &Options::circle_floor_sigma_m, &Options::whole_map_score, &Options::circle_score,
        &Options::score_kept_ratio, &Options::merge_within_m}) {
    for (const double bad : {-0.1, kNan}) {
      Options wrong = good;
      wrong.*member = bad;
      EXPECT_FALSE(wrong.validate());
    }
  }
  for (const int bad : {0, 17}) {
    Options wrong = good;
    wrong.hypotheses = bad;
    EXPECT_FALSE(wrong.validate());
  }
  Options wrong = good;
  wrong.guard_failures = 4;
  EXPECT_FALSE(wrong.validate());
  wrong.guard_failures = 0;
  EXPECT_FALSE(wrong.validate());
  wrong = good;
  wrong.filter.gate = 0.0;
  EXPECT_FALSE(wrong.validate());
}

}  // namespace
}  // namespace waylode::fusion
