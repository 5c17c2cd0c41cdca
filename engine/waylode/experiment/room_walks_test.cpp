// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/room_walks.hpp"

#include <gtest/gtest.h>

namespace waylode::experiment {
namespace {

core::Result<PaperRoom> car_park(std::uint64_t seed) { return wu_room(WuPreset::kI, seed); }

const std::vector<Contender> kTwo = {{"fingerprint", "wknn+radio=knn"},
                                     {"told steps", "wu2019+fusion=dead_reckoning", true}};

core::Result<Trials> run(const RoomMaker& make_room, const std::vector<Contender>& contenders,
                         std::uint64_t first_seed = 7, std::size_t walks = 2) {
  return run_trials(make_room, first_seed, walks, 1.0, contenders, pipeline::Options(), {});
}

TEST(RunTrials, JudgesEveryContenderOnTheSameWalks) {
  const auto trials = run(car_park, kTwo);
  ASSERT_TRUE(trials) << trials.error().message;
  const std::vector<Unit>& scans = trials->of("fingerprint");
  const std::vector<Unit>& steps = trials->of("told steps");
  ASSERT_EQ(scans.size(), 2U);
  ASSERT_EQ(steps.size(), 2U);
  for (std::size_t walk = 0; walk < 2; ++walk) {
    EXPECT_GT(scans[walk].size(), 10U);
    EXPECT_EQ(scans[walk].size(), steps[walk].size());
    // Asked from the first scan on, a second or so after the start.
    EXPECT_LT(steps[walk].front(), 2.0);
  }
}

TEST(RunTrials, ErrorsAreDistancesBetweenTrackAndTruth) {
  const auto trials = run(car_park, kTwo);
  ASSERT_TRUE(trials) << trials.error().message;
  for (std::size_t c = 0; c < kTwo.size(); ++c) {
    const std::vector<core::Vector2>& track = trials->example_tracks[c];
    const Unit& errors_m = trials->errors_m[c].front();
    ASSERT_EQ(track.size(), trials->example_truth.size());
    ASSERT_EQ(track.size(), errors_m.size());
    for (std::size_t i = 0; i < track.size(); ++i) {
      EXPECT_NEAR(errors_m[i], (track[i] - trials->example_truth[i]).norm(), 1e-12);
    }
  }
}

TEST(RunTrials, GivesTheSameErrorsEveryTimeAndForWalksBegunElsewhere) {
  const auto both = run(car_park, kTwo);
  const auto second = run(car_park, kTwo, 8, 1);
  ASSERT_TRUE(both && second);
  EXPECT_EQ(both->errors_m, run(car_park, kTwo)->errors_m);
  for (std::size_t c = 0; c < kTwo.size(); ++c) {
    EXPECT_EQ(second->errors_m[c].front(), both->errors_m[c].back());
  }
  EXPECT_NE(both->errors_m[0].front(), both->errors_m[0].back());
}

TEST(RunTrials, ChargesHalfTheDiagonalWhereThereIsNoBelief) {
  double diagonal_m = 0.0;
  const RoomMaker deaf = [&](std::uint64_t seed) {
    auto room = car_park(seed);
    if (!room) return room;
    diagonal_m = room->site.floors().front().bounds.diagonal_m();
    for (sample::Sample& sample : room->walk.samples) {
      if (auto* scan = std::get_if<sample::WifiScan>(&sample)) scan->readings.clear();
    }
    for (sample::WifiScan& scan : room->start_scans) scan.readings.clear();
    return room;
  };
  const auto trials = run(deaf, kTwo, 7, 1);
  ASSERT_TRUE(trials) << trials.error().message;
  EXPECT_GT(diagonal_m, 20.0);  // Of 16 m x 15.8 m and a margin.
  ASSERT_FALSE(trials->errors_m[0].front().empty());
  for (const double error_m : trials->errors_m[0].front()) EXPECT_EQ(error_m, 0.5 * diagonal_m);
  EXPECT_TRUE(trials->example_tracks[0].empty());
  EXPECT_FALSE(trials->example_tracks[1].empty());
}

TEST(RunTrials, PassesOnWhatGoesWrong) {
  const auto no_method = run(car_park, {{"x", "kalman"}}, 7, 1);
  ASSERT_FALSE(no_method);
  EXPECT_EQ(no_method.error().code, core::ErrorCode::kMethodUnknown);
  const RoomMaker nowhere = [](std::uint64_t) -> core::Result<PaperRoom> {
    return core::fail(core::ErrorCode::kScenarioInvalid, "no room", "here");
  };
  const auto no_room = run(nowhere, kTwo);
  ASSERT_FALSE(no_room);
  EXPECT_EQ(no_room.error().code, core::ErrorCode::kScenarioInvalid);
}

TEST(RunTrials, CountsItsWalks) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> told;
  const auto trials =
      run_trials(car_park, 3, 2, 2.0, {kTwo[0]}, pipeline::Options(),
                 [&](std::uint64_t done, std::uint64_t total) { told.emplace_back(done, total); });
  ASSERT_TRUE(trials);
  EXPECT_EQ(told, (std::vector<std::pair<std::uint64_t, std::uint64_t>>{{1, 2}, {2, 2}}));
}

/// Two contenders on two walks of two fixes.
Trials hand_made() {
  Trials trials;
  trials.contenders = {{"a", "wknn"}, {"b", "fused"}};
  trials.errors_m = {{{0.5, 1.5}, {2.0, 4.0}}, {{1.0, 3.0}, {4.0, 8.0}}};
  return trials;
}

TEST(TrialFigures, AreOfAllFixesOfAllWalks) {
  const Figure mean = mean_figure(hand_made(), "a", "W-X1", "1.9");
  EXPECT_EQ(mean.what, "mean error, a");
  EXPECT_EQ(mean.id, "W-X1");
  EXPECT_EQ(mean.paper, "1.9");
  EXPECT_EQ(mean.unit, "m");
  EXPECT_DOUBLE_EQ(mean.ours.value, 2.0);
  EXPECT_EQ(mean.ours.n, 2U);
  const Figure within = within_figure(hand_made(), "a", 1.5, "Z-X1", "");
  EXPECT_EQ(within.what, "a within 1.5 m");
  EXPECT_DOUBLE_EQ(within.ours.value, 50.0);
  // a has half of b's error on every walk, whichever are drawn.
  const Figure below = reduction_figure(hand_made(), "a", "b", "W-X2", "42");
  EXPECT_EQ(below.what, "a below b");
  EXPECT_NEAR(below.ours.value, 50.0, 1e-12);
  EXPECT_NEAR(below.ours.low, 50.0, 1e-12);
  EXPECT_NEAR(below.ours.high, 50.0, 1e-12);
}

}  // namespace
}  // namespace waylode::experiment
