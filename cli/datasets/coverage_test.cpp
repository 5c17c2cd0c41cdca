// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/coverage.hpp"

#include <gtest/gtest.h>

namespace waylode::cli {
namespace {

const MarkedPath kCorridor = {{0.0, 0.0}, {10.0, 0.0}};

TEST(SamplePath, SpacesSamplesByHalfAMetreEndsIncluded) {
  const auto samples = sample_path({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.75}});
  // 1 m in 2 pieces of 0.5 m, 0.75 m in 2 pieces of 0.375 m.
  const MarkedPath expected = {{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, 0.375}, {1.0, 0.75}};
  ASSERT_EQ(samples.size(), expected.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR((samples[i] - expected[i]).norm(), 0.0, 1e-12) << i;
  }
}

TEST(SamplePath, StandingStillAndNothing) {
  EXPECT_TRUE(sample_path({}).empty());
  EXPECT_EQ(sample_path({{2.0, 3.0}}).size(), 1U);
  EXPECT_EQ(sample_path({{2.0, 3.0}, {2.0, 3.0}}).size(), 2U);
}

TEST(Covered, ReachesThreeMetresToTheSide) {
  EXPECT_TRUE(is_covered({{0.0, 3.0}, {10.0, 3.0}}, {kCorridor}));
  EXPECT_FALSE(is_covered({{0.0, 3.01}, {10.0, 3.01}}, {kCorridor}));
}

TEST(Covered, NineTenthsOfTheSamplesSuffice) {
  // 36 samples 0.5 m apart; those at -4.75, -4.25, -3.75 and -3.25 are too far: 32 of 36.
  MarkedPath path = {{-4.75, 0.0}, {12.75, 0.0}};
  EXPECT_EQ(sample_path(path).size(), 36U);
  EXPECT_FALSE(is_covered(path, {kCorridor}));
  // Standing still at the end adds a sample each time: 35 of 39 falls short, 36 of 40 does not.
  path.insert(path.end(), 3, path.back());
  EXPECT_FALSE(is_covered(path, {kCorridor}));
  path.push_back(path.back());
  EXPECT_TRUE(is_covered(path, {kCorridor}));
}

TEST(Covered, AnySurveyedPathWillDo) {
  const MarkedPath bent = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}};
  EXPECT_FALSE(is_covered(bent, {kCorridor}));
  EXPECT_TRUE(is_covered(bent, {kCorridor, {{12.0, 0.0}, {12.0, 10.0}}}));
}

TEST(Covered, NothingIsNotCovered) {
  EXPECT_FALSE(is_covered({}, {kCorridor}));
  EXPECT_FALSE(is_covered(kCorridor, {}));
}

}  // namespace
}  // namespace waylode::cli
