// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/raster_mixture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace waylode::radio {
namespace {

using core::Vector2;
using observation::LikelihoodRaster;
using observation::RadioCandidate;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const RasterGeometry kGeometry{Vector2(10.0, -4.0), 2.0, 3, 2};

TEST(Rasterise, IsTheUnnormalisedKernelSumWorkedOutByHand) {
  const std::vector<RadioCandidate> candidates = {{Vector2(10.0, -4.0), 0.75},
                                                  {Vector2(14.0, -2.0), 0.25}};
  const auto raster = rasterise(candidates, {2.0, 0.01}, kGeometry);
  ASSERT_EQ(raster.log_likelihood.size(), 6U);
  // Squared distances of node (1, 2) = (14, -2): 20 and 0; exp(-20 / 8) = exp(-2.5).
  EXPECT_NEAR(raster.log_likelihood[5], std::log(0.01 + 0.75 * std::exp(-2.5) + 0.25), 1e-6);
  EXPECT_NEAR(raster.log_likelihood[0], std::log(0.01 + 0.75 + 0.25 * std::exp(-2.5)), 1e-6);
  EXPECT_NEAR(raster.elsewhere, std::log(0.01), 1e-6);
}

TEST(Rasterise, SaysLessWhenTheSameCandidatesScatter) {
  const std::vector<RadioCandidate> together(4, {Vector2(12.0, -2.0), 0.25});
  std::vector<RadioCandidate> apart;
  for (const double x_m : {12.0, 112.0, 212.0, 312.0}) {
    apart.push_back({Vector2(x_m, -2.0), 0.25});
  }
  const double agreed = rasterise(together, {}, kGeometry).at({12.0, -2.0});
  const double scattered = rasterise(apart, {}, kGeometry).at({12.0, -2.0});
  EXPECT_NEAR(agreed - scattered, std::log(1.005 / 0.255), 1e-5);
}

TEST(Rasterise, PassesOverWhatIsNotFiniteAndIsUniformWithoutCandidates) {
  const std::vector<RadioCandidate> bad = {
      {Vector2(kNan, 0.0), 0.5}, {Vector2(12.0, -2.0), kNan}, {Vector2(12.0, -2.0), -1.0}};
  EXPECT_EQ(rasterise(bad, {}, kGeometry), rasterise({}, {}, kGeometry));
  for (const float value : rasterise({}, {}, kGeometry).log_likelihood) {
    EXPECT_NEAR(value, std::log(0.005), 1e-5);
  }
  EXPECT_TRUE(rasterise({}, {}, {Vector2::Zero(), 2.0, 0, 0}).empty());
}

TEST(CandidateKernel, RefusesWhatHasNoLogarithm) {
  EXPECT_TRUE(CandidateKernel{}.validate());
  EXPECT_FALSE((CandidateKernel{0.0, 0.005}.validate()));
  EXPECT_FALSE((CandidateKernel{3.0, 0.0}.validate()));
  EXPECT_FALSE((CandidateKernel{kNan, 0.005}.validate()));
}

TEST(Combine, AddsWeightedLogarithmsOnTheNodesOfTheFirst) {
  const LikelihoodRaster first{Vector2(0.0, 0.0), 2.0, 2, 1, {-1.0F, -3.0F}, -8.0F};
  // Shifted by a metre: at x = 2 half way between -2 and -6, at x = 0 off it.
  const LikelihoodRaster second{Vector2(1.0, 0.0), 2.0, 2, 1, {-2.0F, -6.0F}, -10.0F};
  const auto sum = combine(first, 0.5, second, 0.25);
  EXPECT_NEAR(sum.log_likelihood[0], -0.5 - 2.5, 1e-6);
  EXPECT_NEAR(sum.log_likelihood[1], -1.5 - 1.0, 1e-6);
  EXPECT_NEAR(sum.elsewhere, -4.0 - 2.5, 1e-6);
}

TEST(Combine, TakesTheOtherWhereOneIsEmpty) {
  const LikelihoodRaster raster{Vector2(0.0, 0.0), 2.0, 2, 1, {-1.0F, -3.0F}, -8.0F};
  const LikelihoodRaster halved{Vector2(0.0, 0.0), 2.0, 2, 1, {-0.5F, -1.5F}, -4.0F};
  EXPECT_EQ(combine(raster, 0.5, {}, 0.7), halved);
  EXPECT_EQ(combine({}, 0.7, raster, 0.5), halved);
  EXPECT_TRUE(combine({}, 0.5, {}, 0.5).empty());
}

}  // namespace
}  // namespace waylode::radio
