// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/rts_smoother.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "waylode/core/covariance.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::smoothing {
namespace {

using core::Matrix2;
using core::Vector2;
using fusion::PlanarMatrix;
using fusion::PlanarState;
using fusion::PlanarTracker;
using fusion::PlanarTransition;
using fusion::PlanarVector;
using fusion::testing::at_s;
using fusion::testing::gaussian_options;
using fusion::testing::ModelWalk;
using fusion::testing::scan_of;
using fusion::testing::step_of;
using MeasurementMatrix = Eigen::Matrix<double, 2, 6>;

PlanarMatrix random_covariance(core::Rng& rng) {
  PlanarMatrix root;
  for (double& value : root.reshaped()) value = rng.normal();
  return root * root.transpose() + 0.3 * PlanarMatrix::Identity();
}

/// A linear system with everything at random: x0, then x = F x + c + noise Q, z = H x + noise I.
struct LinearSystem {
  static constexpr int kNodes = 9;

  explicit LinearSystem(std::uint64_t seed) {
    core::Rng rng(seed);
    prior.covariance = random_covariance(rng);
    for (double& value : prior.mean) value = rng.normal(0.0, 5.0);
    for (int i = 0; i < kNodes; ++i) {
      PlanarMatrix& transition = transitions.emplace_back(PlanarMatrix::Identity());
      for (double& value : transition.reshaped()) value += rng.normal(0.0, 0.2);
      PlanarVector& shift = shifts.emplace_back();
      for (double& value : shift) value = rng.normal(0.0, 3.0);
      noises.push_back(random_covariance(rng));
      MeasurementMatrix& model = models.emplace_back();
      for (double& value : model.reshaped()) value = rng.normal();
      scans.emplace_back(rng.normal(0.0, 10.0), rng.normal(0.0, 10.0));
    }
  }

  PlanarState prior;
  std::vector<PlanarMatrix> transitions;  ///< From node i to node i + 1.
  std::vector<PlanarVector> shifts;
  std::vector<PlanarMatrix> noises;
  std::vector<MeasurementMatrix> models;  ///< Of node i + 1.
  std::vector<Vector2> scans;
};

/// Textbook Kalman filter; leaves the history that the smoother reads.
PlanarState filter(const LinearSystem& system, std::deque<PlanarTransition>& history) {
  PlanarState state = system.prior;
  for (std::size_t i = 0; i < LinearSystem::kNodes; ++i) {
    const PlanarMatrix& transition = system.transitions[i];
    PlanarState predicted;
    predicted.time = at_s(static_cast<double>(i) + 1.0);
    predicted.mean = transition * state.mean + system.shifts[i];
    predicted.covariance =
        transition * state.covariance * transition.transpose() + system.noises[i];
    history.push_back({state, transition, predicted});
    const MeasurementMatrix& model = system.models[i];
    const Matrix2 innovation =
        model * predicted.covariance * model.transpose() + Matrix2::Identity();
    const Eigen::Matrix<double, 6, 2> gain =
        predicted.covariance * model.transpose() * innovation.inverse();
    state = predicted;
    state.mean += gain * (system.scans[i] - model * predicted.mean);
    state.covariance -= gain * innovation * gain.transpose();
  }
  return state;
}

TEST(SmoothBackward, EqualsTheBatchLeastSquaresSolution) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const LinearSystem system(seed);
    std::deque<PlanarTransition> history;
    const PlanarState last = filter(system, history);
    const auto nodes = smooth_backward(history, last);
    ASSERT_EQ(nodes.size(), LinearSystem::kNodes + 1U);

