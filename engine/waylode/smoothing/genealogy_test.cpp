// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/genealogy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>

#include "waylode/fusion/testing/particle_model.hpp"
#include "waylode/fusion/testing/planar_model.hpp"
#include "waylode/smoothing/whole_track.hpp"

namespace waylode::smoothing {
namespace {

using core::Vector2;
using fusion::ParticleFilter;
using fusion::PlanarEstimate;
using fusion::testing::at_s;
using fusion::testing::gaussian_raster;
using fusion::testing::open_ground;
using fusion::testing::particle_options;
using fusion::testing::raster_scan;
using fusion::testing::step_of;
using Node = ParticleFilter::Node;

constexpr std::uint32_t kNone = ParticleFilter::kNoParent;

Node node_at(double time_s, std::vector<float> x_m, std::vector<std::uint32_t> parents,
             std::vector<float> weights) {
  Node node{at_s(time_s), {}, std::move(parents), std::move(weights)};
  for (const float x : x_m) node.places_m.emplace_back(x, 2.0F * x);
  return node;
}

TEST(TraceBack, ManyDescendantsMakeAGuessHeavy) {
  const std::deque<Node> history = {
      node_at(0.0, {0.0F, 10.0F}, {kNone, kNone}, {0.9F, 0.1F}),
      node_at(1.0, {11.0F, 12.0F}, {1, 1}, {0.25F, 0.75F}),
  };
  const auto nodes = trace_back(history, std::chrono::seconds(10), 0.5, 2.0);
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0].time, at_s(0.0));
  EXPECT_NEAR(nodes[0].position_m.x(), 10.0, 1e-6);
  EXPECT_NEAR(nodes[0].position_m.y(), 20.0, 1e-6);
  EXPECT_NEAR(nodes[0].covariance_m2(0, 0), 0.25, 1e-6);  // Nothing but base_sigma_m.
  // The median of two places is the heavier one; scatter about it 0.25 * 1^2, twice its sigma.
  EXPECT_NEAR(nodes[1].position_m.x(), 12.0, 0.05);
  EXPECT_NEAR(nodes[1].covariance_m2(0, 0), 4.0 * 0.25 + 0.25, 0.05);
}

TEST(TraceBack, OneNodeAndNone) {
  EXPECT_TRUE(trace_back({}, std::chrono::seconds(10), 0.5, 1.0).empty());
  const auto nodes =
      trace_back({node_at(3.0, {4.0F}, {kNone}, {1.0F})}, std::chrono::seconds(10), 0.5, 1.0);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_NEAR(nodes[0].position_m.x(), 4.0, 1e-6);
  EXPECT_NEAR(nodes[0].covariance_m2(1, 1), 0.25, 1e-6);
}

TEST(TraceBack, WithoutDescendantsTheNearestFutureThatHasSomeSpeaks) {
  // The last node is drawn anew; of the second one all descend from the guess at 5.
  const std::deque<Node> history = {
      node_at(0.0, {0.0F, 5.0F}, {kNone, kNone}, {0.9F, 0.1F}),
      node_at(1.0, {6.0F, 7.0F}, {1, 1}, {0.2F, 0.8F}),
      node_at(2.0, {90.0F, 95.0F}, {kNone, kNone}, {0.5F, 0.5F}),
  };
  const auto nodes = trace_back(history, std::chrono::seconds(10), 0.5, 1.0);
  ASSERT_EQ(nodes.size(), 3U);
  EXPECT_NEAR(nodes[0].position_m.x(), 5.0, 1e-6);
  EXPECT_NEAR(nodes[1].position_m.x(), 7.0, 0.05);
}

TEST(TraceBack, GuessesWithoutWeightLeaveNoDescendants) {
  // The only guess that was not drawn anew has lost all weight since.
  const std::deque<Node> history = {
      node_at(0.0, {3.0F, 3.0F}, {kNone, kNone}, {0.5F, 0.5F}),
      node_at(1.0, {4.0F, 50.0F}, {0, kNone}, {0.5F, 0.5F}),
      node_at(2.0, {5.0F, 51.0F}, {0, 1}, {0.0F, 1.0F}),
  };
  const auto nodes = trace_back(history, std::chrono::seconds(10), 0.5, 1.0);
  ASSERT_EQ(nodes.size(), 3U);
  EXPECT_NEAR(nodes[0].position_m.x(), 3.0, 1e-6);
  EXPECT_NEAR(nodes[1].position_m.x(), 50.0, 1e-6);
  EXPECT_NEAR(nodes[2].position_m.x(), 51.0, 1e-6);
}

/// Node i holds guess k at x = k for each later node k, which makes all of its own guesses descend
/// from guess k of each node before: a node's estimate tells the index of the node it learnt from.
std::deque<Node> telling_history(const std::vector<double>& times_s) {
  const std::size_t count = times_s.size();
  std::deque<Node> history;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<float> x_m;
    std::vector<std::uint32_t> parents;
    std::vector<float> weights;
    for (std::size_t k = 0; k < count; ++k) {
      x_m.push_back(static_cast<float>(k));
      parents.push_back(i == 0 ? kNone : static_cast<std::uint32_t>(k));
      weights.push_back(k == i ? 1.0F : 0.0F);
    }
    history.push_back(node_at(times_s[i], x_m, parents, weights));
  }
  return history;
}

