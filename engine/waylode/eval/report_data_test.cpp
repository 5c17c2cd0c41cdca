// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/report_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "waylode/eval/testing/eval_fixture.hpp"

namespace waylode::eval::detail {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

EvaluatedTrack track_off_by(const std::string& name, const std::string& method, double error_m) {
  EvaluatedTrack track;
  track.name = name;
  track.group = "house/F1";
  track.method = method;
  track.site = testing::three_floor_site();
  track.truths = {testing::truth_at(0.0, core::FloorId{0}, {1.0, 2.0})};
  track.fixes = {testing::fix_at(0.0, core::FloorId{0}, {1.0, 2.0 + error_m})};
  return track;
}

/// Seven recordings; the first method is off by 1 to 7 m, the second the other way around.
std::vector<EvaluatedTrack> seven_recordings() {
  std::vector<EvaluatedTrack> tracks;
  for (const int error_m : {4, 1, 7, 2, 6, 3, 5}) {
    tracks.push_back(track_off_by("r" + std::to_string(error_m), "wknn", error_m));
    tracks.push_back(track_off_by("r" + std::to_string(error_m), "fused", 8.0 - error_m));
  }
  return tracks;
}

std::vector<std::string> names_of(const std::vector<Recording>& recordings) {
  std::vector<std::string> names;
  for (const Recording& recording : recordings) {
    names.push_back(recording.methods.front().track->name);
  }
  return names;
}

TEST(ChooseRecordings, TakesAllWhenTheyFitWorstByTheFirstMethodFirst) {
  const std::vector<EvaluatedTrack> tracks = seven_recordings();
  const ChosenRecordings chosen = choose_recordings(tracks, 7);
  EXPECT_THAT(names_of(chosen.worst), ElementsAre("r7", "r6", "r5", "r4", "r3", "r2", "r1"));
  EXPECT_THAT(chosen.median, IsEmpty());
}

TEST(ChooseRecordings, TakesTheWorstAndTheMiddleOtherwise) {
  const std::vector<EvaluatedTrack> tracks = seven_recordings();
  const ChosenRecordings chosen = choose_recordings(tracks, 3);
  EXPECT_THAT(names_of(chosen.worst), ElementsAre("r7", "r6"));
  EXPECT_THAT(names_of(chosen.median), ElementsAre("r4"));
}

TEST(ChooseRecordings, NamesNoneTwice) {
  const std::vector<EvaluatedTrack> tracks = seven_recordings();
  const ChosenRecordings chosen = choose_recordings(tracks, 6);
  EXPECT_THAT(names_of(chosen.worst), ElementsAre("r7", "r6", "r5"));
  EXPECT_THAT(names_of(chosen.median), ElementsAre("r4", "r3", "r2"));
}

TEST(ChooseRecordings, KeepsTheMethodsOfARecordingTogether) {
  const std::vector<EvaluatedTrack> tracks = seven_recordings();
  const ChosenRecordings chosen = choose_recordings(tracks, 1);
  ASSERT_EQ(chosen.worst.size(), 1U);
  const std::vector<MethodTrack>& methods = chosen.worst[0].methods;
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0].track->method, "wknn");
  EXPECT_DOUBLE_EQ(methods[0].mean_m, 7.0);
  EXPECT_EQ(methods[1].track->method, "fused");
  EXPECT_DOUBLE_EQ(methods[1].mean_m, 1.0);
}

TEST(ChooseRecordings, LeavesOutWhatWasNotScored) {
  std::vector<EvaluatedTrack> tracks = {track_off_by("a", "wknn", 1.0)};
  tracks[0].truths[0].scored = false;
  EXPECT_THAT(choose_recordings(tracks, 5).worst, IsEmpty());
}

TEST(ErrorsByMethod, CollectsScoredErrorsAndTrackMeans) {
  const std::vector<EvaluatedTrack> tracks = {track_off_by("a", "wknn", 1.0),
                                              track_off_by("a", "fused", 2.0),
                                              track_off_by("b", "wknn", 3.0)};
  const std::vector<MethodErrors> methods = errors_by_method(tracks);
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0].name, "wknn");
  EXPECT_EQ(methods[0].errors.size(), 2U);
  EXPECT_THAT(methods[0].track_means_m, ElementsAre(1.0, 3.0));
  EXPECT_THAT(methods[1].track_means_m, ElementsAre(2.0));
}

}  // namespace
}  // namespace waylode::eval::detail
