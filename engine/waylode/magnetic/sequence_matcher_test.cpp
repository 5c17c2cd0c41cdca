// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/sequence_matcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::magnetic {
namespace {

using core::device_time_from_seconds;
using core::kPi;
using core::Matrix2;
using core::Vector2;
using observation::MotionDelta;

constexpr double kStep_s = 0.5;
constexpr double kStep_m = 0.6;

SequenceMatcher::Options options() {
  SequenceMatcher::Options options;
  options.window_s = 6.0;
  options.spacing_m = 0.3;
  options.shortest_path_m = 2.0;
  options.least_known_ratio = 0.8;
  options.step_m = 0.2;
  options.search_sigmas = 3.0;
  options.narrowest_search_m = 1.0;
  options.widest_search_m = 8.0;
  options.largest_turn_rad = 0.0;
  options.turn_step_rad = 0.1;
  options.bias_sigma_ut = 10.0;
  options.field_sigma_ut = 1.0;
  options.correlation_m = 1.0;
  options.map_sigma_m = 0.1;
  options.widest_sigma_m = 20.0;
  return options;
}

using Field = std::function<LevelField(const Vector2&)>;

/// Varies along both axes and does not repeat within the search.
LevelField textured(const Vector2& place_m) {
  return {25.0 + 6.0 * std::sin(0.7 * place_m.x()) + 4.0 * std::cos(0.9 * place_m.y()),
          -40.0 + 5.0 * std::sin(0.53 * place_m.x() + 1.1 * place_m.y())};
}

LevelField flat(const Vector2&) { return {25.0, -40.0}; }

/// Varies along x only.
LevelField striped(const Vector2& place_m) {
  return {25.0 + 6.0 * std::sin(0.7 * place_m.x()), -40.0 + 5.0 * std::cos(0.53 * place_m.x())};
}

/// The square from (0, 0) to (20, 10), a point every quarter metre.
FieldGrid survey(const Field& field) {
  std::vector<site::MagneticPoint> points;
  for (int row = 0; row <= 40; ++row) {
    for (int column = 0; column <= 80; ++column) {
      const Vector2 place_m(0.25 * column, 0.25 * row);
      const LevelField value = field(place_m);
      points.push_back({static_cast<float>(place_m.x()), static_cast<float>(place_m.y()),
                        static_cast<float>(value.horizontal_ut),
                        static_cast<float>(value.vertical_ut), 0.1F, 0, 4});
    }
  }
  return FieldGrid(points, {.node_m = 0.25, .reach_m = 0.6, .kernel_m = 0.2});
}

struct Walk {
  Vector2 from_m = Vector2(6.0, 5.0);
  double heading_rad = 0.0;        ///< On the floor.
  double phone_heading_rad = 0.0;  ///< As the motion tells it.
  double told_length_m = kStep_m;  ///< The same of the length.
  int steps = 16;
  double bias_h_ut = 0.0;
  double bias_z_ut = 0.0;
};

Vector2 end_of(const Walk& walk) {
  return walk.from_m +
         walk.steps * kStep_m * Vector2(std::cos(walk.heading_rad), std::sin(walk.heading_rad));
}

core::DeviceTime end_time(const Walk& walk) {
  return device_time_from_seconds(walk.steps * kStep_s);
}

/// Steps, and the field at 20 Hz unless `skips(time_s)`.
SequenceMatcher after(const Walk& walk, const Field& field,
                      const SequenceMatcher::Options& matcher_options = options(),
                      const std::function<bool(double)>& skips = {}) {
  SequenceMatcher matcher(matcher_options);
  const Vector2 ahead(std::cos(walk.heading_rad), std::sin(walk.heading_rad));
  for (int step = 0; step < walk.steps; ++step) {
    for (int i = 0; i < 10; ++i) {
      const double time_s = kStep_s * (step + 0.1 * i);
      if (skips && skips(time_s)) continue;
      LevelField value = field(walk.from_m + time_s / kStep_s * kStep_m * ahead);
      value.horizontal_ut += walk.bias_h_ut;
      value.vertical_ut += walk.bias_z_ut;
      matcher.add(device_time_from_seconds(time_s), value);
    }
    matcher.add(MotionDelta{device_time_from_seconds(kStep_s * step),
                            device_time_from_seconds(kStep_s * (step + 1)), walk.told_length_m,
                            walk.phone_heading_rad, 0.05, 0.05});
  }
  return matcher;
}

SequenceMatcher::Prior near(const Vector2& place_m, double sigma_m = 1.0) {
  SequenceMatcher::Prior prior;
  prior.belief.floor = core::FloorId{4};
  prior.belief.floor_probability = 1.0;
  prior.belief.position_m = place_m;
  prior.belief.covariance_m2 = sigma_m * sigma_m * Matrix2::Identity();
  return prior;
}

TEST(SequenceMatcher, FindsTheWalkOnAKnownFieldToTheStep) {
  const FieldGrid grid = survey(textured);
  const Walk walk;
  const auto found =
      after(walk, textured).match(end_time(walk), near(end_of(walk) + Vector2(-1.3, 0.9)), grid);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->position_m - end_of(walk)).norm(), 0.0, 0.2);
  EXPECT_EQ(found->time, end_time(walk));
  EXPECT_EQ(found->floor, core::FloorId{4});
  EXPECT_LT(found->mean_square_difference_ut2, 0.2);
  EXPECT_LT(found->covariance_m2.trace(), 1.0);
}