void expect_knowledge_within(const std::vector<double>& times_s, double horizon_s) {
  const auto nodes = trace_back(telling_history(times_s), core::from_seconds(horizon_s), 0.5, 1.0);
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const auto teller = static_cast<std::size_t>(std::lround(nodes[i].position_m.x()));
    ASSERT_LT(teller, times_s.size());
    ASSERT_GE(teller, i);
    EXPECT_LE(times_s[teller] - times_s[i], horizon_s) << i;
    const bool is_last = teller + 1 == times_s.size();
    const bool before_gap = !is_last && times_s[teller + 1] - times_s[i] > horizon_s;
    if (!is_last && !before_gap) {
      EXPECT_GE(times_s[teller] - times_s[i], horizon_s / 2.0) << i;
    }
  }
}

TEST(TraceBack, KnowsBetweenHalfTheHorizonAndAllOfIt) {
  for (const double spacing_s : {0.5, 2.0, 3.0, 7.0}) {
    std::vector<double> times_s;
    for (int i = 0; i < 60; ++i) times_s.push_back(spacing_s * i);
    expect_knowledge_within(times_s, 10.0);
  }
}

TEST(TraceBack, KeepsTheHorizonAcrossGapsAndEqualTimes) {
  expect_knowledge_within({0.0, 0.0, 1.0, 2.0, 30.0, 30.0, 34.0, 41.0, 42.0, 100.0, 101.0}, 10.0);
  core::Rng rng(21);
  for (int run = 0; run < 50; ++run) {
    std::vector<double> times_s = {0.0};
    for (int i = 0; i < 40; ++i) {
      times_s.push_back(times_s.back() + (rng.uniform() < 0.1 ? 15.0 : rng.uniform(0.0, 4.0)));
    }
    expect_knowledge_within(times_s, 10.0);
  }
}

TEST(TraceBack, EqualsRauchTungStriebelOnALinearWalk) {
  // Per axis: x0 of variance 9; eight steps with variance 0.5^2 of time's passing; scans of
  // variance 4 with each. The steps' direction and length are certain.
  constexpr std::size_t kSteps = 8;
  const std::array<double, kSteps> scans_m = {3.0, 2.5, 4.5, 7.0, 5.0, 9.0, 8.5, 10.0};
  std::array<double, kSteps + 1> mean{}, variance{}, predicted_mean{}, predicted_variance{};
  variance[0] = 9.0;
  for (std::size_t i = 1; i <= kSteps; ++i) {
    predicted_mean[i] = mean[i - 1] + 1.0;
    predicted_variance[i] = variance[i - 1] + 0.25;
    const double gain = predicted_variance[i] / (predicted_variance[i] + 4.0);
    mean[i] = predicted_mean[i] + gain * (scans_m[i - 1] - predicted_mean[i]);
    variance[i] = (1.0 - gain) * predicted_variance[i];
  }
  for (std::size_t i = kSteps; i > 0; --i) {
    const double gain = variance[i - 1] / predicted_variance[i];
    mean[i - 1] += gain * (mean[i] - predicted_mean[i]);
    variance[i - 1] += gain * gain * (variance[i] - predicted_variance[i]);
  }

  ParticleFilter::Options options = particle_options();
  options.particles = 40000;
  options.position_walk_m_per_sqrt_s = 0.5;
  ParticleFilter filter(options, 31, /*keep_history=*/true);
  filter.start(at_s(0.0), Vector2::Zero(), 3.0);
  for (std::size_t i = 1; i <= kSteps; ++i) {
    const auto time_s = static_cast<double>(i);
    filter.add(step_of(time_s - 1.0, time_s, 1.0, 0.0, 0.0, 0.0), open_ground());
    filter.add(raster_scan(time_s, gaussian_raster(Vector2(scans_m[i - 1], 0.0), 2.0)),
               open_ground());
  }
  const auto nodes = trace_back(filter.history(), std::chrono::seconds(100), 1e-6, 1.0);
  ASSERT_EQ(nodes.size(), 2 * kSteps + 1);
  for (std::size_t i = 0; i <= kSteps; ++i) {
    const PlanarEstimate& node = nodes[2 * i];
    EXPECT_NEAR(node.position_m.x(), mean[i], 0.12) << i;
    EXPECT_NEAR(node.position_m.y(), 0.0, 0.12) << i;
    EXPECT_NEAR(node.covariance_m2(0, 0), variance[i], 0.12 * variance[i] + 0.02) << i;
    EXPECT_NEAR(node.covariance_m2(1, 1), variance[i], 0.12 * variance[i] + 0.02) << i;
  }
}

TEST(InterpolateEstimates, IsLinearAndHoldsTheOutermost) {
  const std::vector<PlanarEstimate> nodes = {
      {at_s(1.0), Vector2(10.0, -20.0), core::Matrix2::Identity()},
      {at_s(3.0), Vector2(20.0, -40.0), 4.0 * core::Matrix2::Identity()},
  };
  EXPECT_NEAR(interpolate(nodes, at_s(1.5)).position_m.x(), 12.5, 1e-9);
  EXPECT_EQ(interpolate(nodes, at_s(1.5)).covariance_m2(0, 0), 1.0);
  EXPECT_NEAR(interpolate(nodes, at_s(2.5)).position_m.y(), -35.0, 1e-9);
  EXPECT_EQ(interpolate(nodes, at_s(2.5)).covariance_m2(0, 0), 4.0);
  EXPECT_EQ(interpolate(nodes, at_s(0.0)).position_m.x(), 10.0);
  EXPECT_EQ(interpolate(nodes, at_s(9.0)).position_m.x(), 20.0);
}

}  // namespace
}  // namespace waylode::smoothing