    // All nodes at once: the normal equations of prior, transitions and measurements.
    constexpr int kSize = 6 * (LinearSystem::kNodes + 1);
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kSize, kSize);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(kSize);
    const PlanarMatrix prior_information = system.prior.covariance.inverse();
    information.topLeftCorner<6, 6>() += prior_information;
    right.head<6>() += prior_information * system.prior.mean;
    for (int i = 0; i < LinearSystem::kNodes; ++i) {
      const auto index = static_cast<std::size_t>(i);
      Eigen::Matrix<double, 6, 12> step;
      step << -system.transitions[index], PlanarMatrix::Identity();
      const PlanarMatrix weight = system.noises[index].inverse();
      information.block<12, 12>(6 * i, 6 * i) += step.transpose() * weight * step;
      right.segment<12>(6 * i) += step.transpose() * weight * system.shifts[index];
      const MeasurementMatrix& model = system.models[index];
      information.block<6, 6>(6 * i + 6, 6 * i + 6) += model.transpose() * model;
      right.segment<6>(6 * i + 6) += model.transpose() * system.scans[index];
    }
    const Eigen::MatrixXd covariance = information.inverse();
    const Eigen::VectorXd mean = covariance * right;
    for (int i = 0; i <= LinearSystem::kNodes; ++i) {
      const PlanarState& node = nodes[static_cast<std::size_t>(i)];
      EXPECT_LT((node.mean - mean.segment<6>(6 * i)).norm(), 1e-6) << i;
      EXPECT_LT((node.covariance - covariance.block<6, 6>(6 * i, 6 * i)).norm(), 1e-6) << i;
    }
  }
}

TEST(SmoothBackward, GivesTheNewestStateBackWithoutHistory) {
  PlanarState last;
  last.time = at_s(3.0);
  last.mean << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  const auto nodes = smooth_backward({}, last);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes.front().mean, last.mean);
  EXPECT_EQ(nodes.front().time, last.time);
}

TEST(SmoothBackward, NeverKnowsLessThanTheFilterDid) {
  ModelWalk walk(gaussian_options(), 5);
  PlanarTracker tracker(gaussian_options(), /*keep_history=*/true);
  tracker.start(at_s(0.0), Vector2::Zero(), 20.0);
  for (int i = 1; i <= 120; ++i) {
    tracker.add(walk.step());
    if (i % 6 == 0) tracker.add(walk.scan());
  }
  const auto nodes = smooth_backward(tracker.history(), tracker.state());
  double gained_m2 = 0.0;
  for (std::size_t i = 0; i < tracker.history().size(); ++i) {
    const PlanarMatrix& filtered = tracker.history()[i].filtered.covariance;
    EXPECT_EQ(nodes[i].time, tracker.history()[i].filtered.time);
    const Eigen::SelfAdjointEigenSolver<PlanarMatrix> less(filtered - nodes[i].covariance);
    EXPECT_GT(less.eigenvalues()(0), -1e-9) << i;
    const Eigen::SelfAdjointEigenSolver<PlanarMatrix> smoothed(nodes[i].covariance);
    EXPECT_GT(smoothed.eigenvalues()(0), 0.0) << i;
    gained_m2 += less.eigenvalues()(5);
  }
  EXPECT_GT(gained_m2, 100.0);
}

TEST(SmoothBackward, StatesItsPositionErrorHonestly) {
  constexpr int kRuns = 200;
  constexpr std::size_t kSteps = 120;
  std::vector<double> sum(kSteps);
  for (int run = 0; run < kRuns; ++run) {
    ModelWalk walk(gaussian_options(), 7000 + static_cast<std::uint64_t>(run));
    PlanarTracker tracker(gaussian_options(), /*keep_history=*/true);
    tracker.start(at_s(0.0), Vector2::Zero(), 20.0);
    std::vector<PlanarVector> truths;
    for (std::size_t i = 0; i < kSteps; ++i) {
      truths.push_back(walk.truth());
      tracker.add(walk.step());
      if (i % 6 == 5) tracker.add(walk.scan());
    }
    const auto nodes = smooth_backward(tracker.history(), tracker.state());
    for (std::size_t i = 0; i < kSteps; ++i) {
      // One node per step and one more per scan before it.
      const PlanarState& node = nodes[i + i / 6];
      const Vector2 error_m = node.position_m() - truths[i].head<2>();
      sum[i] += core::squared_mahalanobis(error_m, node.position_covariance_m2());
    }
  }
  // 200 runs of two degrees of freedom: chi-square with 400, divided by 200, 99.9 % within.
  for (const std::size_t step : {0U, 3U, 20U, 47U, 80U, 119U}) {
    EXPECT_GT(sum[step] / kRuns, 1.567) << step;
    EXPECT_LT(sum[step] / kRuns, 2.499) << step;
  }
}

}  // namespace
}  // namespace waylode::smoothing