TEST(SequenceMatcher, TurnsAndScalesThePathAsThePriorSays) {
  const FieldGrid grid = survey(textured);
  Walk walk;
  walk.heading_rad = 0.4;
  walk.from_m = Vector2(4.0, 3.0);
  walk.phone_heading_rad = 0.4 + 2.0;
  walk.told_length_m = kStep_m / 1.25;
  SequenceMatcher::Prior prior = near(end_of(walk) + Vector2(0.7, -1.1));
  prior.heading_offset_rad = -2.0;
  prior.step_scale = 1.25;
  const auto found = after(walk, textured).match(end_time(walk), prior, grid);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->position_m - end_of(walk)).norm(), 0.0, 0.2);
}

TEST(SequenceMatcher, FindsATurnThatThePhoneDidNotTell) {
  const FieldGrid grid = survey(textured);
  Walk walk;
  walk.phone_heading_rad = 0.2;
  walk.steps = 14;
  SequenceMatcher::Options turning = options();
  turning.largest_turn_rad = 0.25;
  const auto prior = near(end_of(walk) + Vector2(-0.6, 0.8));
  const auto straight = after(walk, textured).match(end_time(walk), prior, grid);
  const auto turned = after(walk, textured, turning).match(end_time(walk), prior, grid);
  ASSERT_TRUE(straight);
  ASSERT_TRUE(turned);
  EXPECT_NEAR((turned->position_m - end_of(walk)).norm(), 0.0, 0.3);
  EXPECT_LT(turned->mean_square_difference_ut2, 0.3 * straight->mean_square_difference_ut2);
}

TEST(SequenceMatcher, DoesNotMindAPhoneWithAFieldOfItsOwn) {
  const FieldGrid grid = survey(textured);
  Walk walk;
  walk.bias_h_ut = 4.0;
  walk.bias_z_ut = -3.0;
  const auto prior = near(end_of(walk) + Vector2(-1.0, 0.6));
  const auto found = after(walk, textured).match(end_time(walk), prior, grid);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->position_m - end_of(walk)).norm(), 0.0, 0.25);
  // Taken at its word, the phone is elsewhere, or fits nowhere well: 4^2 + 3^2 = 25 at the truth.
  SequenceMatcher::Options literal = options();
  literal.bias_sigma_ut = 0.0;
  const auto misled = after(walk, textured, literal).match(end_time(walk), prior, grid);
  ASSERT_TRUE(misled);
  EXPECT_GT(misled->mean_square_difference_ut2, 10.0 * found->mean_square_difference_ut2);
}

TEST(SequenceMatcher, SaysNothingInAFlatField) {
  const FieldGrid grid = survey(flat);
  const Walk walk;
  EXPECT_FALSE(after(walk, flat).match(end_time(walk), near(end_of(walk)), grid));
}

TEST(SequenceMatcher, IsCertainOnlyAcrossTheStripesOfAField) {
  const FieldGrid grid = survey(striped);
  const Walk walk;
  const auto found =
      after(walk, striped).match(end_time(walk), near(end_of(walk) + Vector2(0.7, 0.4)), grid);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->position_m.x(), end_of(walk).x(), 0.2);
  EXPECT_LT(found->covariance_m2(0, 0), 0.5);
  EXPECT_GT(found->covariance_m2(1, 1), 100.0);
}

TEST(SequenceMatcher, IsLessCertainWhereTheFieldIsWeaker) {
  const auto weak = [](const Vector2& place_m) {
    const LevelField strong = textured(place_m);
    return LevelField{25.0 + 0.15 * (strong.horizontal_ut - 25.0),
                      -40.0 + 0.15 * (strong.vertical_ut + 40.0)};
  };
  const Walk walk;
  const auto prior = near(end_of(walk));
  const auto sure = after(walk, textured).match(end_time(walk), prior, survey(textured));
  const auto unsure = after(walk, weak).match(end_time(walk), prior, survey(weak));
  ASSERT_TRUE(sure);
  ASSERT_TRUE(unsure);
  EXPECT_GT(unsure->covariance_m2.determinant(), 4.0 * sure->covariance_m2.determinant());
}

TEST(SequenceMatcher, DoubtsABestFitOnTheRim) {
  const FieldGrid grid = survey(textured);
  const Walk walk;
  // The truth lies 3.2 m from the prior, the search ends at 1.5 m: it may lead on outside.
  const Vector2 centre_m = end_of(walk) + Vector2(-3.2, 0.0);
  const auto found = after(walk, textured).match(end_time(walk), near(centre_m, 0.5), grid);
  ASSERT_TRUE(found);
  const Vector2 offset_m = found->position_m - centre_m;
  ASSERT_GT(offset_m.norm(), 1.1);
  const Vector2 outwards = offset_m.normalized();
  EXPECT_GT(outwards.dot(found->covariance_m2 * outwards), 1.1 * 1.1);
}

TEST(SequenceMatcher, NeedsAWalk) {
  const FieldGrid grid = survey(textured);
  Walk walk;
  EXPECT_FALSE(SequenceMatcher(options()).match(end_time(walk), near(end_of(walk)), grid));
  walk.steps = 3;  // 1.8 m.
  EXPECT_FALSE(after(walk, textured).match(end_time(walk), near(end_of(walk)), grid));
  walk.steps = 4;
  EXPECT_TRUE(after(walk, textured).match(end_time(walk), near(end_of(walk)), grid));
  // Long after the walk the window holds none of it.
  EXPECT_FALSE(after(walk, textured)
                   .match(end_time(walk) + std::chrono::seconds(5), near(end_of(walk)), grid));
  walk.told_length_m = 0.0;
  walk.steps = 16;
  EXPECT_FALSE(after(walk, textured).match(end_time(walk), near(end_of(walk)), grid));
}

TEST(SequenceMatcher, BridgesAGapInTheFieldButNotALongOne) {
  const FieldGrid grid = survey(textured);
  const Walk walk;  // The window is 2 s to 8 s.
  const auto prior = near(end_of(walk) + Vector2(0.5, 0.5));
  const auto gap_until = [](double end_s) {
    return [end_s](double time_s) { return time_s >= 4.0 && time_s < end_s; };
  };
  const auto found =
      after(walk, textured, options(), gap_until(4.9)).match(end_time(walk), prior, grid);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->position_m - end_of(walk)).norm(), 0.0, 0.25);
  EXPECT_FALSE(after(walk, textured, options(), gap_until(6.5)).match(end_time(walk), prior, grid));
  EXPECT_FALSE(after(walk, textured, options(), [](double) {
                 return true;
               }).match(end_time(walk), prior, grid));
}

TEST(SequenceMatcher, SaysNothingOffTheMap) {
  const FieldGrid grid = survey(textured);
  const Walk walk;
  EXPECT_FALSE(after(walk, textured).match(end_time(walk), near(Vector2(100.0, 5.0)), grid));
  EXPECT_FALSE(after(walk, textured).match(end_time(walk), near(end_of(walk)), FieldGrid{}));
}

TEST(SequenceMatcher, NeedsAUsablePrior) {
  const FieldGrid grid = survey(textured);
  const Walk walk;
  const SequenceMatcher matcher = after(walk, textured);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](auto&& spoil) {
    SequenceMatcher::Prior prior = near(end_of(walk));
    spoil(prior);
    return !matcher.match(end_time(walk), prior, grid);
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([&](auto& prior) { prior.belief.position_m.x() = nan; }));
  EXPECT_TRUE(refused([&](auto& prior) { prior.belief.covariance_m2(0, 1) = nan; }));
  EXPECT_TRUE(refused([](auto& prior) { prior.belief.covariance_m2.setZero(); }));
  EXPECT_TRUE(refused([&](auto& prior) { prior.heading_offset_rad = nan; }));
  EXPECT_TRUE(refused([](auto& prior) { prior.step_scale = 0.0; }));
  EXPECT_TRUE(refused([](auto& prior) { prior.step_scale = 1e9; }));
}

TEST(SequenceMatcher, PassesOverWhatIsNoReadingNoStepOrLate) {
  const FieldGrid grid = survey(textured);
  const Walk walk;
  const auto prior = near(end_of(walk) + Vector2(0.5, 0.5));
  SequenceMatcher clean = after(walk, textured);
  SequenceMatcher spoilt = after(walk, textured);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto now = end_time(walk);
  spoilt.add(now, LevelField{nan, -40.0});
  spoilt.add(now, LevelField{25.0, std::numeric_limits<double>::infinity()});
  spoilt.add(device_time_from_seconds(3.0), LevelField{99.0, 99.0});
  spoilt.add(MotionDelta{now, now + std::chrono::milliseconds(500), nan, 0.0, 0.1, 0.1});
  spoilt.add(MotionDelta{now, now + std::chrono::milliseconds(500), 0.6, nan, 0.1, 0.1});
  spoilt.add(MotionDelta{now, now, 0.6, 0.0, 0.1, 0.1});
  spoilt.add(MotionDelta{device_time_from_seconds(1.0), device_time_from_seconds(2.0), 3.0, 0.0,
                         0.1, 0.1});
  const auto expected = clean.match(now, prior, grid);
  ASSERT_TRUE(expected);
  EXPECT_EQ(spoilt.match(now, prior, grid), expected);
}

TEST(SequenceMatcher, StandingBetweenStepsDoesNotMoveThePath) {
  const FieldGrid grid = survey(textured);
  Walk walk;
  walk.steps = 10;
  SequenceMatcher matcher = after(walk, textured);
  // 2 s later a last step; the field stood still meanwhile.
  const auto at = [](double time_s) { return device_time_from_seconds(time_s); };
  for (int i = 0; i <= 20; ++i) matcher.add(at(5.0 + 0.1 * i), textured(end_of(walk)));
  const Vector2 last = end_of(walk) + Vector2(kStep_m, 0.0);
  for (int i = 1; i <= 5; ++i) {
    matcher.add(at(7.0 + 0.1 * i), textured(end_of(walk) + Vector2(0.2 * i * kStep_m, 0.0)));
  }
  matcher.add(MotionDelta{at(7.0), at(7.5), kStep_m, 0.0, 0.1, 0.1});
  const auto found = matcher.match(at(7.5), near(last + Vector2(-0.9, 0.3)), grid);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->position_m - last).norm(), 0.0, 0.25);
}

TEST(SequenceMatcher, IsNotMovedByTheClocksZero) {
  const FieldGrid grid = survey(textured);
  const Walk walk;
  SequenceMatcher matcher(options());
  const auto shift = std::chrono::hours(100);
  const auto reference = after(walk, textured);
  for (int step = 0; step < walk.steps; ++step) {
    for (int i = 0; i < 10; ++i) {
      const double time_s = kStep_s * (step + 0.1 * i);
      matcher.add(device_time_from_seconds(time_s) + shift,
                  textured(walk.from_m + Vector2(time_s / kStep_s * kStep_m, 0.0)));
    }
    matcher.add(MotionDelta{device_time_from_seconds(kStep_s * step) + shift,
                            device_time_from_seconds(kStep_s * (step + 1)) + shift, kStep_m, 0.0,
                            0.05, 0.05});
  }
  const auto prior = near(end_of(walk) + Vector2(0.4, -0.7));
  auto late = matcher.match(end_time(walk) + shift, prior, grid);
  ASSERT_TRUE(late);
  late->time -= shift;
  EXPECT_EQ(late, reference.match(end_time(walk), prior, grid));
}

TEST(SequenceMatcher, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(SequenceMatcher::Options{}.validate());
  const double nan = std::nan("");
  const auto refused = [](auto&& spoil) {
    SequenceMatcher::Options options;
    spoil(options);
    const auto valid = options.validate();
    return !valid && valid.error().code == core::ErrorCode::kInvalidOptions;
  };
  EXPECT_TRUE(refused([](auto& o) { o.window_s = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.window_s = 61.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.spacing_m = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.shortest_path_m = 0.1; }));
  EXPECT_TRUE(refused([](auto& o) { o.least_known_ratio = 1.1; }));
  EXPECT_TRUE(refused([](auto& o) { o.step_m = 0.0; }));
  EXPECT_TRUE(refused([&](auto& o) { o.search_sigmas = nan; }));
  EXPECT_TRUE(refused([](auto& o) { o.narrowest_search_m = 0.1; }));
  EXPECT_TRUE(refused([](auto& o) { o.widest_search_m = 1.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.widest_search_m = 1e4; }));
  EXPECT_TRUE(refused([](auto& o) { o.largest_turn_rad = -0.1; }));
  EXPECT_TRUE(refused([](auto& o) { o.turn_step_rad = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.bias_sigma_ut = -1.0; }));
  EXPECT_TRUE(refused([&](auto& o) { o.field_sigma_ut = nan; }));
  EXPECT_TRUE(refused([](auto& o) { o.correlation_m = 0.0; }));
  EXPECT_TRUE(refused([](auto& o) { o.map_sigma_m = -0.1; }));
  EXPECT_TRUE(refused([](auto& o) { o.widest_sigma_m = 0.0; }));
}

}  // namespace
}  // namespace waylode::magnetic
